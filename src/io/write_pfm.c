// write_pfm.c - numbers per pixel as PFM files.
#include "io/write_pfm.h"

#include "base/file.h"
#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

static void put_little_endian(uint8_t *out, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    for (int i = 0; i < 4; i++)
        out[i] = (uint8_t)(bits >> (8 * i));
}

bool write_pfm(const char *path, const float *values, int width, int height, struct error *err)
{
    char head[64];
    // The sign of the scale says that the bytes are in little endian order.
    int used = snprintf(head, sizeof head, "Pf\n%d %d\n-1.0\n", width, height);
    size_t columns = (size_t)width, rows = (size_t)height, size = (size_t)used + 4 * columns * rows;
    uint8_t *data = mem_alloc(size), *at = data + used;
    memcpy(data, head, (size_t)used);
    for (size_t y = rows; y-- > 0;)
        for (size_t x = 0; x < columns; x++, at += 4)
            put_little_endian(at, values[y * columns + x]);
    bool ok = file_write(path, data, size, err);
    free(data);
    return ok;
}
