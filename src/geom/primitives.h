// primitives.h - cube, sphere and cylinder in the faces that OpenSCAD cuts them into, in its order.
#pragma once
#include "geom/solid.h"

struct detail { // $fn, $fa, $fs
    double fn, fa, fs;
};
#define DETAIL_DEFAULT ((struct detail){0, 12, 2})

// Above these numbers of corners the shape changes by less than the numbers of a file can say.
enum { SPHERE_FRAGMENTS_MAX = 1000, CIRCLE_FRAGMENTS_MAX = 100000 };

// Corners of a full circle of radius r; UINT32_MAX stands for everything above.
uint32_t circle_fragments(double r, struct detail detail);

// The cube from (0, 0, 0) to (1, 1, 1).
void primitive_cube(struct mesh *out);
// The sphere of radius 1 with `n` corners around. It has flat caps, no poles, so it is lower
// than 2.
void primitive_sphere(struct mesh *out, uint32_t n);
// A cylinder or cone from z = 0, radius r1, to z = 1, radius r2. At most one radius may be 0.
void primitive_cylinder(struct mesh *out, uint32_t n, double r1, double r2);
