// glyph.h - glyphs as closed paths.
#pragma once
#include "geom/outline.h"

struct FT_Outline_; // FreeType's FT_Outline

struct glyph_place {
    struct vec2 offset, advance; // in a text of size 1
    double size;
    uint32_t pieces; // straight lines that make a curve
};

// Appends the contours of a glyph in the direction that the font gives them.
void glyph_append(struct outline *out, const struct FT_Outline_ *glyph,
                  const struct glyph_place *place);

// The most points that glyph_append makes of a glyph.
uint64_t glyph_points(const struct FT_Outline_ *glyph, uint32_t pieces);
