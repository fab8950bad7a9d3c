// literal.c - constant values of OpenSCAD's language, and their text.
#include "customizer/literal.h"

#include "base/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void words_add(struct words *out, const char *text, size_t length)
{
    array_reserve(&out->data, &out->capacity, (size_t)out->size + length + 1);
    memcpy(out->data + out->size, text, length);
    out->size += (uint32_t)length;
    out->data[out->size] = 0;
}

void words_say(struct words *out, const char *words)
{
    words_add(out, words, strlen(words));
}

void words_number(struct words *out, double number, int digits)
{
    char text[NUMBER_TEXT];
    if (number == 0)
        number = 0; // no sign
    number_shortest(text, number, digits < 15 ? digits : 15, digits);
    char *e = strchr(text, 'e');
    if (!e) {
        words_say(out, text);
        return;
    }
    words_add(out, text, (size_t)(e - text)); // exponents without padding
    snprintf(text, sizeof text, "e%+ld", strtol(e + 1, NULL, 10));
    words_say(out, text);
}

void words_quoted(struct words *out, const char *text)
{
    static const char special[] = "\"\\\n\t\r", letters[] = "\"\\ntr";
    words_say(out, "\"");
    while (*text) {
        size_t plain = strcspn(text, special);
        words_add(out, text, plain);
        text += plain;
        if (*text) {
            const char escaped[2] = {'\\', letters[strchr(special, *text++) - special]};
            words_add(out, escaped, 2);
        }
    }
    words_say(out, "\"");
}

void words_literal(struct words *out, const struct literal *value, int digits)
{
    switch (value->kind) {
    case LITERAL_UNDEF:
        words_say(out, "undef");
        break;
    case LITERAL_BOOL:
        words_say(out, value->boolean ? "true" : "false");
        break;
    case LITERAL_NUMBER:
        words_number(out, value->number, digits);
        break;
    case LITERAL_STRING:
        words_quoted(out, value->text);
        break;
    case LITERAL_VECTOR:
    case LITERAL_RANGE:
        words_say(out, "[");
        for (uint32_t i = 0; i < value->count; i++) {
            if (i)
                words_say(out, value->kind == LITERAL_RANGE ? " : " : ", ");
            words_literal(out, &value->items[i], digits);
        }
        words_say(out, "]");
        break;
    }
}

static bool is_true(const struct literal *value)
{
    switch (value->kind) {
    case LITERAL_UNDEF:
        return false;
    case LITERAL_BOOL:
        return value->boolean;
    case LITERAL_NUMBER:
        return value->number != 0;
    case LITERAL_STRING:
        return *value->text;
    case LITERAL_VECTOR:
        return value->count > 0;
    case LITERAL_RANGE:
        break;
    }
    return true;
}

static void negate(struct literal *value)
{
    if (value->kind == LITERAL_NUMBER)
        value->number = -value->number;
    else if (value->kind == LITERAL_VECTOR)
        for (uint32_t i = 0; i < value->count; i++)
            negate(&value->items[i]);
    else
        *value = (struct literal){0};
}

struct literal literal_sign(const char *signs, size_t length, struct literal value)
{
    bool minus = false; // two of them cancel out
    while (length--)
        if (signs[length] == '!') {
            value = (struct literal){LITERAL_BOOL, .boolean = !is_true(&value)};
            minus = false;
        } else if (signs[length] == '-') {
            minus = !minus;
            if (value.kind != LITERAL_NUMBER && value.kind != LITERAL_VECTOR)
                value = (struct literal){0};
        }
    if (minus)
        negate(&value);
    return value;
}

static size_t put_utf8(char *out, unsigned long code)
{
    size_t n = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    static const unsigned char first[] = {0, 0, 0xC0, 0xE0, 0xF0};
    for (size_t i = n; i-- > 1; code >>= 6)
        out[i] = (char)(0x80 | (code & 0x3F));
    out[0] = (char)(first[n] | code);
    return n;
}

// The character that \x.., \u.... or \U...... writes; zero is a blank, as in OpenSCAD.
static size_t put_code(char *out, const char **text, const char *end)
{
    char hex[7] = {0};
    size_t digits = **text == 'x' ? 2 : **text == 'u' ? 4 : 6;
    if ((size_t)(end - *text) > digits)
        memcpy(hex, *text + 1, digits);
    unsigned long code = strtoul(hex, NULL, 16);
    if (strspn(hex, "0123456789abcdefABCDEF") != digits || (digits == 2 && code > 0x7F) ||
        code > 0x10FFFF)
        return 0;
    *text += digits;
    return put_utf8(out, code ? code : ' ');
}

const char *literal_unescape(struct arena *arena, const char *text, size_t length)
{
    char *out = arena_alloc(arena, length + 1), *to = out;
    const char *end = text + length;
    for (; text < end; text++) {
        if (*text == '\r' || *text == '\n' || !*text)
            continue; // not part of strings
        if (*text != '\\' || text + 1 == end) {
            *to++ = *text;
            continue;
        }
        size_t coded = 0;
        text++;
        if (*text == 'x' || *text == 'u' || *text == 'U')
            coded = put_code(to, &text, end);
        to += coded;
        if (!coded)
            *to++ = (char)(*text == 'n' ? '\n' : *text == 't' ? '\t' : *text == 'r' ? '\r' : *text);
    }
    *to = 0;
    return out;
}
