// planes.c - the faces of a convex leaf as key planes over a tile.
#include "render/cpu/plane_list.h"

#include <float.h>
#include <string.h>

// The rays of the tile in the coordinates of one leaf.
struct local_rays {
    struct vec3 eye, centre, direction, step_x, step_y;
    double scale; // 1 / t0 in perspective
};

static struct local_rays local_rays(const struct tile *t, const struct leaf *leaf)
{
    const struct frame *f = t->frame;
    const struct affine *m = &leaf->to_local;
    struct local_rays r;
    double s = f->rays->orthographic ? 1 : f->t0;
    r.eye = affine_point(m, t->origin);
    r.centre = affine_point(m, t->middle);
    r.direction = affine_vector(m, t->direction);
    r.step_x = vec3_scale(affine_vector(m, f->rays->step_x), s);
    r.step_y = vec3_scale(affine_vector(m, f->rays->step_y), s);
    r.scale = f->rays->orthographic ? 1 : 1 / f->t0;
    return r;
}

INLINE void put(float *out, v4d v)
{
    v4f f = __builtin_convertvector(v4_clamp(v, KEY_LIMIT), v4f);
    memcpy(out, &f, sizeof f);
}

// Key planes of all faces of a convex leaf, from place `at` on: scratch 0..2 = a, b, c; scratch 3
// below 0: front. All in double until the constant term is relative to the centre of the tile.
static void make_planes(struct tile *t, const struct planes *p, const struct local_rays *r,
                        uint32_t at)
{
    bool orthographic = t->frame->rays->orthographic;
    v4d ex = v4_set(r->eye.x), ey = v4_set(r->eye.y), ez = v4_set(r->eye.z);
    v4d mx = v4_set(r->centre.x), my = v4_set(r->centre.y), mz = v4_set(r->centre.z);
    v4d dx = v4_set(r->direction.x), dy = v4_set(r->direction.y), dz = v4_set(r->direction.z);
    v4d xx = v4_set(r->step_x.x), xy = v4_set(r->step_x.y), xz = v4_set(r->step_x.z);
    v4d yx = v4_set(r->step_y.x), yy = v4_set(r->step_y.y), yz = v4_set(r->step_y.z);
    // A plane seen edge-on, or with the eye on it, is crossed far in front by rays inside of it and
    // never by rays outside. A ray in the plane itself is taken as moved down by 1e-4 pixels and
    // left by 1e-5, more than the rounding of a float key: mesh_scan.c decides the same way, so
    // neighbouring solids agree.
    v4d tiny = v4_set(orthographic ? -1e-25 : 1e-25), scale = v4_set(r->scale);
    v4d least = v4_set(orthographic ? 1e-13 * vec3_length(r->direction)
                                    : 1e-13 * vec3_length(r->eye) * r->scale);
    for (uint32_t i = 0; i < p->padded; i += 4) {
        v4d nx, ny, nz, d;
        memcpy(&nx, p->nx + i, sizeof nx);
        memcpy(&ny, p->ny + i, sizeof ny);
        memcpy(&nz, p->nz + i, sizeof nz);
        memcpy(&d, p->d + i, sizeof d);
        v4d num = d - (nx * mx + ny * my + nz * mz);
        v4d den = orthographic ? nx * dx + ny * dy + nz * dz
                               : (d - (nx * ex + ny * ey + nz * ez)) * scale;
        v4d slope_x = nx * xx + ny * xy + nz * xz, slope_y = nx * yx + ny * yy + nz * yz;
        v4l edge_on = (den > -least) & (den < least);
        den = (v4d)(((v4l)tiny & edge_on) | ((v4l)den & ~edge_on));
        v4d moved = num - slope_y * 1e-4 + slope_x * 1e-5;
        num = (v4d)(((v4l)moved & edge_on) | ((v4l)num & ~edge_on));
        v4d inv = v4_set(1) / den;
        v4d a = num * inv, b = -slope_x * inv, c = -slope_y * inv;
        put(t->scratch[0] + at + i, a);
        put(t->scratch[1] + at + i, b);
        put(t->scratch[2] + at + i, c);
        put(t->scratch[3] + at + i, den);
        memcpy(t->exact[0] + at + i, &a, sizeof a);
        memcpy(t->exact[1] + at + i, &b, sizeof b);
        memcpy(t->exact[2] + at + i, &c, sizeof c);
    }
    // What float keys may be off by anywhere in the tile, with a margin.
    for (uint32_t i = at; i < at + p->padded; i += 8) {
        v8f slack = v8_abs(load(t->scratch[0] + i)) +
                    (v8_abs(load(t->scratch[1] + i)) + v8_abs(load(t->scratch[2] + i))) * REACH;
        slack *= 8e-7f;
        memcpy(t->scratch[4] + i, &slack, sizeof slack);
    }
}

// n . direction of planes over the tile, for unit normals: the slope of the key tells how the plane
// leans against the ray. An affine function of the pixel, written to the pool from `at` on.
INLINE void put_steepness(struct tile *t, uint32_t at, v8f a, v8f b, v8f c)
{
    v8f one = v8_set(1), zero = v8_set(0), per_pixel = zero;
    v8f scale_x = v8_set(t->slope_x), scale_y = v8_set(t->slope_y);
    if (!t->frame->rays->orthographic) {
        per_pixel = one / (v8_set((float)t->frame->t0) - a);
        scale_x = scale_x * per_pixel;
        scale_y = scale_y * per_pixel;
    }
    v8f gx = b * scale_x, gy = c * scale_y;
    v8f along = one + gx * t->lean_x + gy * t->lean_y;
    v8f squared = gx * gx + gy * gy + along * along;
    v8f steep = one / v8_sqrt(squared);
    v8f x = -(b * per_pixel) * steep, y = -(c * per_pixel) * steep;
    x = v8_select(v8_abs(x) < v8_set(KEY_LIMIT), x, zero); // a plane along the middle ray
    y = v8_select(v8_abs(y) < v8_set(KEY_LIMIT), y, zero);
    memcpy(t->planes.steep + at, &steep, sizeof steep);
    memcpy(t->planes.steep_x + at, &x, sizeof x);
    memcpy(t->planes.steep_y + at, &y, sizeof y);
}

// Culls the planes of one side over the tile and appends them to the pool. Returns the bound of the
// key: the entry is nowhere below it (front), the exit nowhere above it (back).
static float keep_side(struct tile *t, uint32_t planes, uint32_t faces, float sign, bool whole,
                       uint32_t *count)
{
    struct plane_pool *pool = &t->planes;
    struct plane_source source = {.a = t->scratch[0],
                                  .b = t->scratch[1],
                                  .c = t->scratch[2],
                                  .side = t->scratch[3],
                                  .slack = t->scratch[4],
                                  .n = planes,
                                  .sign = sign};
    struct plane_list list = t->list;
    v8f h = v8_set(0.5f * TILE), bound = v8_set(-FLT_MAX), flip = v8_set(sign);

    if (planes <= 8 || whole)
        list_split(t, &list, &source);
    else
        cull_planes(t, &list, &source, 0, 0, 0.5f * TILE, 16);
    for (uint32_t i = 0; i < list.n; i += 8) {
        v8f a = load(list.a + i), b = load(list.b + i), c = load(list.c + i);
        bound = v8_max(bound, a - (v8_abs(b) + v8_abs(c)) * h);
        a *= flip;
        b *= flip;
        c *= flip;
        put_steepness(t, pool->used + i, a, b, c);
        memcpy(pool->a + pool->used + i, &a, sizeof a);
        memcpy(pool->b + pool->used + i, &b, sizeof b);
        memcpy(pool->c + pool->used + i, &c, sizeof c);
        memcpy(pool->slack + pool->used + i, list.slack + i, sizeof c);
    }
    for (uint32_t i = 0; i < list.n; i++) {
        uint32_t p = list.id[i];
        pool->face[pool->used + i] = p < faces ? p : FACE_REGION;
        pool->exact[pool->used + i] =
            (struct plane_exact){t->exact[0][p], t->exact[1][p], t->exact[2][p]};
    }
    pool->used += list.n;
    *count = list.n;
    return list.n ? sign * v8_highest(bound) : sign > 0 ? t->frame->start : t->frame->end;
}

static void forget_planes(struct tile *t)
{
    for (uint32_t i = 0; i < t->leaf_count; i++)
        if (t->leaves[i].state == LEAF_READY)
            t->leaves[i].state = LEAF_NEW;
    t->planes.used = 0;
}

enum { REGION_PLANES = 8 }; // six and padding

// The borders of the leaf's region of interest that cut the leaf, in its coordinates; returns their
// number. A margin keeps the faces of leaves that only touch their region.
static uint32_t region_planes(const struct leaf *leaf, const struct box *roi, double margin,
                              double planes[4][REGION_PLANES])
{
    const double(*m)[4] = leaf->to_world.m;
    const double low[3] = {roi->min.x, roi->min.y, roi->min.z};
    const double high[3] = {roi->max.x, roi->max.y, roi->max.z};
    const double box_low[3] = {leaf->box.min.x, leaf->box.min.y, leaf->box.min.z};
    const double box_high[3] = {leaf->box.max.x, leaf->box.max.y, leaf->box.max.z};
    uint32_t n = 0;
    for (int side = 0; side < 6; side++) {
        int axis = side / 2;
        double sign = side & 1 ? 1 : -1, size = box_high[axis] - box_low[axis];
        double inside =
            (side & 1 ? box_high[axis] - high[axis] : low[axis] - box_low[axis]) - margin;
        struct vec3 row = {m[axis][0], m[axis][1], m[axis][2]};
        double scale = sign / vec3_length(row);
        if (!(inside > 1e-6 * size) || !isfinite(scale))
            continue;
        planes[0][n] = row.x * scale;
        planes[1][n] = row.y * scale;
        planes[2][n] = row.z * scale;
        double border = side & 1 ? high[axis] + margin : low[axis] - margin;
        planes[3][n++] = (border - m[axis][3]) * scale;
    }
    for (uint32_t i = n; i < REGION_PLANES; i++)
        for (int k = 0; k < 4; k++)
            planes[k][i] = n ? planes[k][0] : 0;
    return n;
}

// Adds the borders of the region behind the planes of the solid; returns the number of all planes.
static uint32_t add_region(struct tile *t, const struct tile_leaf *l, const struct local_rays *r)
{
    const struct body *body = t->frame->body;
    const struct planes *p = &body->leaves[l->leaf].solid->planes;
    double planes[4][REGION_PLANES];
    if (!t->frame->clip || !body->roi)
        return p->count;
    double margin = roi_margin(t->frame->settings->epsilon);
    uint32_t n = region_planes(&body->leaves[l->leaf], &body->roi[l->leaf], margin, planes);
    if (!n)
        return p->count;
    struct planes region = {.nx = planes[0],
                            .ny = planes[1],
                            .nz = planes[2],
                            .d = planes[3],
                            .count = n,
                            .padded = REGION_PLANES};
    make_planes(t, &region, r, p->padded);
    for (uint32_t i = p->count; i < p->padded; i++)
        t->scratch[3][i] = 0; // the padding between is on no side
    return p->padded + n;
}

void tile_prepare(struct tile *t, struct tile_leaf *l)
{
    const struct leaf *leaf = &t->frame->body->leaves[l->leaf];
    const struct planes *p = &leaf->solid->planes;

    if (!leaf->solid->convex) {
        l->state = LEAF_READY;
        return;
    }
    if (t->planes.size - t->planes.used < p->padded + REGION_PLANES + 8)
        forget_planes(t);
    struct local_rays r = local_rays(t, leaf);
    make_planes(t, p, &r, 0);
    uint32_t count = add_region(t, l, &r);

    l->plane = t->planes.used;
    // nothing to cull where the tile holds the whole leaf
    bool whole = l->x0 >= (float)t->x0 && l->x1 <= (float)(t->x1 - 1) && l->y0 >= (float)t->y0 &&
                 l->y1 <= (float)(t->y1 - 1);
    float near = keep_side(t, count, p->count, 1, whole, &l->front);
    float far = keep_side(t, count, p->count, -1, whole, &l->back);
    l->near = near > l->near ? near : l->near;
    l->far = far < l->far ? far : l->far;
    l->state = l->near < l->far ? LEAF_READY : LEAF_ABSENT;
}
