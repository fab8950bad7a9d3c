// mesh_file.h - meshes of STL files.
#pragma once
#include "geom/solid.h"

void mesh_load(struct mesh *out, const char *path); // ends the program with a line on errors
