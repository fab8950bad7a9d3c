// spans.h - the intervals of rows, put together from slabs and parts of the rows.
#pragma once
#include "render/gl/passes.h"

// What a slab has of the pixels of a band: pixel i of it has spans[first[i] .. first[i + 1]).
struct gl_span_part {
    int column, columns;
    uint32_t *first;
    struct span *spans;
};

struct gl_spans {               // {0} is valid
    struct gl_span_part *parts; // nearer ones of a pixel first
    uint32_t count, capacity;
};

// Adds those of the band and slab that was drawn. False when the driver was reset.
bool gl_spans_add(struct gl_spans *s, struct gl_work *w, const struct frame_data *f,
                  struct error *err);
void gl_spans_keep(struct gl_spans *s, uint32_t count); // forgets the parts beyond the first ones

// Row `row` of those that were added, as one block; *first and *spans are to be freed.
void gl_spans_row(const struct gl_spans *s, uint32_t row, int width, uint32_t **first,
                  struct span **spans);
void gl_spans_free(struct gl_spans *s); // leaves {0}
