// glyph.c - glyphs as closed paths.
#include "type/glyph.h"
#include "type/font.h"

#include <ft2build.h>

#include FT_OUTLINE_H

struct pen {
    struct outline *out;
    const struct glyph_place *place;
    struct vec2 at;
    bool open;
};

// The order of the operations here and below is OpenSCAD's: what falls beside a line of its grid
// through rounding would fall on the other side otherwise.
static struct vec2 unit_point(const FT_Vector *v)
{
    return (struct vec2){(double)v->x / FONT_UNITS, (double)v->y / FONT_UNITS};
}

static void put(struct pen *pen, struct vec2 p)
{
    const struct glyph_place *place = pen->place;

    outline_add(pen->out, (struct vec2){place->size * (p.x + place->offset.x + place->advance.x),
                                        place->size * (p.y + place->offset.y + place->advance.y)});
}

static void close_path(struct pen *pen)
{
    if (pen->open)
        outline_close(pen->out);
    pen->open = false;
}

static int move_to(const FT_Vector *to, void *user)
{
    struct pen *pen = user;

    close_path(pen);
    pen->open = true;
    pen->at = unit_point(to);
    put(pen, pen->at);
    return 0;
}

static int line_to(const FT_Vector *to, void *user)
{
    struct pen *pen = user;

    pen->at = unit_point(to);
    put(pen, pen->at);
    return 0;
}

static int conic_to(const FT_Vector *control, const FT_Vector *to, void *user)
{
    struct pen *pen = user;
    struct vec2 a = pen->at, b = unit_point(control), c = unit_point(to);

    for (uint32_t i = 1; i <= pen->place->pieces; i++) {
        double t = i * (1.0 / pen->place->pieces), s = 1 - t, aa = s * s, cc = t * t;
        put(pen, (struct vec2){a.x * aa + b.x * 2 * s * t + c.x * cc,
                               a.y * aa + b.y * 2 * s * t + c.y * cc});
    }
    pen->at = c;
    return 0;
}

static int cubic_to(const FT_Vector *control1, const FT_Vector *control2, const FT_Vector *to,
                    void *user)
{
    struct pen *pen = user;
    struct vec2 a = pen->at, b = unit_point(control1), c = unit_point(control2), d = unit_point(to);

    for (uint32_t i = 1; i <= pen->place->pieces; i++) {
        double t = i * (1.0 / pen->place->pieces), s = 1 - t, ss = s * s, tt = t * t;
        double sss = pow(s, 3), ttt = pow(t, 3);
        put(pen, (struct vec2){a.x * sss + b.x * 3 * ss * t + c.x * 3 * s * tt + d.x * ttt,
                               a.y * sss + b.y * 3 * ss * t + c.y * 3 * s * tt + d.y * ttt});
    }
    pen->at = d;
    return 0;
}

void glyph_append(struct outline *out, const FT_Outline *glyph, const struct glyph_place *place)
{
    static const FT_Outline_Funcs funcs = {move_to, line_to, conic_to, cubic_to, 0, 0};
    struct pen pen = {.out = out, .place = place};
    FT_Outline copy = *glyph; // FreeType takes it as not const, though it only reads

    FT_Outline_Decompose(&copy, &funcs, &pen);
    close_path(&pen);
}

uint64_t glyph_points(const FT_Outline *glyph, uint32_t pieces)
{
    return (uint64_t)glyph->n_points * pieces + 2 * (uint64_t)glyph->n_contours;
}
