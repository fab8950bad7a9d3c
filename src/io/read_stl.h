// read_stl.h - STL meshes, binary and text.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

// Reads `size` bytes, followed by a zero byte, welded. `path` stands in messages.
bool read_stl(const char *path, const char *data, size_t size, struct mesh *out, struct error *err);
