// extrude.h - solids from flat shapes, with OpenSCAD's vertices, slices and diagonals.
#pragma once
#include "base/error.h"
#include "geom/outline.h"
#include "geom/primitives.h"
#include "geom/solid.h"

struct linear_extrusion {
    double height; // along z; empty unless above 0
    bool center;
    double twist; // degrees, clockwise from below to above
    double scale_x, scale_y;
    uint32_t slices;     // 0: by the rule
    bool newer;          // the rules of OpenSCAD after 2021.01: edges are cut for twist and scale,
    uint32_t segments;   // by this number, 0: by the rule ...
    bool segments_given; // ... unless 0 was given
    bool has_direction;
    struct vec3 direction; // newer: slanted; its length is the height
    struct detail detail;
};

// The outline is clean. *convex is set when the solid is known to be convex: its faces are whole
// then, not single triangles. An empty mesh is a result; false when it would have more than
// EXTRUSION_TRIANGLES_MOST triangles.
enum { EXTRUSION_TRIANGLES_MOST = 1 << 23 };
bool extrude_linear(struct mesh *out, const struct outline *o, const struct linear_extrusion *how,
                    bool *convex, struct error *err);

struct rotation_extrusion {
    double angle; // degrees, -360 .. 360
    bool newer;   // begins at `start` and rounds corner counts up
    double start; // degrees from +x
    struct detail detail;
};

// The outline's x is the distance from the z axis, its y becomes z. False when it lies on both
// sides of the axis, or as above.
bool extrude_rotate(struct mesh *out, const struct outline *o, const struct rotation_extrusion *how,
                    struct error *err);

// The plate of the outline between two heights, as the preview shows flat shapes.
void extrude_slab(struct mesh *out, const struct outline *o, double low, double high, bool *convex);
