// read_off.h - OFF meshes of any polygons.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

// Reads `size` bytes, followed by a zero byte, welded. `path` stands in messages, which say what is
// left out.
bool read_off(const char *path, const char *data, size_t size, struct mesh *out,
              struct messages *messages, struct error *err);
