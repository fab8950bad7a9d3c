// write_off.h - meshes as OFF files.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

// "-" is standard output; no file is left behind on errors.
bool write_off(const char *path, const struct mesh *m, struct error *err);
