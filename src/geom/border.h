// border.h - whether a mesh, as it was written, is the border of a solid.
#pragma once
#include "geom/mesh.h"

// Are there holes, with the faces that were turned as they were written? Edges with more triangles
// on one side than on the other make holes, unless these have no area, as where a corner lies
// within an edge of its neighbour.
bool mesh_has_border(const struct mesh *m);
