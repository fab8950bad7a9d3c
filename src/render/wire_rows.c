// wire_rows.c - the planes that the rays of pixels meet.
#include "render/wire_rows.h"

#include "base/mem.h"
#include "render/device.h"

#include <string.h>

static double depth_of(const struct wires *w, double weight)
{
    return w->rays->orthographic ? weight : 1 / weight;
}

struct vec3 wire_place(const struct wires *w, const struct surface *s, double x, double y)
{
    double depth = depth_of(w, wire_weight(s, x, y));
    return vec3_add(rays_origin(w->rays, x, y), vec3_scale(rays_direction(w->rays, x, y), depth));
}

static bool make_surface(const struct wires *w, uint32_t leaf, uint32_t face, int x, int y,
                         struct surface *out)
{
    const struct rays *r = w->rays;
    const struct leaf *placed = &w->body->leaves[leaf];
    struct vec3 origin = affine_point(&placed->to_local, rays_origin(r, x, y));
    struct vec3 direction = affine_vector(&placed->to_local, rays_direction(r, x, y));
    if (!facets_find(w->facets, placed->solid, face, origin, direction, &out->facet))
        return false;
    out->leaf = leaf;
    out->face = face;
    out->back = placed->subtracted;
    out->part = bent_find(w->bent, leaf, face, origin, direction);
    struct vec3 n = vec3_normalized(affine_normal(&placed->to_local, out->facet.normal));
    out->normal = n;
    struct vec3 corner = affine_point(&placed->to_world, out->facet.corners[0]);
    double away = vec3_dot(n, vec3_sub(corner, r->origin));
    double sx = vec3_dot(n, r->step_x), sy = vec3_dot(n, r->step_y), f = vec3_dot(n, r->forward);
    if (r->orthographic) {
        out->w0 = away / f;
        out->wx = -sx / f;
        out->wy = -sy / f;
    } else {
        out->w0 = f / away;
        out->wx = sx / away;
        out->wy = sy / away;
    }
    return isfinite(out->w0 + out->wx + out->wy);
}

void wire_row_add(const struct wires *w, struct row *row, int x, int y, const struct span *spans,
                  uint32_t count)
{
    uint32_t at = row->first[x];
    array_reserve(&row->surfaces, &row->room, at + 2 * (size_t)count + 1);
    for (uint32_t k = 0; k < count; k++) {
        const struct span *s = &spans[k];
        if (s->enter_face != SURFACE_CAP)
            at += make_surface(w, s->enter_leaf, s->enter_face, x, y, &row->surfaces[at]);
        if (s->leave_leaf != SURFACE_NONE)
            at += make_surface(w, s->leave_leaf, s->leave_face, x, y, &row->surfaces[at]);
    }
    row->first[x + 1] = at;
}

// Whether two surfaces are one and the same plane, whatever leaves they belong to.
bool wire_same_plane(const struct wires *w, const struct surface *a, const struct surface *b,
                     double x, double y)
{
    if (a->leaf == b->leaf && a->face == b->face)
        return a->part.corners == b->part.corners;
    if (fabs(vec3_dot(a->normal, b->normal)) < 1 - 1e-10)
        return false;
    double apart = depth_of(w, wire_weight(a, x, y)) - depth_of(w, wire_weight(b, x, y));
    return fabs(apart) <= w->tolerance;
}

void wire_put(const struct wires *w, struct rgb colour, int x, int y, double weight)
{
    const struct canvas *c = w->canvas;
    if (x < 0 || y < 0 || x >= c->width || y >= c->height)
        return;
    size_t i = (size_t)y * (size_t)c->width + (size_t)x;
    double depth = depth_of(w, weight) - w->rays->reference;
    if (!(depth < (double)c->depth[i] - w->tolerance)) // what lies in a face does not show
        return;
    c->depth[i] = (float)depth;
    memcpy(c->rgb + 3 * i, &colour, 3);
}
