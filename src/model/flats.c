// flats.c - square, circle, polygon and text.
#include "base/angle.h"
#include "geom/clip.h"
#include "model/nodes.h"
#include "model/rounds.h"
#include "type/text.h"

const struct parameters parameters_square = {{"size", "center"}, 2};
const struct parameters parameters_circle = {{"r", "d"}, 1};
const struct parameters parameters_polygon = {{"points", "paths", "convexity"}, 3};
const struct parameters parameters_text = {{"text", "size", "font", "direction", "language",
                                            "script", "halign", "valign", "spacing", "em"},
                                           3};

static void add(struct outline *o, double x, double y)
{
    outline_add(o, (struct vec2){x, y});
}

void flat_square(struct builder *b, const struct args *args, struct outline *out)
{
    double s[2] = {1, 1};
    const struct csg_value *size = args->values[0];
    out->clean = true;
    if (value_number(size, &s[0]))
        s[1] = s[0];
    else if (!value_numbers(size, s, 2, 2) && size)
        builder_warn(b, args->node, "square() needs a number or 2 numbers as size; 1 is taken");
    if (!(s[0] > 0 && s[1] > 0 && isfinite(s[0]) && isfinite(s[1])))
        return;
    bool center = value_true(args->values[1]);
    double x1 = center ? -s[0] / 2 : 0, y1 = center ? -s[1] / 2 : 0;
    double x2 = center ? s[0] / 2 : s[0], y2 = center ? s[1] / 2 : s[1];
    add(out, x1, y1);
    add(out, x2, y1);
    add(out, x2, y2);
    add(out, x1, y2);
    outline_close(out);
}

void flat_circle(struct builder *b, const struct args *args, struct outline *out)
{
    double r = 1;
    out->clean = true;
    radius_of(b, args, 0, 1, &r);
    if (!(r > 0 && isfinite(r)))
        return;
    uint32_t n = corners_around(b, args, r, CIRCLE_FRAGMENTS_MAX);
    for (uint32_t i = 0; i < n; i++) {
        double angle = 360.0 * i / n;
        add(out, r * cos_degrees(angle), r * sin_degrees(angle));
    }
    outline_close(out);
}

// ---------------------------------------------------------------- polygon

static bool read_points(struct builder *b, const struct args *args, struct outline *points)
{
    const struct csg_value *v = args->values[0];
    if (!value_is_vector(v)) {
        builder_warn(b, args->node, "polygon() needs a vector of points; left out");
        return false;
    }
    for (uint32_t i = 0; i < v->count; i++) {
        struct csg_value hold;
        double p[3]; // OpenSCAD after 2021.01 takes points in space, too
        if (!value_numbers(value_item(v, i, &hold), p, 2, 3) || !isfinite(p[0]) ||
            !isfinite(p[1])) {
            builder_warn(b, args->node, "polygon() point %u is not 2 finite numbers; left out", i);
            return false;
        }
        outline_add(points, (struct vec2){p[0], p[1]});
    }
    return true;
}

static void add_path(struct builder *b, const struct args *args, const struct outline *points,
                     const struct csg_value *path, uint32_t number, struct outline *out)
{
    uint32_t bad = 0;
    for (uint32_t k = 0; value_is_vector(path) && k < path->count; k++) {
        struct csg_value hold;
        double index = -1;
        value_number(value_item(path, k, &hold), &index);
        index = trunc(index);
        if (index >= 0 && index < points->point_count)
            outline_add(out, points->points[(uint32_t)index]);
        else
            bad++;
    }
    if (bad)
        builder_warn(b, args->node, "polygon() path %u: %u points that are not there; skipped",
                     number, bad);
    outline_close(out);
}

void flat_polygon(struct builder *b, const struct args *args, struct outline *out)
{
    struct outline points = {0}, paths = {0};
    const struct csg_value *list = args->values[1];
    out->clean = true;
    if (read_points(b, args, &points)) {
        if (value_is_vector(list) && list->count)
            for (uint32_t i = 0; i < list->count; i++) {
                struct csg_value hold;
                add_path(b, args, &points, value_item(list, i, &hold), i, &paths);
            }
        else {
            outline_close(&points);
            outline_append(&paths, &points);
        }
        if (!clip_clean(out, &paths))
            builder_warn(b, args->node, "polygon() " CLIP_REFUSED "; left out");
    }
    outline_free(&points);
    outline_free(&paths);
}

// ---------------------------------------------------------------- text

static const char *string_of(const struct csg_value *v)
{
    return v && v->kind == CSG_STRING ? v->string : NULL;
}

void flat_text(struct builder *b, const struct args *args, struct outline *out)
{
    enum { TEXT, SIZE, FONT, DIRECTION, LANGUAGE, SCRIPT, HALIGN, VALIGN, SPACING, EM };
    struct text_line line = {.text = string_of(args->values[TEXT]),
                             .font = string_of(args->values[FONT]),
                             .direction = string_of(args->values[DIRECTION]),
                             .language = string_of(args->values[LANGUAGE]),
                             .script = string_of(args->values[SCRIPT]),
                             .halign = string_of(args->values[HALIGN]),
                             .valign = string_of(args->values[VALIGN]),
                             .size = 10,
                             .spacing = 1,
                             .detail = args->detail};
    value_number(args->values[SIZE], &line.size);
    if (value_number(args->values[EM], &line.size))
        line.size *= 0.72;
    value_number(args->values[SPACING], &line.spacing);
    out->clean = true;
    text_outline(out, &line, builder_place(b, args->node), b->messages);
}
