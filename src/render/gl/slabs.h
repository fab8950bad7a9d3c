// slabs.h - where the slabs of depth of a band end.
#pragma once
#include <stdbool.h>
#include <stdint.h>

struct gl_slabs { // {0} is valid
    float *ends;  // of the slabs to come, the nearest last
    uint32_t count, capacity;
};

void gl_slabs_begin(struct gl_slabs *s, float end); // one slab, up to `end`

// Cuts the nearest slab to come, of which `bins` (BINS numbers, shared.h) tell how many crossings
// lie in each part of [from, to], into such with at most `most` crossings as far as the bins can
// tell, and at least `wanted` of them. False when no number lies between `from` and `to`.
bool gl_slabs_cut(struct gl_slabs *s, const uint32_t *bins, float from, float to, uint64_t most,
                  uint32_t wanted);
void gl_slabs_free(struct gl_slabs *s); // leaves {0}
