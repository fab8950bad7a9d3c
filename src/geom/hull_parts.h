// hull_parts.h - what the kinds of hulls have in common.
#pragma once
#include "geom/hull.h"

// The directions in which points spread: the point farthest from the first one, the one farthest
// from the line through these two, the one farthest from the plane through these three.
struct hull_span {
    uint32_t corner[4];
    int rank;           // 0 a point, 1 a line, 2 a plane, 3 a volume; -1 for NaN and infinity
    struct vec3 normal; // of the plane, a unit vector, where rank is 2 or more
};

// Distances count above the rounding of coordinates that went through a few matrices.
struct hull_span hull_span(const struct vec3 *points, uint32_t count);

// Faces of a hull: face i has the corners from ends[i - 1] (0 for the first) to ends[i], numbers of
// points, counter-clockwise from outside.
struct hull_faces {
    uint32_t *corners, *ends;
    uint32_t corner_count, face_count, corner_room, face_room;
};

// Faces of three corners each, put together where they lie in one plane up to `flat`. False when
// they do not close up or a face would have holes.
bool hull_merge(struct hull_faces *out, const struct hull_faces *triangles,
                const struct vec3 *points, uint32_t count, double flat);

// The hull of at most HULL_SMALL points that have rank 3, by trying all planes: the set-up of the
// library costs ten times that. False when rounding makes the faces doubtful.
enum { HULL_SMALL = 12 };
bool hull_small(struct hull_faces *out, const struct vec3 *points, uint32_t count);
