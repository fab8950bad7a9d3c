// read_obj.h - Wavefront OBJ meshes.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

// Reads `size` bytes, followed by a zero byte, welded. Faces of any number of corners, of all
// objects. What is left out is said in `messages`.
bool read_obj(const char *path, const char *data, size_t size, struct mesh *out,
              struct messages *messages, struct error *err);
