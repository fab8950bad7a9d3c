// layout.h - where a row of glyphs begins.
#pragma once
#include "type/shape.h"

// `unit` is what a length of 1 in `struct letter` makes in a text of size 1, in which `start` is.
struct layout {
    double unit;
    struct vec2 start;
};

struct layout layout_make(const struct letters *row, const struct text_line *line,
                          struct place place, struct messages *messages);
