// heights.h - grids of heights, and the two kinds of files that hold them.
#pragma once
#include "base/error.h"

#include <stddef.h>

// The most heights of a grid: 4096 x 4096, which makes 67 million triangles.
enum { HEIGHTS_MOST = 1 << 24 };

struct heights {
    double *z; // rows * columns, from the smallest y; what a short row lacks is 0
    uint32_t rows, columns;
    double lowest; // of those given
};

bool heights_allowed(const char *path, uint64_t rows, uint64_t columns, struct error *err);

// Lines of numbers; reading ends with a warning at a word that is none.
bool heights_from_text(const char *path, const char *data, size_t size, struct heights *out,
                       struct messages *messages, struct error *err);

bool heights_is_png(const char *data, size_t size);
// Brightness from 0 to 100, of any kind of PNG; alpha does not count.
bool heights_from_png(const char *path, const char *data, size_t size, bool invert,
                      struct heights *out, struct error *err);
