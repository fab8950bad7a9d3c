// svg.h - the parts of the SVG reader: numbers, paths, shapes, transforms, the page.
#pragma once
#include "geom/clip.h"
#include "io/read_svg.h"

#include <locale.h>

// One element's paths stay well below what 32 bits can count, whatever its text multiplies.
enum { SVG_POINTS_MAX = 1 << 24 };

// Lists of numbers in attributes, with blanks or commas between them.
struct svg_text {
    const char *at;
    locale_t numbers;
};

bool svg_next_number(struct svg_text *t, double *out); // false leaves the place alone
bool svg_next_flag(struct svg_text *t, bool *out);     // of an arc: one digit
// A text that is one number and nothing else, as OpenSCAD takes it; otherwise `fallback`.
double svg_whole_number(const char *text, locale_t numbers, double fallback);

// The value of an attribute, or NULL.
const char *svg_attribute(const char *const *attributes, const char *name);

struct svg_stroke {
    double width;
    enum clip_cap cap;
    enum clip_join join;
};

// Attributes and style of an element with lines. OpenSCAD reads no unit, inherits nothing, and
// knows only styles without blanks.
struct svg_stroke svg_stroke_of(const char *const *attributes, locale_t numbers);

// Draws the paths of one element. {0} with `out`, `stroke` and `options` is ready.
struct svg_pen {
    struct outline *out;
    struct svg_stroke stroke;
    const struct svg_options *options;
    struct outline line; // the subpath at hand: its points are not closed yet
    struct vec2 start, at;
    bool failed; // too many points, or too far off
};

void svg_pen_free(struct svg_pen *p);
void svg_pen_point(struct svg_pen *p, struct vec2 to);
void svg_pen_quadratic(struct svg_pen *p, struct vec2 control, struct vec2 to);
void svg_pen_cubic(struct svg_pen *p, struct vec2 c1, struct vec2 c2, struct vec2 to);
struct svg_arc {
    double rx, ry, rotation; // degrees
    bool large, sweep;
};
void svg_pen_arc(struct svg_pen *p, struct svg_arc arc, struct vec2 to);
void svg_pen_fill(struct svg_pen *p); // closes the subpath
void svg_pen_line(struct svg_pen *p); // makes it a line of the stroke's width

void svg_draw_path(struct svg_pen *p, struct svg_text d);
// Draws a rect, circle, ellipse, line, polyline, polygon or path; false for other elements.
bool svg_draw_shape(struct svg_pen *p, const char *name, const char *const *attributes,
                    locale_t numbers);

struct svg_map { // x' = a x + c y + e, y' = b x + d y + f
    double a, b, c, d, e, f;
};

#define SVG_MAP_IDENTITY ((struct svg_map){1, 0, 0, 1, 0, 0})
struct svg_map svg_map_mul(struct svg_map first, struct svg_map second); // first after second
struct svg_map svg_map_read(const char *transform, locale_t numbers);

// From user units to millimetres with y upwards.
struct svg_map svg_page(const char *const *attributes, double dpi, locale_t numbers);
