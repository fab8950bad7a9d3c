// minkowski.h - the Minkowski sum of two solids as a union of simple ones.
//
// Of two convex solids it is one convex part. Of a solid A and a convex B it is A moved to a corner
// of B, where B has room within A, and the hulls of the sums of each flat face of A with B; of any
// two solids, both moved to corners of the other one and prisms: sums of an edge of one and a face
// of the other. Nothing is evaluated to one mesh: a renderer of unions takes it as it is.
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

// What can be told not to be needed is left out; solids in several pieces are taken piece by piece.
// False, with an empty sum, when it would have more than `most` parts or when finding them would
// take more than about 2^30 steps for two of the pieces. `threads` as for parallel_for.
bool minkowski_parts(struct minkowski_sum *out, const struct solid *a, const struct solid *b,
                     uint32_t most, uint32_t threads);
void minkowski_free(struct minkowski_sum *s); // leaves {0}
