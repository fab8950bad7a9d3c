// minkowski.h - the Minkowski sum of two solids as a union of simple ones.
//
// For solids A and B with boundaries dA and dB the sum is the union of A moved to one vertex of
// each component of dB, B moved to one vertex of each component of dA, and the hulls of all pairs
// of a triangle of dA and a triangle of dB; when B is convex, of A and the hulls of each triangle
// of dA with B. Nothing is evaluated to one mesh: a renderer of unions takes it as it is.
#pragma once
#include "geom/solid.h"

struct minkowski_part {
    struct mesh mesh;
    bool convex;
};

struct minkowski_sum { // {0} is empty
    struct minkowski_part *parts;
    uint32_t count, room;
};

// Parts that lie inside of others, as far as that is cheap to see, are left out. False, with an
// empty sum, when it would have more than `most` parts. `threads` as for parallel_for.
bool minkowski_parts(struct minkowski_sum *out, const struct solid *a, const struct solid *b,
                     uint32_t most, uint32_t threads);
void minkowski_free(struct minkowski_sum *s); // leaves {0}
