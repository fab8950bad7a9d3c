// report.c - what the user is told about a load, line by line.
#include "app/report.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

// Takes the text over.
static void add(struct report *r, enum report_kind kind, char *text, uint32_t place_length)
{
    if (++r->kinds[kind] > REPORT_KEPT) {
        free(text);
        return;
    }
    array_reserve(&r->lines, &r->capacity, (size_t)r->count + 1);
    r->lines[r->count++] = (struct report_line){kind, text, place_length};
}

void report_messages(struct report *r, const struct messages *m)
{
    for (uint32_t i = 0; i < m->count; i++)
        add(r, m->items[i].level == MESSAGE_ERROR ? REPORT_ERROR : REPORT_WARNING,
            mem_strdup(m->items[i].text), m->items[i].place_length);
    if (m->errors > MESSAGES_KEPT)
        r->kinds[REPORT_ERROR] += m->errors - MESSAGES_KEPT;
    if (m->warnings > MESSAGES_KEPT)
        r->kinds[REPORT_WARNING] += m->warnings - MESSAGES_KEPT;
}

void report_scad(struct report *r, const struct scad_result *result, const struct error *err)
{
    static const enum report_kind kinds[] = {[SCAD_ECHO] = REPORT_ECHO,
                                             [SCAD_TRACE] = REPORT_TRACE,
                                             [SCAD_WARNING] = REPORT_WARNING,
                                             [SCAD_ERROR] = REPORT_ERROR};
    enum { SHOWN = 2000 };
    struct scad_message m;
    const char *rest = result->log;
    while (rest && scad_next_message(result, &rest, &m)) {
        int shown = m.length < SHOWN ? (int)m.length : SHOWN, place = 0;
        char *text = mem_alloc((size_t)shown + (m.file ? strlen(m.file) : 0) + 32), *out = text;
        if (m.file)
            place = sprintf(text, "%s:%u", m.file, m.line);
        sprintf(text + place, "%s%.*s", m.file ? ": " : "", shown, m.text);
        for (; *out; out++)
            if ((unsigned char)*out < 32 || *out == 127)
                *out = ' ';
        add(r, kinds[m.level], text, (uint32_t)place);
        free(m.file);
    }
    if (err && !r->kinds[REPORT_ERROR])
        report_error(r, err->text);
}

void report_error(struct report *r, const char *text)
{
    add(r, REPORT_ERROR, mem_strdup(text), 0);
}

void report_print(const struct report *r, FILE *out)
{
    static const char *const prefixes[] = {"ECHO: ", "TRACE: ", "warning: ", ""};
    static const char *const names[] = {"echoes", "traces", "warnings", "errors"};
    for (uint32_t i = 0; i < r->count; i++)
        fprintf(out, "%s%s\n", prefixes[r->lines[i].kind], r->lines[i].text);
    for (int k = 0; k < REPORT_KINDS; k++)
        if (r->kinds[k] > REPORT_KEPT)
            fprintf(out, "%u more %s not shown\n", r->kinds[k] - REPORT_KEPT, names[k]);
}

struct report report_copy(const struct report *r)
{
    struct report copy = *r;
    copy.lines = mem_alloc(r->count * sizeof *r->lines + 1);
    copy.capacity = r->count;
    for (uint32_t i = 0; i < r->count; i++) {
        copy.lines[i] = r->lines[i];
        copy.lines[i].text = mem_strdup(r->lines[i].text);
    }
    return copy;
}

void report_free(struct report *r)
{
    for (uint32_t i = 0; i < r->count; i++)
        free(r->lines[i].text);
    free(r->lines);
    *r = (struct report){0};
}

const struct report_line *report_first(const struct report *r, enum report_kind kind)
{
    for (uint32_t i = 0; i < r->count; i++)
        if (r->lines[i].kind == kind)
            return &r->lines[i];
    return NULL;
}
