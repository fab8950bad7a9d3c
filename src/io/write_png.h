// write_png.h - pictures as PNG files.
#pragma once
#include "base/error.h"

enum png_kind {
    PNG_KIND_RGB,    // 8 bits each
    PNG_KIND_RGBA,   // 8 bits each, colours not multiplied by alpha
    PNG_KIND_GREY16, // uint16_t
};

// A line of text inside the file, which viewers show as its properties.
struct png_note {
    const char *key; // 1 to 79 letters
    const char *text;
};

struct png_picture {
    int width, height;
    enum png_kind kind;
    const void *pixels; // rows from the top without padding
    const struct png_note *notes;
    uint32_t note_count;
};

// The same picture gives the same bytes. "-" is standard output; no file is left behind on errors.
bool write_png_picture(const char *path, const struct png_picture *p, struct error *err);
// 8-bit RGB without notes.
bool write_png(const char *path, const uint8_t *rgb, int width, int height, struct error *err);
