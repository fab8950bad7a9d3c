// overlay.c - OpenSCAD's axes, their scales, the crosshairs and the small tripod.
//
// All measures are those of OpenSCAD's pictures: axes as long as the viewer is away, ticks at a
// tenth of the largest power of ten in that.
#include "render/overlay.h"

#include "base/mem.h"

#include <stdio.h>
#include <string.h>

#define TICK      (1.0 / 60) // length of a small tick, of the viewer's distance
#define CROSS     (1.0 / 8)  // half the side of the cube that the crosshairs span
#define ARM       (1.0 / 18) // of the tripod, of the picture's height
#define LETTER_AT (1.0 / 15) // as far out is the middle of its letter
enum { LETTER_HALF = 3 };    // pixels

struct drawing {
    const struct overlay *overlay;
    const struct rays *rays;
    const struct canvas *canvas;
    struct line_style style;
};

static void draw_axes(struct drawing *d)
{
    double l = d->overlay->distance;
    for (int stippled = 0; stippled < 2; stippled++) {
        double end = stippled ? -l : l;
        d->style.stippled = stippled;
        struct vec3 ends[] = {{end, 0, 0}, {0, end, 0}, {0, 0, end}};
        for (int axis = 0; axis < 3; axis++)
            lines_draw(d->canvas, d->rays, &d->style, (struct vec3){0}, ends[axis]);
    }
}

// The lines of a character run from place to place: A and B are at the top, C and D in the middle,
// E and F at the bottom, the first of each on the left.
static const char *strokes_of(char c)
{
    static const char *const digits[] = {"ABFEA",  "AE",     "ABDCEF", "ABDCDFE", "ACDBF",
                                         "BACDFE", "BAEFDC", "ABE",    "CDBAEFD", "FBACD"};
    if (c >= '0' && c <= '9')
        return digits[c - '0'];
    return c == '-' ? "CD" : c == '.' ? "EF" : c == 'e' ? "BACDCEF" : "";
}

// Half of an axis as its numbers see it.
struct half_axis {
    int along, up;    // coordinates: 0 x, 1 y, 2 z
    double direction; // -1: the negative half
    bool mirrored;    // and begun with the last character: to be read from the other side
};
static const struct half_axis half_axes[] = {{0, 1, 1, false},  {1, 0, 1, true},
                                             {2, 0, 1, true},   {0, 1, -1, true},
                                             {1, 0, -1, false}, {2, 0, -1, false}};

static struct vec3 place_on(const struct half_axis *a, double along, double up)
{
    double p[3] = {0};
    p[a->along] = a->direction * along;
    p[a->up] = up;
    return (struct vec3){p[0], p[1], p[2]};
}

static void draw_character(struct drawing *d, const struct half_axis *a, char c, double along)
{
    double unit = TICK * d->overlay->distance;
    // What looks the same from both sides is not mirrored, and the digit 1, whose line moves.
    bool mirrored = a->mirrored && !strchr("018-.", c);
    const char *strokes = strokes_of(c);
    struct vec3 last = {0};
    for (int i = 0; strokes[i]; i++) {
        int place = (strokes[i] - 'A') ^ mirrored;
        double up[] = {1.25, 0.875, 0.25};
        struct vec3 next =
            place_on(a, along + (place % 2 ? 0.25 : -0.25) * unit, up[place / 2] * unit);
        if (i)
            lines_draw(d->canvas, d->rays, &d->style, last, next);
        last = next;
    }
}

static void draw_number(struct drawing *d, const struct half_axis *a, double at)
{
    char text[32];
    int n = snprintf(text, sizeof text, "%s%g", a->direction < 0 ? "-" : "", at);
    for (int i = 0; i < n; i++)
        draw_character(d, a, text[a->mirrored ? n - 1 - i : i],
                       at + i * 0.75 * TICK * d->overlay->distance);
}

static void draw_scales(struct drawing *d)
{
    double l = d->overlay->distance, decade = floor(log10(l)), step = pow(10, decade - 1);
    // An axis with few of the long ticks has numbers at every other short one too.
    int numbered = l < 3 * pow(10, decade) ? 2 : 10;
    int count = 0;
    for (double at = 0; at < l && count <= 100; at += step, count++) {
        double length = (count && count % 10 == 0 ? 2 : 1) * TICK * l;
        for (size_t i = 0; i < array_count(half_axes); i++) {
            const struct half_axis *a = &half_axes[i];
            d->style.stippled = false;
            if (count && count % numbered == 0)
                draw_number(d, a, at);
            d->style.stippled = a->direction < 0;
            lines_draw(d->canvas, d->rays, &d->style, place_on(a, at, 0), place_on(a, at, -length));
        }
    }
}

static void draw_crosshairs(struct drawing *d)
{
    double half = CROSS * d->overlay->distance;
    struct vec3 centre = d->overlay->centre;
    for (int i = 0; i < 4; i++) {
        struct vec3 arm = {i & 2 ? -half : half, i & 1 ? -half : half, -half};
        lines_draw(d->canvas, d->rays, &d->style, vec3_add(centre, arm), vec3_sub(centre, arm));
    }
}

void overlay_draw_among(const struct overlay *o, const struct rays *rays, const struct canvas *c)
{
    struct drawing d = {o, rays, c, {.width = 1}};
    if (o->crosshairs) {
        d.style.colour = o->scheme->crosshair;
        draw_crosshairs(&d);
    }
    d.style.colour = o->scheme->axes;
    if (o->axes)
        draw_axes(&d);
    if (o->axes && o->scales)
        draw_scales(&d);
}

static void draw_letter(const struct overlay *o, const struct canvas *c, char letter,
                        struct vec2 middle)
{
    // Lines between corners of a square, numbered as the places of a figure; G is its middle.
    static const char *const lines[] = {"EBAF", "EBAG", "EFABEB"};
    static const struct vec2 places[] = {{-1, -1}, {1, -1}, {-1, 0}, {1, 0},
                                         {-1, 1},  {1, 1},  {0, 0}};
    const struct line_style style = {.colour = o->scheme->axes, .width = 1};
    for (const char *l = lines[letter - 'x']; *l; l += 2) {
        struct vec2 ends[2];
        for (int i = 0; i < 2; i++)
            ends[i] = (struct vec2){middle.x + LETTER_HALF * places[l[i] - 'A'].x,
                                    middle.y + LETTER_HALF * places[l[i] - 'A'].y};
        lines_draw_flat(c, &style, ends[0], ends[1]);
    }
}

void overlay_draw_over(const struct overlay *o, const struct rays *rays, const struct canvas *c)
{
    if (!o->axes)
        return;
    static const struct rgb colours[] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    struct vec3 right = vec3_normalized(rays->step_x), down = vec3_normalized(rays->step_y);
    struct vec2 arms[] = {{right.x, down.x}, {right.y, down.y}, {right.z, down.z}};
    // A tenth of the picture away from its left and lower border.
    struct vec2 origin = {0.1 * c->width - 0.5, 0.9 * c->height - 0.5};
    for (int i = 0; i < 3; i++) {
        const struct line_style style = {.colour = colours[i], .width = 1};
        double length = ARM * c->height;
        lines_draw_flat(
            c, &style, origin,
            (struct vec2){origin.x + length * arms[i].x, origin.y + length * arms[i].y});
    }
    // Letters stand on corners of pixels, counted from below.
    for (int i = 0; i < 3; i++) {
        double length = LETTER_AT * c->height;
        double x = round(origin.x + 0.5 + length * arms[i].x);
        double y = round(c->height - 0.5 - origin.y - length * arms[i].y);
        draw_letter(o, c, (char)('x' + i), (struct vec2){x - 0.5, c->height - 0.5 - y});
    }
}
