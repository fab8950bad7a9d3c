// bend.h - the flat parts into which a face breaks when its corners move onto a grid.
//
// OpenSCAD's geometry cuts coordinates to multiples of 2^-20 and takes the hull of the corners of a
// convex solid. Faces of four or more corners that are not parallel to an axis are then flat in
// parts only, with edges between them: which ones is decided by the last bits of the coordinates.
#pragma once
#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

// Polygons, each a run of corners; {0} is a valid empty one, which bend_face adds to.
struct bends {
    uint32_t *corners, *ends;
    uint32_t corner_count, corner_room, count, end_room; // of polygons: count
};

// Adds the parts of a convex face by the numbers of its corners, in their order, which is
// counter-clockwise seen from outside, or clockwise.
void bend_face(struct bends *b, const struct vec3 *corners, uint32_t count, bool clockwise);
void bends_free(struct bends *b); // leaves {0}
