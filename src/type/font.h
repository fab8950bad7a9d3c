// font.h - the fonts of this machine: chosen by fontconfig, opened once, their glyphs kept.
#pragma once
#include <stdbool.h>
#include <stdint.h>

struct FT_FaceRec_; // FreeType's FT_Face and FT_Glyph point to these
struct FT_GlyphRec_;
struct hb_font_t;

// OpenSCAD sets all fonts at this size, 1562.5 points at 100 dots an inch, and scales the outlines:
// these are so many units for a text of size 1.
enum { FONT_UNITS = 100000, FONT_DPI = 100 };

// One face of a font file at that size. Lives as long as the program.
struct font {
    char *file;
    int index; // of the face in its file
    struct FT_FaceRec_ *face;
    struct hb_font_t *shaper;
    bool symbols;                 // its characters below 0x100 stand at 0xF000 and above
    struct FT_GlyphRec_ **glyphs; // by number, NULL until needed
};

// FreeType and HarfBuzz serve one thread at a time: the functions below, and everything done with a
// font, belong between these two. A glyph once given out never changes, and may be read without.
void font_lock(void);
void font_unlock(void);

// The best match for a name as fontconfig writes it, "Liberation Sans:style=Bold"; fontconfig
// always finds one. NULL only when there are no fonts or the file of the match cannot be used.
struct font *font_open(const char *name);

// The hinted outline of a glyph; NULL when the font is broken there or has no outline for it.
struct FT_GlyphRec_ *font_glyph(struct font *f, uint32_t number);
