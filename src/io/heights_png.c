// heights_png.c - grids of heights from the brightness of PNG pictures.
#include "base/mem.h"
#include "io/heights.h"
#include "io/read_png.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The inverse is taken from 1, though brightness runs to 255: OpenSCAD's formula.
static double height_of(const uint8_t *rgba, bool invert)
{
    double grey = 0.2126 * rgba[0] + 0.7152 * rgba[1] + 0.0722 * rgba[2];
    return 100.0 / 255 * (invert ? 1 - grey : grey);
}

bool heights_is_png(const char *data, size_t size)
{
    return size >= 8 && memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0;
}

bool heights_from_png(const char *path, const char *data, size_t size, bool invert,
                      struct heights *out, struct error *err)
{
    struct pixels p;
    if (!read_png(path, data, size, heights_allowed, &p, err))
        return false;
    struct heights h = {.rows = p.height, .columns = p.width, .lowest = INFINITY};
    h.z = mem_alloc((size_t)h.rows * h.columns * sizeof *h.z);
    for (uint32_t i = 0; i < h.rows; i++)
        for (uint32_t j = 0; j < h.columns; j++) {
            size_t from = (size_t)(h.rows - 1 - i) * h.columns + j;
            double z = height_of(p.rgba + 4 * from, invert);
            h.z[(size_t)i * h.columns + j] = z;
            h.lowest = fmin(h.lowest, z);
        }
    free(p.rgba);
    *out = h;
    return true;
}
