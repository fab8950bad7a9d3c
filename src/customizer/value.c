// value.c - values of parameters: from literals and back to text.
#include "customizer/value.h"

#include "base/locale.h"
#include "customizer/annotation.h"
#include "customizer/assignments.h"

#include <stdlib.h>
#include <string.h>

enum parameter_kind value_kind(const struct literal *literal)
{
    static const enum parameter_kind kinds[] = {
        [LITERAL_BOOL] = PARAMETER_BOOL,     [LITERAL_NUMBER] = PARAMETER_NUMBER,
        [LITERAL_STRING] = PARAMETER_STRING, [LITERAL_UNDEF] = PARAMETER_SOURCE,
        [LITERAL_VECTOR] = PARAMETER_SOURCE, [LITERAL_RANGE] = PARAMETER_SOURCE,
    };
    if (literal->kind != LITERAL_VECTOR || literal->count < 1 ||
        literal->count > PARAMETER_NUMBERS_MOST)
        return kinds[literal->kind];
    for (uint32_t i = 0; i < literal->count; i++)
        if (literal->items[i].kind != LITERAL_NUMBER)
            return PARAMETER_SOURCE;
    return PARAMETER_VECTOR;
}

static void set_text(struct parameter_value *value, char *text)
{
    free(value->text);
    value->text = text;
}

bool value_from(struct parameter_value *value, enum parameter_kind kind,
                const struct literal *literal)
{
    enum parameter_kind own = value_kind(literal);
    // Whoever edits a long vector may leave a short one.
    if (literal->kind == LITERAL_UNDEF ||
        (own != kind && !(own == PARAMETER_VECTOR && kind == PARAMETER_SOURCE)))
        return false;
    struct words text = {0};
    switch (kind) {
    case PARAMETER_BOOL:
        value->boolean = literal->boolean;
        break;
    case PARAMETER_NUMBER:
        value->count = 1;
        value->numbers[0] = literal->number;
        break;
    case PARAMETER_STRING:
        set_text(value, mem_strdup(literal->text));
        break;
    case PARAMETER_VECTOR:
        value->count = literal->count;
        for (uint32_t i = 0; i < literal->count; i++)
            value->numbers[i] = literal->items[i].number;
        break;
    case PARAMETER_SOURCE:
        words_literal(&text, literal, DIGITS_ALL);
        set_text(value, text.data);
        break;
    }
    return true;
}

bool value_equal(enum parameter_kind kind, const struct parameter_value *a,
                 const struct parameter_value *b)
{
    switch (kind) {
    case PARAMETER_BOOL:
        return a->boolean == b->boolean;
    case PARAMETER_STRING:
    case PARAMETER_SOURCE:
        return strcmp(a->text, b->text) == 0;
    case PARAMETER_NUMBER:
    case PARAMETER_VECTOR:
        break;
    }
    bool equal = a->count == b->count;
    for (uint32_t i = 0; equal && i < a->count; i++)
        equal = a->numbers[i] == b->numbers[i];
    return equal;
}

void value_copy(struct parameter_value *to, const struct parameter_value *from)
{
    char *text = from->text ? mem_strdup(from->text) : NULL;
    free(to->text);
    *to = *from;
    to->text = text;
}

void value_say(struct words *out, enum parameter_kind kind, const struct parameter_value *value,
               bool quoted)
{
    switch (kind) {
    case PARAMETER_BOOL:
        words_say(out, value->boolean ? "true" : "false");
        break;
    case PARAMETER_NUMBER:
        words_number(out, value->numbers[0], DIGITS_ALL);
        break;
    case PARAMETER_STRING:
        if (quoted)
            words_quoted(out, value->text);
        else
            words_say(out, value->text);
        break;
    case PARAMETER_VECTOR:
        for (uint32_t i = 0; i < value->count; i++) {
            words_say(out, i ? ", " : "[");
            words_number(out, value->numbers[i], DIGITS_ALL);
        }
        words_say(out, "]");
        break;
    case PARAMETER_SOURCE:
        words_say(out, value->text);
        break;
    }
}

char *parameter_text(const struct parameter *p)
{
    struct own_locale own = locale_enter();
    struct words out = {0};
    words_say(&out, "");
    value_say(&out, p->kind, &p->value, false);
    locale_leave(&own);
    return out.data;
}

// As OpenSCAD reads it: blanks around it, "1" and "0" as well.
static bool set_boolean(struct parameter *p, const char *text)
{
    static const char *const names[][2] = {{"false", "0"}, {"true", "1"}};
    text += strspn(text, " \t");
    size_t length = strcspn(text, " \t");
    if (text[length + strspn(text + length, " \t")])
        return false;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            if (strlen(names[i][j]) == length && strncmp(text, names[i][j], length) == 0) {
                p->value.boolean = i;
                return true;
            }
    return false;
}

// Vectors and ranges do not replace each other. OpenSCAD reads those of sets as annotations, where
// words need no quotes; that makes strings of [true, undef], and nothing of nested ones.
static bool set_source(struct parameter *p, const char *text, struct arena *arena)
{
    struct literal before, after;
    size_t size = strlen(text);
    if (!literal_read(arena, text, size, &after))
        after = annotation_read(arena, text, size);
    return literal_read(arena, p->initial.text, strlen(p->initial.text), &before) &&
           after.kind == before.kind && value_from(&p->value, p->kind, &after);
}

bool parameter_set(struct parameter *p, const char *text)
{
    if (p->kind == PARAMETER_BOOL)
        return set_boolean(p, text);
    if (p->kind == PARAMETER_STRING)
        return value_from(&p->value, p->kind, &(struct literal){LITERAL_STRING, .text = text});
    struct own_locale own = locale_enter();
    struct arena arena = {0};
    bool ok;
    if (p->kind == PARAMETER_SOURCE)
        ok = set_source(p, text, &arena);
    else {
        struct literal literal = annotation_read(&arena, text, strlen(text));
        ok = value_from(&p->value, p->kind, &literal);
    }
    arena_free(&arena);
    locale_leave(&own);
    return ok;
}
