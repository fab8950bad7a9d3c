// svg_shapes.c - the elements of SVG that draw something.
#include "base/mem.h"
#include "io/svg.h"

#include <string.h>

struct element {
    const char *const *attributes;
    locale_t numbers;
};

static double number(const struct element *e, const char *name)
{
    return svg_whole_number(svg_attribute(e->attributes, name), e->numbers, 0);
}

static void draw_path(struct svg_pen *p, const struct element *e)
{
    const char *d = svg_attribute(e->attributes, "d");
    if (d)
        svg_draw_path(p, (struct svg_text){d, e->numbers});
}

static void draw_rect(struct svg_pen *p, const struct element *e)
{
    double x = number(e, "x"), y = number(e, "y");
    double w = number(e, "width"), h = number(e, "height");
    double rx = number(e, "rx"), ry = number(e, "ry");
    if (rx == 0)
        rx = ry;
    if (ry == 0)
        ry = rx;
    rx = fmin(rx, w / 2);
    ry = fmin(ry, h / 2);
    if (!(rx > 0 && ry > 0))
        rx = ry = 0;
    // Each side, and the corner after it.
    const struct vec2 sides[4][3] = {
        {{x + rx, y}, {x + w - rx, y}, {x + w, y + ry}},
        {{x + w, y + ry}, {x + w, y + h - ry}, {x + w - rx, y + h}},
        {{x + w - rx, y + h}, {x + rx, y + h}, {x, y + h - ry}},
        {{x, y + h - ry}, {x, y + ry}, {x + rx, y}},
    };
    for (int i = 0; i < 4; i++) {
        svg_pen_point(p, sides[i][0]);
        svg_pen_point(p, sides[i][1]);
        if (rx > 0)
            svg_pen_arc(p, (struct svg_arc){rx, ry, 0, false, true}, sides[i][2]);
    }
    svg_pen_fill(p);
}

static void draw_ellipse(struct svg_pen *p, const struct element *e)
{
    double cx = number(e, "cx"), cy = number(e, "cy"), r = number(e, "r");
    double rx = fabs(r != 0 ? r : number(e, "rx")), ry = fabs(r != 0 ? r : number(e, "ry"));
    uint32_t n = 40;
    if (p->options->newer)
        n = (uint32_t)fmin(circle_fragments(fmax(rx, ry), p->options->detail),
                           CIRCLE_FRAGMENTS_MAX);
    for (uint32_t i = 0; i < n && !p->failed; i++) {
        double a = 2 * M_PI * i / n;
        svg_pen_point(p, (struct vec2){cx + rx * cos(a), cy + ry * sin(a)});
    }
    svg_pen_fill(p);
}

static void draw_line(struct svg_pen *p, const struct element *e)
{
    svg_pen_point(p, (struct vec2){number(e, "x1"), number(e, "y1")});
    svg_pen_point(p, (struct vec2){number(e, "x2"), number(e, "y2")});
    svg_pen_line(p);
}

static void read_points(struct svg_pen *p, const struct element *e)
{
    const char *points = svg_attribute(e->attributes, "points");
    struct svg_text t = {points ? points : "", e->numbers};
    struct vec2 to;
    while (!p->failed && svg_next_number(&t, &to.x) && svg_next_number(&t, &to.y))
        svg_pen_point(p, to);
}

static void draw_polyline(struct svg_pen *p, const struct element *e)
{
    read_points(p, e);
    svg_pen_line(p);
}

static void draw_polygon(struct svg_pen *p, const struct element *e)
{
    read_points(p, e);
    svg_pen_fill(p);
}

static const struct {
    const char *name;
    void (*draw)(struct svg_pen *p, const struct element *e);
} shapes[] = {
    {"path", draw_path},       {"rect", draw_rect}, {"circle", draw_ellipse},
    {"ellipse", draw_ellipse}, {"line", draw_line}, {"polyline", draw_polyline},
    {"polygon", draw_polygon},
};

bool svg_draw_shape(struct svg_pen *p, const char *name, const char *const *attributes,
                    locale_t numbers)
{
    for (size_t i = 0; i < array_count(shapes); i++)
        if (strcmp(shapes[i].name, name) == 0) {
            p->at = p->start = (struct vec2){0, 0};
            p->stroke = svg_stroke_of(attributes, numbers);
            shapes[i].draw(p, &(struct element){attributes, numbers});
            return true;
        }
    return false;
}
