// read_png.h - PNG files as pixels.
#pragma once
#include "base/error.h"

#include <stddef.h>

struct pixels { // {0} is empty; free .rgba
    uint32_t width, height;
    uint8_t *rgba; // rows from the top
};

// PNG of any kind, without correction of its gamma; of 16 bits the upper 8. `path` is for messages;
// `allowed` says with *err whether a picture of this size is wanted.
bool read_png(const char *path, const char *data, size_t size,
              bool (*allowed)(const char *path, uint64_t rows, uint64_t columns, struct error *err),
              struct pixels *out, struct error *err);
