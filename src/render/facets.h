// facets.h - the triangles as which OpenSCAD draws solids, and which of their sides are edges.
//
// What is drawn of a solid (enum solid_cut) are faces or triangles. A face of four corners is drawn
// as two triangles whose common side is hidden, a larger one as a fan around the average of its
// corners, whose spokes are hidden.
#pragma once
#include "model/model.h"

struct facet {
    struct vec3 corners[3]; // in the solid's coordinates
    struct vec3 normal;     // outwards, of any length
    bool edge[3];           // the side opposite to that corner shows
};

// Made once for a model, which is borrowed.
struct facets;
struct facets *facets_new(const struct model *m);
void facets_delete(struct facets *f);

// The triangle of a face that a line goes through, or passes most closely; in the coordinates of
// the leaf's solid. False when the line does not meet the face.
bool facets_find(const struct facets *d, const struct solid *solid, uint32_t face,
                 struct vec3 origin, struct vec3 direction, struct facet *out);

// Calls `side` for each side of each face or triangle as which a solid is drawn; of the plate of a
// flat shape those of its outline.
void facets_sides(const struct facets *d, const struct solid *solid, void *context,
                  void (*side)(void *context, struct vec3 from, struct vec3 to));

// Shares of the corners where a line meets the plane of a triangle: they sum up to 1, and each is 0
// on the side opposite to its corner. Not finite when the line lies in the plane.
struct vec3 facets_shares(const struct facet *t, struct vec3 origin, struct vec3 direction);

// The vertices around a face of a convex solid, counter-clockwise seen from outside. NULL for those
// of other solids.
const uint32_t *facets_corners(const struct facets *d, const struct solid *solid, uint32_t face,
                               uint32_t *count);
