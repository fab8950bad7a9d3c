// polygon.h - cutting arbitrary polygons in space into triangles.
#pragma once
#include "geom/mesh.h"

struct polygon_cutter; // working memory that serves many polygons

struct polygon_cutter *polygon_cutter_new(void);
void polygon_cutter_delete(struct polygon_cutter *c); // accepts NULL

// Adds the polygon over vertices of `b` (counter-clockwise from outside) as triangles. It may be
// concave and cross itself. A flat polygon becomes one face: odd winding counts as inside,
// crossings become new vertices. A bent one becomes a face per triangle, over its own corners, with
// OpenSCAD's diagonals. Returns false, adding nothing, when fewer than three different corners are
// left or it cannot be cut, also for crossing itself so often that it would take minutes.
bool polygon_cut(struct polygon_cutter *c, struct mesh_builder *b, const uint32_t *corners,
                 uint32_t count);
// Could the last one not be cut, though it has three different corners?
bool polygon_failed(const struct polygon_cutter *c);
// What to say of those.
#define POLYGONS_LEFT_OUT "faces that cross themselves too often: %u left out"
