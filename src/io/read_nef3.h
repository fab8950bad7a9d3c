// read_nef3.h - NEF3 solids: CGAL's text form of Nef polyhedra, which OpenSCAD writes.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

// Reads `size` bytes, followed by a zero byte: the surface between marked volumes and others,
// welded. `path` stands in messages.
bool read_nef3(const char *path, const char *data, size_t size, struct mesh *out,
               struct error *err);
