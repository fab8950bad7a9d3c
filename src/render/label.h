// label.h - the name of a view, written into a corner of its picture.
#pragma once
#include "render/scheme.h"

// Pixels of a picture of 3 or 4 bytes each, rows from the top; `stride` is that of a row.
struct label_place {
    uint8_t *pixels;
    size_t stride;
    int width, height, channels;
};

// In the upper left corner, in letters as large as suits the picture; nothing where there is no
// room. Of letters there are those of the names of views.
void label_draw(const struct label_place *p, const char *name, struct rgb colour);
