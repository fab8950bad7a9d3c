// glyph.h - glyphs as closed paths.
#pragma once
#include "geom/outline.h"

#include <ft2build.h>
#include FT_OUTLINE_H

// Appends the contours of a glyph in the direction the font gives them, moved by `offset` and then
// by `advance`, in ems of OpenSCAD, times `size`; every curve as `pieces` straight lines.
struct glyph_place {
    struct vec2 offset, advance;
    double size;
    uint32_t pieces;
};
void glyph_append(struct outline *out, const FT_Outline *glyph, const struct glyph_place *place);

// The most points that glyph_append makes of a glyph.
uint64_t glyph_points(const FT_Outline *glyph, uint32_t pieces);
