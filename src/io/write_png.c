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

struct layout {
    int depth, colour, bytes; // bits of a channel, PNG_COLOR_TYPE_*, bytes of a pixel
};

static struct layout layout_of(enum png_kind kind)
{
    switch (kind) {
    case PNG_KIND_RGBA:
        return (struct layout){8, PNG_COLOR_TYPE_RGB_ALPHA, 4};
    case PNG_KIND_GREY16:
        return (struct layout){16, PNG_COLOR_TYPE_GRAY, 2};
    case PNG_KIND_RGB:
        break;
    }
    return (struct layout){8, PNG_COLOR_TYPE_RGB, 3};
}

static void add_notes(png_structp png, png_infop info, const struct png_picture *p)
{
    for (uint32_t i = 0; i < p->note_count; i++) {
        size_t length = strlen(p->notes[i].text);
        png_text note = {.compression =
                             length < 1024 ? PNG_TEXT_COMPRESSION_NONE : PNG_TEXT_COMPRESSION_zTXt,
                         .key = (char *)p->notes[i].key,
                         .text = (char *)p->notes[i].text,
                         .text_length = length};
        png_set_text(png, info, &note, 1);
    }
}

// False with *err when libpng gives up; s->data is the caller's in any case.
static bool encode(struct sink *s, const struct png_picture *p, struct error *err)
{
    struct layout layout = layout_of(p->kind);
    size_t row = (size_t)p->width * (size_t)layout.bytes;
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
    png_set_user_limits(png, (png_uint_32)p->width, (png_uint_32)p->height);
    // Flat areas repeat the row above: this filter and the fastest level lose little to the best
    // ones and take a tenth of their time.
    png_set_filter(png, 0, PNG_FILTER_UP);
    png_set_compression_level(png, 1);
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, layout.depth,
                 layout.colour, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    add_notes(png, info, p);
    png_write_info(png, info);
    if (p->kind == PNG_KIND_GREY16 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
        png_set_swap(png);
    for (int y = 0; y < p->height; y++)
        png_write_row(png, (const uint8_t *)p->pixels + (size_t)y * row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}

bool write_png_picture(const char *path, const struct png_picture *p, struct error *err)
{
    struct sink s = {.size = 1 << 16};
    s.data = mem_alloc(s.size);
    bool ok = encode(&s, p, err) && file_write(path, s.data, s.used, err);
    free(s.data);
    return ok;
}

bool write_png(const char *path, const uint8_t *rgb, int width, int height, struct error *err)
{
    return write_png_picture(
        path, &(struct png_picture){.width = width, .height = height, .pixels = rgb}, err);
}
