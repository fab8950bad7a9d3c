// agree.c - do two pictures of a body agree, pixel by pixel?
#include "agree.h"

#include "faces.h"

#include <string.h>

struct views {
    struct faces faces;
    const struct rays *rays;
    const struct picture *first, *second;
    double tolerance;
};

// The end of a span, or a first surface.
struct end {
    uint32_t leaf, face;
    float depth;
};

static struct end enter_of(const struct span *s)
{
    return (struct end){s->enter_leaf, s->enter_face, s->enter};
}

static struct end leave_of(const struct span *s)
{
    return (struct end){s->leave_leaf, s->leave_face, s->leave};
}

static struct end surface_of(const struct picture *p, int i)
{
    return (struct end){p->image.leaf[i], p->image.face[i], p->image.depth[i]};
}

// Where a ray meets the plane that an end lies in.
static double plane_depth(const struct views *v, struct end e, int x, int y)
{
    if (e.leaf == SURFACE_NONE)
        return v->rays->far;
    if (e.face == SURFACE_CAP)
        return v->rays->near;
    const struct face_plane *p = &v->faces.planes[v->faces.first[e.leaf] + e.face];
    struct vec3 origin = rays_origin(v->rays, x, y), direction = rays_direction(v->rays, x, y);
    return (p->distance - vec3_dot(p->normal, origin)) / vec3_dot(p->normal, direction);
}

// Do the surfaces that two neighbours show meet between them?
static bool goes_on(const struct views *v, struct end a, int ax, int ay, struct end b, int bx,
                    int by)
{
    if (a.leaf == b.leaf && a.face == b.face)
        return true;
    double here = plane_depth(v, a, ax, ay) - plane_depth(v, b, ax, ay);
    double there = plane_depth(v, a, bx, by) - plane_depth(v, b, bx, by);
    return here * there <= 0 || fabs(here) < v->tolerance || fabs(there) < v->tolerance;
}

static bool surface_goes_on(const struct views *v, int x, int y, int nx, int ny)
{
    struct end a = surface_of(v->first, y * v->rays->width + x);
    struct end b = surface_of(v->first, ny * v->rays->width + nx);
    if (a.leaf == SURFACE_NONE || b.leaf == SURFACE_NONE)
        return a.leaf == b.leaf;
    return goes_on(v, a, x, y, b, nx, ny);
}

static bool spans_go_on(const struct views *v, int x, int y, int nx, int ny)
{
    const struct pixel_spans *a = &v->first->spans[y * v->rays->width + x];
    const struct pixel_spans *b = &v->first->spans[ny * v->rays->width + nx];
    if (a->count != b->count)
        return false;
    for (uint32_t i = 0; i < a->count; i++)
        if (!goes_on(v, enter_of(&a->items[i]), x, y, enter_of(&b->items[i]), nx, ny) ||
            !goes_on(v, leave_of(&a->items[i]), x, y, leave_of(&b->items[i]), nx, ny))
            return false;
    return true;
}

static bool at_silhouette(const struct views *v, int x, int y,
                          bool (*go_on)(const struct views *v, int x, int y, int nx, int ny))
{
    for (int ny = y - 1; ny <= y + 1; ny++)
        for (int nx = x - 1; nx <= x + 1; nx++)
            if (nx >= 0 && ny >= 0 && nx < v->rays->width && ny < v->rays->height &&
                !go_on(v, x, y, nx, ny))
                return true;
    return false;
}

// Of what is no number: INFINITY.
static double distance(float a, float b)
{
    double d = fabs((double)a - (double)b);
    return d >= 0 ? d : INFINITY;
}

// Of pixels that show something in one picture only: INFINITY.
static double surface_distance(const struct picture *a, const struct picture *b, int i)
{
    bool shown = a->image.leaf[i] != SURFACE_NONE;
    if (shown != (b->image.leaf[i] != SURFACE_NONE))
        return INFINITY;
    return shown ? distance(a->image.depth[i], b->image.depth[i]) : 0;
}

static double spans_distance(const struct pixel_spans *a, const struct pixel_spans *b)
{
    double most = 0;
    if (a->count != b->count || a->visits != 1 || b->visits != 1)
        return INFINITY;
    for (uint32_t i = 0; i < a->count; i++) {
        most = fmax(most, distance(a->items[i].enter, b->items[i].enter));
        most = fmax(most, distance(a->items[i].leave, b->items[i].leave));
    }
    return most;
}

static bool same_leaves(const struct pixel_spans *a, const struct pixel_spans *b)
{
    if (a->count != b->count)
        return false;
    for (uint32_t i = 0; i < a->count; i++)
        if (a->items[i].enter_leaf != b->items[i].enter_leaf ||
            a->items[i].leave_leaf != b->items[i].leave_leaf)
            return false;
    return true;
}

static void note(struct agreement_of *out, bool same, double depth, const struct views *v,
                 bool border, int x, int y)
{
    double inner = border ? 0 : depth;
    bool deepest = inner > fmax(out->depth, v->tolerance);
    if (deepest || (!same && !out->others && out->depth <= v->tolerance)) {
        out->x = x;
        out->y = y;
    }
    out->others += !same;
    out->apart += !same && depth > v->tolerance;
    out->depth = fmax(out->depth, inner);
}

void agree_compare(struct agreement *out, const struct body *body, const struct rays *rays,
                   const struct picture *first, const struct picture *second, double tolerance)
{
    struct views v = {.rays = rays, .first = first, .second = second, .tolerance = tolerance};
    faces_init(&v.faces, body);
    *out = (struct agreement){0};
    for (int y = 0; y < rays->height; y++)
        for (int x = 0; x < rays->width; x++) {
            int i = y * rays->width + x;
            const struct pixel_spans *a = &first->spans[i], *b = &second->spans[i];
            bool border = at_silhouette(&v, x, y, surface_goes_on);
            out->pixels++;
            out->hits += first->image.leaf[i] != SURFACE_NONE;
            out->silhouettes += border;
            note(&out->surface, first->image.leaf[i] == second->image.leaf[i],
                 surface_distance(first, second, i), &v, border, x, y);
            note(&out->spans, same_leaves(a, b), spans_distance(a, b), &v,
                 at_silhouette(&v, x, y, spans_go_on), x, y);
        }
    faces_free(&v.faces);
}

static void add_of(struct agreement_of *sum, const struct agreement_of *one)
{
    sum->others += one->others;
    sum->apart += one->apart;
    sum->depth = fmax(sum->depth, one->depth);
}

void agree_add(struct agreement *sum, const struct agreement *one)
{
    sum->pixels += one->pixels;
    sum->hits += one->hits;
    sum->silhouettes += one->silhouettes;
    sum->unequal += one->unequal;
    add_of(&sum->surface, &one->surface);
    add_of(&sum->spans, &one->spans);
}
