// text.c - lines of text as a picture, in the system's monospaced font.
#include "app/text.h"

#include "base/mem.h"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <stdlib.h>
#include <string.h>
#include FT_FREETYPE_H

enum { LINES_MOST = 60 };

struct text_font {
    FT_Library library;
    FT_Face face;
    int advance, ascent, line;
};

static char *font_file(void)
{
    char *file = NULL;
    FcPattern *wanted = FcNameParse((const FcChar8 *)"monospace");
    FcConfigSubstitute(NULL, wanted, FcMatchPattern);
    FcDefaultSubstitute(wanted);
    FcResult result;
    FcPattern *found = FcFontMatch(NULL, wanted, &result);
    FcChar8 *name;
    if (found && FcPatternGetString(found, FC_FILE, 0, &name) == FcResultMatch)
        file = mem_strdup((const char *)name);
    if (found)
        FcPatternDestroy(found);
    FcPatternDestroy(wanted);
    return file;
}

struct text_font *text_font_new(int pixels)
{
    struct text_font *f = mem_zalloc(sizeof *f);
    char *file = font_file();
    bool ok = file && FT_Init_FreeType(&f->library) == 0 &&
              FT_New_Face(f->library, file, 0, &f->face) == 0 &&
              FT_Set_Pixel_Sizes(f->face, 0, (FT_UInt)pixels) == 0 &&
              FT_Load_Char(f->face, 'M', FT_LOAD_DEFAULT) == 0;
    free(file);
    if (!ok) {
        text_font_delete(f);
        return NULL;
    }
    f->advance = (int)(f->face->glyph->advance.x >> 6);
    f->ascent = (int)(f->face->size->metrics.ascender >> 6);
    f->line = (int)(f->face->size->metrics.height >> 6);
    return f;
}

void text_font_delete(struct text_font *f)
{
    if (!f)
        return;
    if (f->face)
        FT_Done_Face(f->face);
    if (f->library)
        FT_Done_FreeType(f->library);
    free(f);
}

// The next character; broken bytes give U+FFFD.
static uint32_t next_character(const char **text)
{
    const unsigned char *p = (const unsigned char *)*text;
    int more = *p < 0x80 ? 0 : *p >= 0xf0 ? 3 : *p >= 0xe0 ? 2 : 1;
    uint32_t c = more ? *p & (0x3fu >> more) : *p;
    bool broken = more && (*p < 0xc0 || *p > 0xf7);
    int taken = 1;
    for (; !broken && taken <= more; taken++) {
        broken = (p[taken] & 0xc0) != 0x80;
        if (broken)
            break;
        c = c << 6 | (p[taken] & 0x3f);
    }
    *text += taken;
    return broken ? 0xfffd : c;
}

static void put_glyph(const struct text_font *f, struct text_image *out, uint32_t c, int x, int y)
{
    if (FT_Load_Char(f->face, c, FT_LOAD_RENDER | FT_LOAD_TARGET_NORMAL) != 0)
        return;
    const FT_GlyphSlot g = f->face->glyph;
    const FT_Bitmap *b = &g->bitmap;
    if (b->pixel_mode != FT_PIXEL_MODE_GRAY)
        return;
    for (int row = 0; row < (int)b->rows; row++)
        for (int column = 0; column < (int)b->width; column++) {
            int px = x + g->bitmap_left + column, py = y + f->ascent - g->bitmap_top + row;
            uint8_t v = b->buffer[row * b->pitch + column];
            if (px >= 0 && py >= 0 && px < out->width && py < out->height &&
                out->coverage[py * out->width + px] < v)
                out->coverage[py * out->width + px] = v;
        }
}

// Walks the text in cells of `columns` a line; draws when there is an image, else only counts.
static void set_text(const struct text_font *f, const char *text, int columns,
                     struct text_image *out, int *widest, int *lines)
{
    int column = 0, line = 0;
    *widest = 0;
    while (*text && line < LINES_MOST) {
        uint32_t c = next_character(&text);
        if (c == '\n' || column == columns) {
            column = 0;
            line++;
            if (c == '\n' || c == ' ')
                continue;
        }
        if (out && c > ' ')
            put_glyph(f, out, c, column * f->advance, line * f->line);
        column++;
        if (column > *widest)
            *widest = column;
    }
    *lines = line + (column > 0);
    if (*lines > LINES_MOST)
        *lines = LINES_MOST;
}

void text_draw(struct text_font *f, const char *utf8, int width, struct text_image *out)
{
    int columns = width / f->advance, widest, lines;
    if (columns < 8)
        columns = 8;
    set_text(f, utf8, columns, NULL, &widest, &lines);
    *out = (struct text_image){.width = widest * f->advance, .height = lines * f->line};
    out->coverage = mem_zalloc((size_t)out->width * (size_t)out->height + 1);
    set_text(f, utf8, columns, out, &widest, &lines);
}

void text_image_free(struct text_image *t)
{
    free(t->coverage);
    *t = (struct text_image){0};
}
