// read_surface.h - height fields from text (.dat) and PNG pictures.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

struct surface_options {
    bool center;
    bool invert; // pictures only
};

// Reads `size` bytes, followed by a zero byte: PNG by its signature, text otherwise.
bool read_surface(const char *path, const char *data, size_t size,
                  const struct surface_options *options, struct mesh *out,
                  struct messages *messages, struct error *err);
