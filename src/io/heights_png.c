// heights_png.c - grids of heights from the brightness of PNG pictures, through libpng.
#include "base/mem.h"
#include "io/heights.h"

#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

struct picture {
    const char *path;
    struct error *err;
    const char *at, *end; // of the file
    uint8_t *rgb;         // rows from the top
    uint32_t width, height;
};

static void read_bytes(png_structp png, png_bytep out, size_t length)
{
    struct picture *p = png_get_io_ptr(png);
    if ((size_t)(p->end - p->at) < length)
        png_error(png, "the file ends too early");
    memcpy(out, p->at, length);
    p->at += length;
}

static void keep_message(png_structp png, png_const_charp text)
{
    struct picture *p = png_get_error_ptr(png);
    error_set(p->err, "%s: PNG: %s", p->path, text);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

// All kinds of pictures as three bytes per pixel, without correction of their gamma.
static void as_rgb(png_structp png)
{
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_strip_alpha(png);
}

static bool decode(struct picture *p)
{
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, p, keep_message, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_read_struct(&png, NULL, NULL);
        error_set(p->err, "%s: PNG: out of memory", p->path);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, NULL);
        return false;
    }
    png_set_read_fn(png, p, read_bytes);
    png_set_user_limits(png, HEIGHTS_MOST, HEIGHTS_MOST);
    png_read_info(png, info);
    p->width = png_get_image_width(png, info);
    p->height = png_get_image_height(png, info);
    if (!heights_allowed(p->path, p->height, p->width, p->err))
        png_longjmp(png, 1);
    as_rgb(png);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    size_t row = (size_t)p->width * 3;
    if (png_get_rowbytes(png, info) != row)
        png_error(png, "an unknown kind of pixels");
    p->rgb = mem_zalloc(row * p->height);
    for (; passes; passes--)
        for (uint32_t y = 0; y < p->height; y++)
            png_read_row(png, p->rgb + y * row, NULL);
    png_destroy_read_struct(&png, &info, NULL);
    return true;
}

// The inverse is taken from 1, though brightness runs to 255: OpenSCAD's formula.
static double height_of(const uint8_t *rgb, bool invert)
{
    double grey = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    return 100.0 / 255 * (invert ? 1 - grey : grey);
}

bool heights_is_png(const char *data, size_t size)
{
    return size >= 8 && memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0;
}

bool heights_from_png(const char *path, const char *data, size_t size, bool invert,
                      struct heights *out, struct error *err)
{
    struct picture p = {.path = path, .err = err, .at = data, .end = data + size};
    if (!decode(&p)) {
        free(p.rgb);
        return false;
    }
    struct heights h = {.rows = p.height, .columns = p.width, .lowest = INFINITY};
    h.z = mem_alloc((size_t)h.rows * h.columns * sizeof *h.z);
    for (uint32_t i = 0; i < h.rows; i++)
        for (uint32_t j = 0; j < h.columns; j++) {
            size_t from = (size_t)(h.rows - 1 - i) * h.columns + j;
            double z = height_of(p.rgb + 3 * from, invert);
            h.z[(size_t)i * h.columns + j] = z;
            h.lowest = fmin(h.lowest, z);
        }
    free(p.rgb);
    *out = h;
    return true;
}
