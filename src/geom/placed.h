// placed.h - meshes where an affine map puts them.
#pragma once
#include "geom/solid.h"

// The image of a mesh, facing outward also when the map mirrors. Faces and orders stay.
void mesh_placed(struct mesh *out, const struct mesh *m, const struct affine *a);

// The map that takes z = 0 to the plane of the largest triangle, x and y to unit vectors in it.
void mesh_largest_plane(const struct mesh *m, struct affine *out);
double mesh_area(const struct mesh *m); // of all triangles
