// clip.h - 2D booleans, offsets and sums, on the Clipper library with OpenSCAD's grid.
//
// Coordinates are cut off to multiples of 1/65536, as OpenSCAD does it, so that vertices come out
// equal to OpenSCAD's. Results are clean. Coordinates beyond Clipper's range, more points than
// CLIP_POINTS_MOST, hundred thousands of crossings and shapes that would keep Clipper busy for more
// than minutes make a function return false with an empty result. All functions are thread-safe.
#pragma once
#include "geom/outline.h"
#include "geom/primitives.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CLIP_POINTS_MOST = 1 << 24 };
#define CLIP_REFUSED                                                                               \
    "is too large, or crosses itself too often" // what to say when it returns false

// The shape of arbitrary paths: inside is what lies in an odd number of them.
bool clip_clean(struct outline *out, const struct outline *in);

// Of `count` shapes, of which NULL is the empty one: all together; the first without the others;
// what is common to all, pair by pair from the left. A single shape is copied as it is. Shapes that
// are not clean are cleaned first.
bool clip_union(struct outline *out, const struct outline *const *shapes, uint32_t count);
bool clip_difference(struct outline *out, const struct outline *const *shapes, uint32_t count);
bool clip_intersection(struct outline *out, const struct outline *const *shapes, uint32_t count);

// All together of shapes with paths in either direction that may cross each other, as in fonts:
// inside of each is what its paths wind around.
bool clip_nonzero(struct outline *out, const struct outline *const *shapes, uint32_t count);

enum clip_join { CLIP_ROUND, CLIP_MITRE, CLIP_CHAMFER };

// Grown by `distance`, shrunk when it is negative. `detail` says how fine round corners are.
bool clip_offset(struct outline *out, const struct outline *in, double distance,
                 enum clip_join join, struct detail detail);
// All points between a line and the lines at half of `width` to both of its sides. Its coordinates
// are cut off to multiples of 1/10000, those of the result are not cut off any further: so OpenSCAD
// draws the lines of SVG files.
enum clip_cap { CLIP_CAP_BUTT, CLIP_CAP_ROUND, CLIP_CAP_SQUARE };
bool clip_stroke(struct outline *out, const struct vec2 *line, uint32_t count, double width,
                 enum clip_cap cap, enum clip_join join);
// The Minkowski sum of two shapes; its holes stay.
bool clip_minkowski(struct outline *out, const struct outline *a, const struct outline *b);
// The shape without its holes.
bool clip_fill(struct outline *out, const struct outline *in);

#ifdef __cplusplus
}
#endif
