// border.h - whether a mesh is the border of a solid.
#pragma once
#include "geom/mesh.h"

// Does each edge have as many triangles on one side as on the other? Then each line leaves the mesh
// as often as it enters it. Faces count as they are, or as they were written.
bool mesh_is_balanced(const struct mesh *m, bool as_written);

// Are there holes, with the faces that were turned as they were written? Edges with more triangles
// on one side than on the other make holes, unless these have no area, as where a corner lies
// within an edge of its neighbour.
bool mesh_has_border(const struct mesh *m);
// The same; *middle is in the middle of the edges around one of them.
bool mesh_find_border(const struct mesh *m, struct vec3 *middle);
