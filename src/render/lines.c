// lines.c - lines in a picture, as OpenGL draws them without smoothing.
//
// The rule is OpenGL's "diamond exit": along its main direction a line takes one pixel per column
// (or row), the one in which it passes the middle; of its ends, the first pixel counts when the
// line leaves the diamond inside it, the last one only when it does so too. A wide line takes that
// many pixels of each column. All of it happens in OpenGL's window coordinates, where pixel (i, j)
// from the lower left covers [i, i + 1) x [j, j + 1): places exactly between two pixels then go to
// the same one as there.
#include "render/lines.h"

#define SUBPIXELS 256  // per pixel; ends of lines are rounded to them, as by the hardware
#define FARTHEST  1e12 // pixels; of ends beyond, nothing is known about the pixels between
enum { DASH = 3 };     // pixels of a stippled line that are off, then as many on

// A place in window coordinates. `weight` is what changes evenly along a line of the picture: the
// depth, in perspective its inverse.
struct end {
    double x, y, weight;
};

struct pen {
    const struct canvas *canvas;
    const struct line_style *style;
    float *depth; // NULL: not tested
    bool inverse; // weights are inverse depths
    double reference;
};

static struct end between(struct end a, struct end b, double t)
{
    return (struct end){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t,
                        a.weight + (b.weight - a.weight) * t};
}

static void put(const struct pen *p, int x, int y, double weight)
{
    const struct canvas *c = p->canvas;
    if (x < 0 || y < 0 || x >= c->width || y >= c->height)
        return;
    size_t i = (size_t)(c->height - 1 - y) * (size_t)c->width + (size_t)x;
    if (p->depth) {
        float depth = (float)((p->inverse ? 1 / weight : weight) - p->reference);
        if (!(depth < p->depth[i] || (p->style->half && depth <= p->depth[i])))
            return;
        p->depth[i] = depth;
    }
    const uint8_t bytes[3] = {p->style->colour.r, p->style->colour.g, p->style->colour.b};
    for (int k = 0; k < 3; k++) {
        uint8_t *to = &c->rgb[3 * i + (size_t)k];
        unsigned average = ((unsigned)*to + bytes[k]) / 2;
        *to = p->style->half ? (uint8_t)average : bytes[k];
    }
}

static double snapped(double v)
{
    return floor(v * SUBPIXELS + 0.5) / SUBPIXELS;
}

static bool in_diamond(double x, double y)
{
    return fabs(x - floor(x) - 0.5) + fabs(y - floor(y) - 0.5) < 0.5;
}

// One unbroken line within the range of int.
static void draw_solid(const struct pen *p, struct end a, struct end b)
{
    a.x = snapped(a.x), a.y = snapped(a.y), b.x = snapped(b.x), b.y = snapped(b.y);
    bool steep = fabs(b.y - a.y) > fabs(b.x - a.x);
    double main0 = steep ? a.y : a.x, main1 = steep ? b.y : b.x;
    double side0 = steep ? a.x : a.y, side1 = steep ? b.x : b.y;
    double length = main1 - main0;
    if (length == 0)
        return;
    int step = length > 0 ? 1 : -1;
    double first = step > 0 ? ceil(main0 - 0.5) : floor(main0 - 0.5);
    double last = step > 0 ? ceil(main1 - 0.5) : floor(main1 - 0.5); // not drawn any more
    if (in_diamond(main0, side0))
        first = floor(main0);
    if (in_diamond(main1, side1))
        last = floor(main1);
    for (int i = (int)first; step > 0 ? i < (int)last : i > (int)last; i += step) {
        double t = (i + 0.5 - main0) / length;
        double side = side0 + (side1 - side0) * t - p->style->width / 2.0;
        double inside = t < 0 ? 0 : t > 1 ? 1 : t;
        double weight = a.weight + (b.weight - a.weight) * inside;
        int lowest = (int)ceil(side - 0.5);
        for (int j = lowest; j < lowest + p->style->width; j++)
            put(p, steep ? j : i, steep ? i : j, weight);
    }
}

// Narrows [*start, *stop] of a line to where a measure that runs evenly from `a` to `b` is not
// above 0. False when nothing is left.
static bool cut(double a, double b, double *start, double *stop)
{
    if (a > 0 && b > 0)
        return false;
    if (a > 0)
        *start = fmax(*start, a / (a - b));
    else if (b > 0)
        *stop = fmin(*stop, a / (a - b));
    return *start <= *stop;
}

static void draw_clipped(const struct pen *p, struct end a, struct end b)
{
    double w = p->canvas->width, h = p->canvas->height, start = 0, stop = 1;
    double farthest = fmax(fmax(fabs(a.x), fabs(b.x)), fmax(fabs(a.y), fabs(b.y)));
    if (!isfinite(a.x + a.y + b.x + b.y) || farthest > FARTHEST ||
        !cut(-a.x, -b.x, &start, &stop) || !cut(a.x - w, b.x - w, &start, &stop) ||
        !cut(-a.y, -b.y, &start, &stop) || !cut(a.y - h, b.y - h, &start, &stop))
        return;
    struct end whole[] = {a, b};
    a = between(whole[0], whole[1], start);
    b = between(whole[0], whole[1], stop);
    if (!p->style->stippled) {
        draw_solid(p, a, b);
        return;
    }
    double length = fmax(fabs(b.x - a.x), fabs(b.y - a.y));
    for (double at = DASH; at < length; at += 2 * DASH)
        draw_solid(p, between(a, b, at / length), between(a, b, fmin(1, (at + DASH) / length)));
}

void lines_draw_flat(const struct canvas *c, const struct line_style *style, struct vec2 from,
                     struct vec2 to)
{
    struct pen p = {.canvas = c, .style = style};
    draw_clipped(&p, (struct end){from.x + 0.5, c->height - 0.5 - from.y, 0},
                 (struct end){to.x + 0.5, c->height - 0.5 - to.y, 0});
}

static struct end end_at(const struct rays *rays, struct vec3 p)
{
    struct vec3 place = rays_place(rays, p);
    return (struct end){place.x + 0.5, rays->height - 0.5 - place.y,
                        rays->orthographic ? place.z : 1 / place.z};
}

void lines_draw(const struct canvas *c, const struct rays *rays, const struct line_style *style,
                struct vec3 from, struct vec3 to)
{
    double depth_a = rays_place(rays, from).z, depth_b = rays_place(rays, to).z;
    // Cut in the world: what is behind the eye has no place in the picture.
    double start = 0, stop = 1;
    if (!cut(rays->near - depth_a, rays->near - depth_b, &start, &stop) ||
        !cut(depth_a - rays->far, depth_b - rays->far, &start, &stop))
        return;
    struct vec3 along = vec3_sub(to, from);
    struct pen p = {.canvas = c,
                    .style = style,
                    .depth = c->depth,
                    .inverse = !rays->orthographic,
                    .reference = rays->reference};
    draw_clipped(&p, end_at(rays, vec3_add(from, vec3_scale(along, start))),
                 end_at(rays, vec3_add(from, vec3_scale(along, stop))));
}
