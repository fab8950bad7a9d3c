// error.c - one error with its place, and lists of messages for the user.
#include "base/error.h"

#include "base/mem.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

// "file:line:column: ", as much of it as is known; returns its length.
static size_t put_place(char *out, size_t size, struct place p)
{
    int n = 0;
    if (p.file && p.line && p.column)
        n = snprintf(out, size, "%s:%u:%u: ", p.file, p.line, p.column);
    else if (p.file && p.line)
        n = snprintf(out, size, "%s:%u: ", p.file, p.line);
    else if (p.file)
        n = snprintf(out, size, "%s: ", p.file);
    return n < 0 ? 0 : (size_t)n < size ? (size_t)n : size - 1;
}

// Returns the length of the place in front.
static size_t set(struct error *err, struct place place, const char *format, va_list args)
{
    if (!err)
        return 0;
    size_t used = put_place(err->text, sizeof err->text, place);
    vsnprintf(err->text + used, sizeof err->text - used, format, args);
    for (char *c = err->text; *c; c++) // names from files may hold anything, a message is one line
        if ((unsigned char)*c < 32 || *c == 127)
            *c = ' ';
    return used;
}

void error_set(struct error *err, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set(err, (struct place){0}, format, args);
    va_end(args);
}

void error_at(struct error *err, struct place place, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set(err, place, format, args);
    va_end(args);
}

void messages_add(struct messages *m, enum message_level level, struct place place,
                  const char *format, ...)
{
    uint32_t *level_count = level == MESSAGE_ERROR ? &m->errors : &m->warnings;
    if (++*level_count > MESSAGES_KEPT)
        return;
    struct error line;
    va_list args;
    va_start(args, format);
    size_t used = set(&line, place, format, args);
    va_end(args);
    array_reserve(&m->items, &m->capacity, m->count + 1);
    m->items[m->count++] = (struct message){.level = level,
                                            .text = mem_strdup(line.text),
                                            .place_length = place.line ? (uint32_t)used - 2 : 0};
}

// Long lines are shown around the column only.
void messages_source(struct messages *m, const char *line, size_t length, uint32_t column)
{
    enum { SHOWN = 100, BEFORE = 60 };
    if (!m->count || m->items[m->count - 1].source)
        return;
    size_t caret = column ? column - 1 : 0;
    if (caret > length)
        caret = length;
    size_t from = caret > SHOWN - 20 ? caret - BEFORE : 0;
    size_t shown = length - from < SHOWN ? length - from : SHOWN;
    char *text = mem_alloc(2 * SHOWN + 16), *out = text;
    *out++ = ' ';
    *out++ = ' ';
    for (size_t i = 0; i < shown; i++) {
        unsigned char c = (unsigned char)line[from + i];
        *out++ = (char)(c < 32 || c == 127 ? ' ' : c);
    }
    *out++ = '\n';
    for (size_t i = 0; i < caret - from + 2; i++)
        *out++ = ' ';
    *out++ = '^';
    *out = 0;
    m->items[m->count - 1].source = text;
}

void messages_append(struct messages *m, const struct messages *more)
{
    m->warnings += more->warnings;
    m->errors += more->errors;
    for (uint32_t i = 0; i < more->count && m->count < 2 * MESSAGES_KEPT; i++) {
        const struct message *one = &more->items[i];
        array_reserve(&m->items, &m->capacity, (size_t)m->count + 1);
        m->items[m->count++] =
            (struct message){one->level, mem_strdup(one->text),
                             one->source ? mem_strdup(one->source) : NULL, one->place_length};
    }
}

static void print_message(const struct message *m, FILE *out)
{
    fprintf(out, "%s%s\n", m->level == MESSAGE_WARNING ? "warning: " : "", m->text);
    if (m->source)
        fprintf(out, "%s\n", m->source);
}

void messages_print_errors(const struct messages *m, FILE *out)
{
    for (uint32_t i = 0; i < m->count; i++)
        if (m->items[i].level == MESSAGE_ERROR)
            print_message(&m->items[i], out);
    if (m->errors > MESSAGES_KEPT)
        fprintf(out, "%u more errors not shown\n", m->errors - MESSAGES_KEPT);
}

void messages_print(const struct messages *m, FILE *out)
{
    for (uint32_t i = 0; i < m->count; i++)
        print_message(&m->items[i], out);
    if (m->warnings > MESSAGES_KEPT)
        fprintf(out, "warning: %u more warnings not shown\n", m->warnings - MESSAGES_KEPT);
    if (m->errors > MESSAGES_KEPT)
        fprintf(out, "%u more errors not shown\n", m->errors - MESSAGES_KEPT);
}

void messages_free(struct messages *m)
{
    for (uint32_t i = 0; i < m->count; i++) {
        free(m->items[i].text);
        free(m->items[i].source);
    }
    free(m->items);
    *m = (struct messages){0};
}
