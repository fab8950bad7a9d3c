// convex_sum.h - Minkowski sums of convex shapes.
#pragma once
#include "geom/solid.h"

// The corners of a convex shape, each with the directions to its neighbours and with normals whose
// non-negative combinations are all directions in which it is an outermost point.
struct corners {
    struct vec3 *points, *edges, *normals;
    uint32_t *edge_ends, *normal_ends; // of corner i; it begins at the one before, or at 0
    uint32_t count;
};

void corners_of_mesh(struct corners *out, const struct mesh *convex);
// Of a flat convex polygon, counter-clockwise about its unit normal.
void corners_of_polygon(struct corners *out, const struct vec3 *points, uint32_t count,
                        struct vec3 normal);
void corners_free(struct corners *c); // leaves {0}

// False when the sum has no volume.
bool convex_sum(struct mesh *out, const struct corners *a, const struct corners *b);
