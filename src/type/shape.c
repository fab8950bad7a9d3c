// shape.c - which glyphs a text becomes and where they stand, by HarfBuzz.
#include "type/shape.h"
#include "base/mem.h"

#include <ft2build.h>
#include <hb.h>
#include <stdlib.h>

#include FT_GLYPH_H

void letters_free(struct letters *row)
{
    free(row->items);
    *row = (struct letters){0};
}

static bool tells_nothing(hb_script_t script)
{
    return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED ||
           script == HB_SCRIPT_UNKNOWN || script == HB_SCRIPT_INVALID;
}

// The script that all letters share; none when they are mixed, as in OpenSCAD.
static hb_script_t script_of(const hb_glyph_info_t *characters, uint32_t count)
{
    hb_unicode_funcs_t *unicode = hb_unicode_funcs_get_default();
    hb_script_t common = HB_SCRIPT_INVALID;

    for (uint32_t i = 0; i < count; i++) {
        hb_script_t script = hb_unicode_script(unicode, characters[i].codepoint);
        if (tells_nothing(script) || script == common)
            continue;
        if (common != HB_SCRIPT_INVALID)
            return HB_SCRIPT_INVALID;
        common = script;
    }
    return common;
}

static hb_direction_t direction_of(const char *word, hb_script_t script)
{
    hb_direction_t direction = hb_direction_from_string(word ? word : "", -1);

    if (direction == HB_DIRECTION_INVALID)
        direction = hb_script_get_horizontal_direction(script);
    return direction == HB_DIRECTION_INVALID ? HB_DIRECTION_LTR : direction;
}

static void fill_buffer(hb_buffer_t *buffer, const struct font *f, const struct text_line *line)
{
    const char *language = line->language && *line->language ? line->language : "en";
    uint32_t count;

    hb_buffer_add_utf8(buffer, line->text, -1, 0, -1);
    hb_glyph_info_t *characters = hb_buffer_get_glyph_infos(buffer, &count);
    hb_script_t script = hb_script_from_string(line->script ? line->script : "", -1);
    if (script == HB_SCRIPT_INVALID)
        script = script_of(characters, count);
    hb_buffer_set_script(buffer, script);
    hb_buffer_set_direction(buffer, direction_of(line->direction, script));
    hb_buffer_set_language(buffer, hb_language_from_string(language, -1));
    for (uint32_t i = 0; f->symbols && i < count; i++)
        if (characters[i].codepoint < 0x100)
            characters[i].codepoint += 0xF000;
}

void shape_line(struct letters *out, struct font *f, const struct text_line *line)
{
    hb_buffer_t *buffer = hb_buffer_create();
    uint32_t count;

    fill_buffer(buffer, f, line);
    hb_shape(f->shaper, buffer, NULL, 0);
    const hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(buffer, &count);
    const hb_glyph_position_t *positions = hb_buffer_get_glyph_positions(buffer, &count);
    *out = (struct letters){.vertical = HB_DIRECTION_IS_VERTICAL(hb_buffer_get_direction(buffer))};
    out->items = mem_alloc(((size_t)count + 1) * sizeof *out->items);
    for (uint32_t i = 0; i < count; i++) {
        FT_Glyph glyph = font_glyph(f, infos[i].codepoint);
        FT_BBox box;
        if (!glyph) {
            out->missing++;
            continue;
        }
        struct letter *l = &out->items[out->count++];
        l->outline = &((FT_OutlineGlyph)glyph)->outline;
        FT_Glyph_Get_CBox(glyph, FT_GLYPH_BBOX_GRIDFIT, &box);
        l->low = (struct vec2){(double)box.xMin, (double)box.yMin};
        l->high = (struct vec2){(double)box.xMax, (double)box.yMax};
        l->offset = (struct vec2){positions[i].x_offset, positions[i].y_offset};
        l->advance = (struct vec2){positions[i].x_advance, positions[i].y_advance};
    }
    hb_buffer_destroy(buffer);
}
