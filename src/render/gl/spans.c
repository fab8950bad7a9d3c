// spans.c - the intervals of rows, put together from slabs and parts of the rows.
#include "render/gl/spans.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

// Where the spans of a pixel stand: at the places of the crossings that made them, or where the
// shader has put them.
static size_t place_of(const struct gl_work *w, const uint32_t *offsets, size_t i)
{
    return w->linked ? offsets[i] : offsets[i] / 2 + i;
}

static void compact(struct gl_span_part *p, const struct gl_work *w, const uint32_t *offsets,
                    const uint32_t *counts, const struct span *spans, size_t pixels)
{
    uint32_t total = 0;
    for (size_t i = 0; i < pixels; i++)
        total += counts[i];
    p->spans = mem_alloc((total + 1) * sizeof *spans);
    total = 0;
    for (size_t i = 0; i < pixels; i++) {
        p->first[i] = total;
        memcpy(p->spans + total, spans + place_of(w, offsets, i), counts[i] * sizeof *spans);
        total += counts[i];
    }
    p->first[pixels] = total;
}

bool gl_spans_add(struct gl_spans *s, struct gl_work *w, const struct frame_data *f,
                  struct error *err)
{
    size_t pixels = (size_t)f->columns * (size_t)f->rows;
    uint32_t *offsets = mem_alloc(pixels * 4), *counts = mem_alloc(pixels * 4);
    size_t size = (w->crossings / 2 + pixels) * sizeof(struct span);
    struct span *spans = mem_alloc(size);
    const struct gl_part parts[] = {
        {w->linked ? &w->links : &w->offsets, w->linked ? pixels * 4 : 0, pixels * 4, offsets},
        {&w->span_counts, 0, pixels * 4, counts},
        {&w->output, 0, size, spans}};
    bool fine = gl_work_read(w, parts, array_count(parts), err);
    if (fine) {
        array_reserve(&s->parts, &s->capacity, s->count + 1);
        struct gl_span_part *p = &s->parts[s->count++];
        *p = (struct gl_span_part){f->column, f->columns, mem_alloc((pixels + 1) * 4), NULL};
        compact(p, w, offsets, counts, spans, pixels);
    }
    free(offsets);
    free(counts);
    free(spans);
    return fine;
}

void gl_spans_keep(struct gl_spans *s, uint32_t count)
{
    while (s->count > count) {
        struct gl_span_part *p = &s->parts[--s->count];
        free(p->first);
        free(p->spans);
    }
}

// Where a pixel stands in a part; false: it is of other columns.
static bool find(const struct gl_span_part *p, uint32_t row, int x, size_t *at)
{
    *at = row * (size_t)p->columns + (size_t)(x - p->column);
    return x >= p->column && x < p->column + p->columns;
}

void gl_spans_row(const struct gl_spans *s, uint32_t row, int width, uint32_t **first,
                  struct span **spans)
{
    size_t total = 0, at;
    for (uint32_t k = 0; k < s->count; k++) {
        const struct gl_span_part *p = &s->parts[k];
        size_t begun = row * (size_t)p->columns;
        total += p->first[begun + (size_t)p->columns] - p->first[begun];
    }
    *first = mem_alloc(((size_t)width + 1) * sizeof **first);
    *spans = mem_alloc((total + 1) * sizeof **spans);
    uint32_t n = 0;
    for (int x = 0; x < width; x++) {
        (*first)[x] = n;
        for (uint32_t k = 0; k < s->count; k++) {
            const struct gl_span_part *p = &s->parts[k];
            if (!find(p, row, x, &at))
                continue;
            uint32_t count = p->first[at + 1] - p->first[at];
            memcpy(*spans + n, p->spans + p->first[at], count * sizeof **spans);
            n += count;
        }
    }
    (*first)[width] = n;
}

void gl_spans_free(struct gl_spans *s)
{
    gl_spans_keep(s, 0);
    free(s->parts);
    *s = (struct gl_spans){0};
}
