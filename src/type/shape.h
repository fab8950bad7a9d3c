// shape.h - which glyphs a text becomes and where they stand, by HarfBuzz.
#pragma once
#include "type/font.h"
#include "type/text.h"

// Lengths in 1/64 of a pixel of the font.
struct letter {
    const struct FT_Outline_ *outline;
    struct vec2 low, high; // box of the control points, rounded outward to whole pixels
    struct vec2 offset, advance;
};

// {0} is a valid empty row.
struct letters {
    struct letter *items;
    uint32_t count;
    uint32_t missing; // glyphs the font could not give
    bool vertical;
};

void letters_free(struct letters *row); // leaves {0}

// Between font_lock and font_unlock; the result may be used after.
void shape_line(struct letters *out, struct font *f, const struct text_line *line);
