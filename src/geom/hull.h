// hull.h - convex hulls.
#pragma once
#include "geom/outline.h"
#include "geom/solid.h"

// The convex hull of points, with flat faces whole (one face number, a fan of triangles) and only
// its corners as vertices. False, with an empty mesh, when the points are all in one plane (see
// hull_sheet), or fewer than four. Thread-safe.
bool hull_solid(struct mesh *out, const struct vec3 *points, uint32_t count);
// Of points in one plane: the hull as a sheet of two sides. False for points on one line.
bool hull_sheet(struct mesh *out, const struct vec3 *points, uint32_t count);
// The convex hull in the plane, counter-clockwise, strictly convex corners only; clean.
void hull_outline(struct outline *out, const struct vec2 *points, uint32_t count);
