// outline.h - flat shapes: closed paths in the plane.
#pragma once
#include "base/vec.h"

#include <stdint.h>

// Path i has the points from ends[i - 1] (0 for the first) to ends[i]; the last joins the first.
// Clean: no path crosses itself or another one, outer paths run counter-clockwise, holes clockwise.
// Otherwise a point is inside when it lies in an odd number of paths. {0} is a valid empty outline.
struct outline {
    struct vec2 *points;
    uint32_t *ends;
    uint32_t point_count, path_count;
    uint32_t point_room, path_room;
    bool clean;
};

// Points come one after another, then the path they form is closed. A path of fewer than three
// points is dropped.
void outline_add(struct outline *o, struct vec2 p);
void outline_close(struct outline *o);
void outline_append(struct outline *o, const struct outline *more); // all paths; `clean` stays
void outline_copy(struct outline *out, const struct outline *o);
void outline_free(struct outline *o); // leaves {0}

// Applies rows 0 and 1, columns 0, 1 and 3 of the map: what OpenSCAD takes of it for flat shapes.
void outline_transform(struct outline *o, const struct affine *a);
// The box of all points, z from 0 to 0; empty without points.
struct box outline_bounds(const struct outline *o);
double outline_area(const struct outline *o);    // signed sum over the paths
bool outline_is_convex(const struct outline *o); // one counter-clockwise path without dents
uint64_t outline_hash(const struct outline *o);

// Cuts the inside of a clean outline into counter-clockwise triangles over its own points, in
// n log n. *triangles is the caller's to free. Points where paths touch may be used by any of them.
void outline_triangulate(const struct outline *o, uint32_t (**triangles)[3], uint32_t *count);
// The same of paths that only may be clean; clockwise ones give clockwise triangles. False, with
// nothing to free, where they cross or touch.
bool outline_try_triangulate(const struct outline *o, uint32_t (**triangles)[3], uint32_t *count);
