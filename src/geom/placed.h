// placed.h - meshes where an affine map puts them.
#pragma once
#include "geom/solid.h"

// The image of a mesh, facing outward also when the map mirrors. Faces and orders stay.
void mesh_placed(struct mesh *out, const struct mesh *m, const struct affine *a);
