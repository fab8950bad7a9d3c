// winding.h - what the winding numbers around a mesh may be.
#pragma once
#include "geom/solid.h"

// Is no winding number around a balanced mesh below 0, whatever overlaps? True is certain; false is
// in doubt.
bool mesh_is_never_inside_out(const struct mesh *m);
