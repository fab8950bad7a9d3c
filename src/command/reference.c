// reference.c - the picture that was drawn against one that is expected.
#include "command/reference.h"

#include "base/file.h"
#include "base/mem.h"
#include "command/command.h"
#include "io/read_png.h"
#include "render/compare.h"

#include <stdlib.h>
#include <string.h>

enum { FILE_MOST = 1 << 30 };

static bool is_picture(const char *path, uint64_t rows, uint64_t columns, struct error *err)
{
    if (rows <= PIXELS_MOST / columns) // neither is 0
        return true;
    error_set(err, "%s: a picture of %llu x %llu pixels, more than the limit of %d", path,
              (unsigned long long)columns, (unsigned long long)rows, PIXELS_MOST);
    return false;
}

static bool read_reference(struct pixels *out, const char *path, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(path, FILE_MOST, &data, &size, err))
        return false;
    bool ok = read_png(path, data, size, is_picture, out, err);
    free(data);
    return ok;
}

// The drawn picture with four channels. The caller frees it.
static uint8_t *as_rgba(const struct drawn *d)
{
    size_t n = (size_t)d->width * (size_t)d->height;
    uint8_t *rgba = mem_alloc(4 * n);
    for (size_t i = 0; i < n; i++) {
        rgba[4 * i + 3] = 255;
        memcpy(rgba + 4 * i, d->pixels + d->channels * i, d->channels);
    }
    return rgba;
}

static int compare(const struct request *r, const struct drawn *d, const struct pixels *expected,
                   struct error *err)
{
    const char *path = r->style.reference;
    if (expected->width != (uint32_t)d->width || expected->height != (uint32_t)d->height) {
        error_set(err, "%s: is %u x %u pixels, the picture %d x %d", path, expected->width,
                  expected->height, d->width, d->height);
        return EXIT_CHECK;
    }
    uint8_t *drawn = as_rgba(d);
    struct comparison c =
        pictures_compare(drawn, expected->rgba, d->width, d->height, r->style.levels);
    double all = (double)d->width * d->height;
    free(drawn);
    if ((double)c.differing <= r->style.share * all)
        return EXIT_FINE;
    error_set(err,
              "%s: %llu of %.0f pixels differ (%.3g %%), the largest difference is %d at %d,%d",
              path, (unsigned long long)c.differing, all, 100 * (double)c.differing / all,
              c.largest, c.x, c.y);
    return EXIT_CHECK;
}

int reference_check(const struct request *r, const struct drawn *d, struct error *err)
{
    struct pixels expected;
    if (!read_reference(&expected, r->style.reference, err))
        return EXIT_INPUT;
    int code = compare(r, d, &expected, err);
    free(expected.rgba);
    return code;
}
