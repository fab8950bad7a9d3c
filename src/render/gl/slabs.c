// slabs.c - where the slabs of depth of a band end.
#include "render/gl/slabs.h"

#include "base/mem.h"
#include "shaders/shared.h"

#include <stdlib.h>

// Puts a slab on top that ends behind bin b.
static void push(struct gl_slabs *s, uint32_t below, float from, float to, uint32_t b)
{
    double share = (b + 1.0) / BINS;
    float end = (float)((double)from + ((double)to - (double)from) * share);
    bool inside = end > from && end < to;
    if (!inside || (s->count > below && !(end < s->ends[s->count - 1])))
        return;
    array_reserve(&s->ends, &s->capacity, s->count + 1);
    s->ends[s->count++] = end;
}

void gl_slabs_begin(struct gl_slabs *s, float end)
{
    array_reserve(&s->ends, &s->capacity, 1);
    s->ends[0] = end;
    s->count = 1;
}

bool gl_slabs_cut(struct gl_slabs *s, const uint32_t *bins, float from, float to, uint64_t most,
                  uint32_t wanted)
{
    uint32_t below = s->count;
    uint32_t left = wanted > BINS ? BINS - 1 : wanted > 1 ? wanted - 1 : 0; // ends to be found
    uint64_t total = 0, sum = 0;
    for (uint32_t b = 0; b < BINS; b++)
        total += bins[b];
    uint64_t share = total / (left + 1);
    most = share < most ? share : most;
    // From the back, so that the nearest slab comes to lie on top.
    for (uint32_t b = BINS - 1; b-- > 0;) {
        sum += bins[b + 1];
        if ((!sum || sum + bins[b] <= most) && left < b + 1)
            continue;
        push(s, below, from, to, b);
        left -= left > 0;
        sum = 0;
    }
    if (s->count == below) // all in one bin, or the counts are wrong: they may be beyond 2^32
        push(s, below, from, to, BINS / 2 - 1);
    for (uint32_t b = 0; b < BINS && s->count == below; b++)
        push(s, below, from, to, b);
    return s->count > below;
}

void gl_slabs_free(struct gl_slabs *s)
{
    free(s->ends);
    *s = (struct gl_slabs){0};
}
