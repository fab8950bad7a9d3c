// bent.h - the faces of a body's convex leaves as OpenSCAD's geometry has them: in flat parts.
#pragma once
#include "render/facets.h"

// Parts are found when they are first asked for. What is given is borrowed.
struct bent;
struct bent *bent_new(const struct body *body, const struct facets *facets);
void bent_delete(struct bent *b);

struct bent_part {
    const uint32_t *corners; // vertices of the leaf's solid, counter-clockwise seen from outside
    uint32_t count;          // 0: the face is flat, or of a leaf that is not convex
    struct vec3 normal;      // outwards
};
// The part of a face that a line goes through, or passes most closely; in the coordinates of the
// leaf's solid.
struct bent_part bent_find(struct bent *b, uint32_t leaf, uint32_t face, struct vec3 origin,
                           struct vec3 direction);

// On which side of the side from corner k to the next a line passes: positive inside, and between
// rays of a picture as affine as these.
double bent_side(const struct solid *solid, struct bent_part p, uint32_t k, struct vec3 origin,
                 struct vec3 direction);

// The other ends of the edges at a vertex of a convex leaf's solid, of which a part was found.
const uint32_t *bent_edges(const struct bent *b, uint32_t leaf, uint32_t vertex, uint32_t *count);
