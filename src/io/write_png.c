// write_png.c - pictures as PNG files, through libpng.
#include "io/write_png.h"

#include "base/file.h"
#include "base/mem.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

struct sink {
    uint8_t *data;
    size_t used, size;
};

static void sink_write(png_structp png, png_bytep data, size_t length)
{
    struct sink *s = png_get_io_ptr(png);
    if (s->size - s->used < length) {
        s->size = 2 * s->size + length;
        s->data = mem_realloc(s->data, s->size);
    }
    memcpy(s->data + s->used, data, length);
    s->used += length;
}

static void sink_flush(png_structp png)
{
    (void)png;
}

static void keep_message(png_structp png, png_const_charp text)
{
    error_set(png_get_error_ptr(png), "PNG: %s", text);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

// False with *err when libpng gives up; s->data is the caller's in any case.
static bool encode(struct sink *s, const uint8_t *rgb, int width, int height, struct error *err)
{
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, err, keep_message, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        error_set(err, "PNG: out of memory");
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, s, sink_write, sink_flush);
    png_set_user_limits(png, (png_uint_32)width, (png_uint_32)height);
    // Flat areas repeat the row above: this filter and the fastest level lose little to the best
    // ones and take a tenth of their time.
    png_set_filter(png, 0, PNG_FILTER_UP);
    png_set_compression_level(png, 1);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < height; y++)
        png_write_row(png, rgb + (size_t)y * (size_t)width * 3);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}

bool write_png(const char *path, const uint8_t *rgb, int width, int height, struct error *err)
{
    struct sink s = {.size = 1 << 16};
    s.data = mem_alloc(s.size);
    bool ok = encode(&s, rgb, width, height, err) && file_write(path, s.data, s.used, err);
    free(s.data);
    return ok;
}
