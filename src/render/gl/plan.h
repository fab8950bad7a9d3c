// plan.h - how the budget of a picture is divided among its buffers.
#pragma once
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

// All buffers that grow with the picture find room in the budget at once, whatever it shows:
//   1/16  records of unknown combinations, at most 4 MB
//   1/16  what comes back to the processor at a time, at most 16 MB
//   1/64  claims, at most 256 KB
//   1/8   pieces of large triangles
//   1/4   pixels of a band, 60 bytes each, or 72 for spans
//   the rest: crossings of a slab, 16 bytes each, or 28 for spans; 4 more when lists are linked
// None is larger than what a shader can use. What has one entry per leaf or per combination is as
// large as the model and counts as such.
struct gl_plan {
    int rows, columns; // of a band; more rows than one only when it has all columns
    size_t numbers;    // that are summed up at a time
    uint32_t fragments, pieces, miss_words, claims;
    size_t staging; // bytes that come back at a time
};

enum { GL_MEMORY_LEAST = 64 << 10 }; // of a budget

// `storage`: bytes of the largest buffer that a shader can use. False when the budget is too small.
bool gl_plan_make(struct gl_plan *out, size_t budget, size_t storage, int width, int height,
                  uint32_t leaves, bool spans, bool linked, struct error *err);
