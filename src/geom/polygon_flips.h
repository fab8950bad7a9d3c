// polygon_flips.h - the diagonals that OpenSCAD's tessellator chooses in bent polygons.
#pragma once
#include "base/vec.h"
#include <stdint.h>

// The axis (0 to 2) along which it looks at a polygon. *sign: 1 where it is counter-clockwise seen
// against that axis, else -1.
uint32_t polygon_axis(const struct vec3 *vertices, const uint32_t *corners, uint32_t count,
                      double *sign);
// Flips diagonals until all are Delaunay by its measure, seen along the axis. The triangles must be
// in the order in which GLU gives them, which decides where several results would do.
void polygon_flip(const struct vec3 *vertices, uint32_t axis, uint32_t (*triangles)[3],
                  uint32_t count);
