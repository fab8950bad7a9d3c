// font.c - the fonts of this machine: chosen by fontconfig, opened once, their glyphs kept.
#include "type/font.h"
#include "base/mem.h"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <hb-ft.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include FT_FREETYPE_H
#include FT_GLYPH_H
#include FT_TRUETYPE_IDS_H

enum { NAMES_KEPT = 64 };

// A search by fontconfig takes as long as drawing a line: the latest names keep their answers.
struct answer {
    char *name;
    struct font *font;
};

// The one state of this folder: libraries that are slow to start and not safe for threads.
static struct {
    pthread_mutex_t lock;
    bool started;
    FcConfig *config; // private: the program's own configuration, of window and menus, stays
    FT_Library library;
    struct font **fonts;
    uint32_t count, capacity;
    struct answer answers[NAMES_KEPT];
    uint32_t oldest;
} fonts = {.lock = PTHREAD_MUTEX_INITIALIZER};

#ifdef HCSG_SANITIZED
// fontconfig notes where its memory lies as offsets, which the search for leaks does not follow.
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig\n";
}
#endif

void font_lock(void)
{
    pthread_mutex_lock(&fonts.lock);
}

void font_unlock(void)
{
    pthread_mutex_unlock(&fonts.lock);
}

static void add_folder(const char *path)
{
    FcConfigAppFontAddDir(fonts.config, (const FcChar8 *)path);
}

// The folders of OPENSCAD_FONT_PATH, parted by colons.
static void add_folders(const char *list)
{
    char *copy = mem_strdup(list), *rest = copy, *folder;

    while ((folder = strsep(&rest, ":")))
        if (*folder)
            add_folder(folder);
    free(copy);
}

// The folders in which OpenSCAD finds fonts beside those of the system.
static void start(void)
{
    static const char *const shipped[] = {"/usr/share/openscad/fonts",
                                          "/usr/local/share/openscad/fonts"};
    const char *home = getenv("HOME"), *list = getenv("OPENSCAD_FONT_PATH");

    fonts.started = true;
    if (FT_Init_FreeType(&fonts.library) != 0)
        return;
    fonts.config = FcInitLoadConfig();
    if (!fonts.config)
        return;
    for (size_t i = 0; i < array_count(shipped); i++) {
        FcConfigParseAndLoad(fonts.config, (const FcChar8 *)shipped[i], FcFalse);
        add_folder(shipped[i]);
    }
    if (home) {
        char *own = mem_alloc(strlen(home) + sizeof "/.fonts");
        stpcpy(stpcpy(own, home), "/.fonts");
        add_folder(own);
        free(own);
    }
    if (list)
        add_folders(list);
    FcConfigBuildFonts(fonts.config);
}

static bool select_charmap(FT_Face face, int platform, int encoding)
{
    for (int i = 0; i < face->num_charmaps; i++) {
        FT_CharMap map = face->charmaps[i];
        if (map->platform_id == platform && (encoding < 0 || map->encoding_id == encoding))
            return FT_Set_Charmap(face, map) == 0;
    }
    return false;
}

// Unicode, or the next best that the font has.
static void choose_charmap(FT_Face face)
{
    static const struct {
        int platform, encoding; // -1 is any
    } order[] = {{TT_PLATFORM_MICROSOFT, TT_MS_ID_UNICODE_CS},
                 {TT_PLATFORM_ISO, TT_ISO_ID_10646},
                 {TT_PLATFORM_APPLE_UNICODE, -1},
                 {TT_PLATFORM_MICROSOFT, TT_MS_ID_SYMBOL_CS},
                 {TT_PLATFORM_MACINTOSH, TT_MAC_ID_ROMAN},
                 {TT_PLATFORM_ISO, TT_ISO_ID_8859_1},
                 {TT_PLATFORM_ISO, TT_ISO_ID_7BIT_ASCII}};

    if (FT_Select_Charmap(face, FT_ENCODING_UNICODE) == 0)
        return;
    for (size_t i = 0; i < array_count(order); i++)
        if (select_charmap(face, order[i].platform, order[i].encoding))
            return;
}

// Microsoft wants the characters of symbol fonts from 0xF000 on; not all of them follow.
static bool has_moved_symbols(FT_Face face)
{
    FT_UInt glyph;

    return face->charmap && face->charmap->encoding == FT_ENCODING_MS_SYMBOL &&
           FT_Get_First_Char(face, &glyph) >= 0xF000 && glyph;
}

static struct font *open_face(const char *file, int index)
{
    FT_Face face;

    if (FT_New_Face(fonts.library, file, index, &face) != 0)
        return NULL;
    if (face->num_glyphs <= 0 || FT_Set_Char_Size(face, 0, FONT_UNITS, FONT_DPI, FONT_DPI) != 0) {
        FT_Done_Face(face);
        return NULL;
    }
    choose_charmap(face);
    struct font *f = mem_zalloc(sizeof *f);
    f->file = mem_strdup(file);
    f->index = index;
    f->face = face;
    f->shaper = hb_ft_font_create(face, NULL);
    f->symbols = has_moved_symbols(face);
    f->glyphs = mem_zalloc((size_t)face->num_glyphs * sizeof *f->glyphs);
    return f;
}

static struct font *face_of(const char *file, int index)
{
    for (uint32_t i = 0; i < fonts.count; i++)
        if (fonts.fonts[i]->index == index && strcmp(fonts.fonts[i]->file, file) == 0)
            return fonts.fonts[i];
    struct font *f = open_face(file, index);
    if (f) {
        array_reserve(&fonts.fonts, &fonts.capacity, (size_t)fonts.count + 1);
        fonts.fonts[fonts.count++] = f;
    }
    return f;
}

// The steps in which OpenSCAD asks fontconfig; only fonts with outlines are asked for.
static struct font *match(const char *name)
{
    FcPattern *pattern = FcNameParse((const FcChar8 *)name);
    struct font *font = NULL;
    FcResult result;
    FcChar8 *file;
    int index;

    if (!pattern)
        return NULL;
    FcPatternAddBool(pattern, FC_OUTLINE, FcTrue);
    FcPatternAddBool(pattern, FC_SCALABLE, FcTrue);
    FcConfigSubstitute(fonts.config, pattern, FcMatchPattern);
    FcDefaultSubstitute(pattern);
    FcPattern *best = FcFontMatch(fonts.config, pattern, &result);
    if (best && FcPatternGetString(best, FC_FILE, 0, &file) == FcResultMatch &&
        FcPatternGetInteger(best, FC_INDEX, 0, &index) == FcResultMatch)
        font = face_of((const char *)file, index);
    if (best)
        FcPatternDestroy(best);
    FcPatternDestroy(pattern);
    return font;
}

struct font *font_open(const char *name)
{
    if (!fonts.started)
        start();
    if (!fonts.config)
        return NULL;
    for (uint32_t i = 0; i < NAMES_KEPT; i++)
        if (fonts.answers[i].name && strcmp(fonts.answers[i].name, name) == 0)
            return fonts.answers[i].font;
    struct answer *answer = &fonts.answers[fonts.oldest++ % NAMES_KEPT];
    free(answer->name);
    *answer = (struct answer){mem_strdup(name), match(name)};
    return answer->font;
}

FT_Glyph font_glyph(struct font *f, uint32_t number)
{
    FT_Glyph glyph;

    if (number >= (uint64_t)f->face->num_glyphs)
        return NULL;
    if (f->glyphs[number])
        return f->glyphs[number];
    if (FT_Load_Glyph(f->face, number, FT_LOAD_DEFAULT) != 0 ||
        FT_Get_Glyph(f->face->glyph, &glyph) != 0)
        return NULL;
    if (glyph->format != FT_GLYPH_FORMAT_OUTLINE) {
        FT_Done_Glyph(glyph);
        return NULL;
    }
    f->glyphs[number] = glyph;
    return glyph;
}
