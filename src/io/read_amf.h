// read_amf.h - AMF meshes, plain or zipped.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

// Reads `size` bytes, followed by a zero byte, welded. All objects of the file, one after another.
bool read_amf(const char *path, const char *data, size_t size, struct mesh *out, struct error *err);
