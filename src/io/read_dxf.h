// read_dxf.h - flat shapes from DXF drawings.
#pragma once
#include "base/error.h"
#include "geom/outline.h"
#include "geom/primitives.h"

#include <stddef.h>

struct dxf_options {
    const char *layer; // "" or NULL: all
    double origin_x, origin_y, scale;
    struct detail detail; // of arcs and circles
};

// Reads `size` bytes, followed by a zero byte. What is left out is said in `messages`.
bool read_dxf(const char *path, const char *data, size_t size, const struct dxf_options *options,
              struct outline *out, struct messages *messages, struct error *err);
