// write_stl.h - meshes as STL files.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

// Text: the numbers of the binary form have 24 bits only. "-" is standard output; no file is left
// behind on errors.
bool write_stl(const char *path, const struct mesh *m, struct error *err);
