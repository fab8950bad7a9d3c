// read_png.c - PNG files as pixels, through libpng.
#include "io/read_png.h"

#include "base/mem.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

struct source {
    const char *path;
    struct error *err;
    const char *at, *end; // of the file
    bool (*allowed)(const char *path, uint64_t rows, uint64_t columns, struct error *err);
    struct pixels pixels;
};

static void read_bytes(png_structp png, png_bytep out, size_t length)
{
    struct source *s = png_get_io_ptr(png);
    if ((size_t)(s->end - s->at) < length)
        png_error(png, "the file ends too early");
    memcpy(out, s->at, length);
    s->at += length;
}

static void keep_message(png_structp png, png_const_charp text)
{
    struct source *s = png_get_error_ptr(png);
    error_set(s->err, "%s: PNG: %s", s->path, text);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

// All kinds of pictures as four bytes per pixel.
static void as_rgba(png_structp png)
{
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
}

static bool decode(struct source *s)
{
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, s, keep_message, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_read_struct(&png, NULL, NULL);
        error_set(s->err, "%s: PNG: out of memory", s->path);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, NULL);
        return false;
    }
    struct pixels *p = &s->pixels;
    png_set_read_fn(png, s, read_bytes);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // `allowed` says it better
    png_read_info(png, info);
    p->width = png_get_image_width(png, info);
    p->height = png_get_image_height(png, info);
    if (!s->allowed(s->path, p->height, p->width, s->err))
        png_longjmp(png, 1);
    as_rgba(png);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    size_t row = (size_t)p->width * 4;
    if (png_get_rowbytes(png, info) != row)
        png_error(png, "an unknown kind of pixels");
    p->rgba = mem_zalloc(row * p->height);
    for (; passes; passes--)
        for (uint32_t y = 0; y < p->height; y++)
            png_read_row(png, p->rgba + y * row, NULL);
    png_destroy_read_struct(&png, &info, NULL);
    return true;
}

bool read_png(const char *path, const char *data, size_t size,
              bool (*allowed)(const char *path, uint64_t rows, uint64_t columns, struct error *err),
              struct pixels *out, struct error *err)
{
    struct source s = {
        .path = path, .err = err, .at = data, .end = data + size, .allowed = allowed};
    if (!decode(&s)) {
        free(s.pixels.rgba);
        return false;
    }
    *out = s.pixels;
    return true;
}
