// text.h - lines of text as a picture, in the system's monospaced font.
#pragma once
#include <stdbool.h>
#include <stdint.h>

struct text_font;
// NULL when the system has no font at all.
struct text_font *text_font_new(int pixels);
void text_font_delete(struct text_font *f);

struct text_image {    // {0} is a valid empty image
    uint8_t *coverage; // one byte a pixel, rows from the top
    int width, height;
};
// Breaks lines that are wider than `width` pixels. Returns what the text needs, no more.
void text_draw(struct text_font *f, const char *utf8, int width, struct text_image *out);
void text_image_free(struct text_image *t); // leaves {0}
