// tile.c - leaves of a tile and the crossings of convex leaves with its blocks.
#include "render/cpu/tile.h"

#include "base/mem.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// Keys beyond this are "never"; keeps products with pixel offsets finite.
#define KEY_LIMIT 1e30f
#define REACH     (0.5f * TILE) // pixels from the centre of the tile
#define INLINE    static inline __attribute__((always_inline))

void tile_init(struct tile *t, struct tile_room room, uint32_t worker)
{
    *t = (struct tile){.worker = worker, .room = room};
    for (int bits = 0; bits < 256; bits++)
        for (int lane = 0, at = 0; lane < 8; lane++)
            if (bits >> lane & 1)
                t->front_lanes[bits][at++] = lane;
    uint32_t most = room.planes + 16;
    size_t planes = room.memory / 8 / 56, slots = room.memory / 4 / sizeof(struct block_leaf);
    planes = planes < 4 * (size_t)most ? 4 * (size_t)most : planes;
    planes = planes > 1 << 16 ? (1 << 16 > 4 * most ? 1 << 16 : 4 * most) : planes;
    slots = slots < 16 ? 16 : slots > 2048 ? 2048 : slots;
    t->planes.size = (uint32_t)planes;
    t->planes.a = mem_zalloc((planes + 8) * 4); // vectors may read past the last one
    t->planes.b = mem_zalloc((planes + 8) * 4);
    t->planes.c = mem_zalloc((planes + 8) * 4);
    t->planes.slack = mem_zalloc((planes + 8) * 4);
    t->planes.steep = mem_zalloc((planes + 8) * 4);
    t->planes.steep_x = mem_zalloc((planes + 8) * 4);
    t->planes.steep_y = mem_zalloc((planes + 8) * 4);
    t->planes.face = mem_aligned(32, planes * 4);
    t->planes.exact = mem_alloc(planes * sizeof *t->planes.exact);
    for (size_t i = 0; i < array_count(t->exact); i++)
        t->exact[i] = mem_aligned(32, most * sizeof(double));
    t->slot_size = (uint32_t)slots;
    t->slots = mem_aligned(64, slots * sizeof *t->slots);
    t->index_size = most * 2 + 16 > 1 << 16 ? most * 2 + 16 : 1 << 16;
    t->index = mem_alloc(t->index_size * sizeof *t->index);
    t->key = mem_alloc(t->index_size * sizeof *t->key);
    for (size_t i = 0; i < array_count(t->scratch); i++)
        t->scratch[i] = mem_aligned(32, most * sizeof(float));
    t->list.a = mem_aligned(32, most * sizeof(float));
    t->list.b = mem_aligned(32, most * sizeof(float));
    t->list.c = mem_aligned(32, most * sizeof(float));
    t->list.slack = mem_aligned(32, most * sizeof(float));
    t->list.id = mem_aligned(32, most * sizeof *t->list.id);
}

size_t tile_bytes(const struct tile *t)
{
    size_t plane = 8 * sizeof(float) + sizeof(struct plane_exact);
    return t->planes.size * plane + t->slot_size * sizeof *t->slots +
           t->index_size * (sizeof *t->index + sizeof *t->key) +
           (t->room.planes + 16) * (13 * sizeof(float) + 3 * sizeof(double)) +
           t->leaf_capacity * sizeof *t->leaves +
           t->mesh.crossing_capacity * sizeof *t->mesh.crossings +
           t->mesh.sorted_capacity * sizeof *t->mesh.sorted +
           t->mesh.interval_capacity * sizeof *t->mesh.intervals;
}

void tile_free(struct tile *t)
{
    free(t->planes.a);
    free(t->planes.b);
    free(t->planes.c);
    free(t->planes.slack);
    free(t->planes.steep);
    free(t->planes.steep_x);
    free(t->planes.steep_y);
    free(t->planes.face);
    free(t->planes.exact);
    for (size_t i = 0; i < array_count(t->exact); i++)
        free(t->exact[i]);
    free(t->slots);
    free(t->index);
    free(t->key);
    for (size_t i = 0; i < array_count(t->scratch); i++)
        free(t->scratch[i]);
    free(t->list.a);
    free(t->list.b);
    free(t->list.c);
    free(t->list.slack);
    free(t->list.id);
    free(t->leaves);
    free(t->mesh.crossings);
    free(t->mesh.sorted);
    free(t->mesh.intervals);
}

void tile_enter(struct tile *t, uint32_t tile_number)
{
    const struct frame *f = t->frame;
    int tx = (int)(tile_number % (uint32_t)f->tiles_x),
        ty = (int)(tile_number / (uint32_t)f->tiles_x);
    t->x0 = tx * TILE;
    t->y0 = ty * TILE;
    t->x1 = t->x0 + TILE < f->rays->width ? t->x0 + TILE : f->rays->width;
    t->y1 = t->y0 + TILE < f->rays->height ? t->y0 + TILE : f->rays->height;
    t->cx = t->x0 + 0.5 * (TILE - 1);
    t->cy = t->y0 + 0.5 * (TILE - 1);
    t->leaf_count = 0;
    t->planes.used = 0;
    t->serial++;
    t->slot_count = 0;
    t->index_used = 0;

    struct vec3 d = rays_direction(f->rays, t->cx, t->cy);
    t->origin = rays_origin(f->rays, t->cx, t->cy);
    t->direction = d;
    t->middle = vec3_add(t->origin, vec3_scale(d, f->t0));
    double pixel_x = vec3_length(f->rays->step_x), pixel_y = vec3_length(f->rays->step_y);
    t->slope = (float)(1 / pixel_x); // pixels are square: see rays.h
    t->lean_x = (float)(vec3_dot(d, f->rays->step_x) / pixel_x);
    t->lean_y = (float)(vec3_dot(d, f->rays->step_y) / pixel_y);

    int field = t->y0 / f->field * f->fields_x + t->x0 / f->field;
    float x0 = (float)t->x0, y0 = (float)t->y0, x1 = (float)(t->x1 - 1), y1 = (float)(t->y1 - 1);
    for (uint32_t i = f->field_first[field]; i < f->field_first[field + 1]; i++) {
        const struct frame_leaf *l = &f->leaves[f->field_leaf[i]];
        if (l->x0 > x1 || l->x1 < x0 || l->y0 > y1 || l->y1 < y0)
            continue;
        array_reserve(&t->leaves, &t->leaf_capacity, t->leaf_count + 1);
        t->leaves[t->leaf_count++] = (struct tile_leaf){.frame_leaf = f->field_leaf[i],
                                                        .leaf = l->leaf,
                                                        .part = l->part,
                                                        .near = l->near,
                                                        .far = l->far,
                                                        .x0 = l->x0,
                                                        .y0 = l->y0,
                                                        .x1 = l->x1,
                                                        .y1 = l->y1};
    }
}

void tile_block(struct tile *t, int x, int y)
{
    t->bx = x;
    t->by = y;
    t->serial++;
    t->slot_count = 0;
    t->index_used = 0;
    t->mesh.interval_count = 0;
    t->limit = FLT_MAX;
    t->mx = (float)(x + 0.5 * (BLOCK - 1) - t->cx);
    t->my = (float)(y + 0.5 * (BLOCK - 1) - t->cy);
}

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

INLINE v8f load(const float *p)
{
    v8f v;
    memcpy(&v, p, sizeof v);
    return v;
}

// A key that stays finite as a float, in products with pixel offsets too.
INLINE float limited(double key)
{
    key = key < KEY_LIMIT ? key : KEY_LIMIT;
    return (float)(key > -KEY_LIMIT ? key : -KEY_LIMIT);
}

INLINE void put(float *out, v4d v)
{
    v4f f = __builtin_convertvector(v4_clamp(v, KEY_LIMIT), v4f);
    memcpy(out, &f, sizeof f);
}

// Key planes of all faces of a convex leaf: scratch 0..2 = a, b, c; scratch 3 below 0: front. All
// in double until the constant term is relative to the centre of the tile.
static void make_planes(struct tile *t, const struct planes *p, const struct local_rays *r,
                        bool orthographic)
{
    v4d ex = v4_set(r->eye.x), ey = v4_set(r->eye.y), ez = v4_set(r->eye.z);
    v4d mx = v4_set(r->centre.x), my = v4_set(r->centre.y), mz = v4_set(r->centre.z);
    v4d dx = v4_set(r->direction.x), dy = v4_set(r->direction.y), dz = v4_set(r->direction.z);
    v4d xx = v4_set(r->step_x.x), xy = v4_set(r->step_x.y), xz = v4_set(r->step_x.z);
    v4d yx = v4_set(r->step_y.x), yy = v4_set(r->step_y.y), yz = v4_set(r->step_y.z);
    // A plane seen edge-on, or with the eye on it, is crossed far in front by rays inside of it and
    // never by rays outside. A ray in the plane itself is taken as moved down by 1e-4 pixels and
    // left by 1e-5, more than the rounding of a float key: mesh.c decides the same way, so
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
        put(t->scratch[0] + i, a);
        put(t->scratch[1] + i, b);
        put(t->scratch[2] + i, c);
        put(t->scratch[3] + i, den);
        memcpy(t->exact[0] + i, &a, sizeof a);
        memcpy(t->exact[1] + i, &b, sizeof b);
        memcpy(t->exact[2] + i, &c, sizeof c);
    }
    // What float keys may be off by anywhere in the tile, with a margin.
    for (uint32_t i = 0; i < p->padded; i += 8) {
        v8f slack = v8_abs(load(t->scratch[0] + i)) +
                    (v8_abs(load(t->scratch[1] + i)) + v8_abs(load(t->scratch[2] + i))) * REACH;
        slack *= 8e-7f;
        memcpy(t->scratch[4] + i, &slack, sizeof slack);
    }
}

static void list_pad(struct plane_list *l)
{
    for (uint32_t i = l->n; i % 8; i++) {
        l->a[i] = -FLT_MAX;
        l->b[i] = l->c[i] = l->slack[i] = 0;
    }
}

// Where a list is compressed from: arrays with a sign, and lanes to be left out.
struct plane_source {
    const float *a, *b, *c, *slack;
    const float *side; // takes lanes in which side * sign < 0; NULL takes all
    uint32_t id, n;    // number of the first plane
    float sign;        // 1 front planes, -1 back planes
};

// The plane whose key at (x, y) is the largest; its number in the list or UINT32_MAX.
INLINE uint32_t largest_at(const struct plane_source *s, float x, float y)
{
    v8f best = v8_set(-FLT_MAX), sign = v8_set(s->sign);
    v8i lane = {0, 1, 2, 3, 4, 5, 6, 7}, found = v8_seti(-1);
    for (uint32_t i = 0; i < s->n; i += 8) {
        v8f v = sign * ((load(s->a + i) + load(s->b + i) * x) + load(s->c + i) * y);
        v8i better = (v > best) & (lane < v8_seti((int32_t)s->n));
        if (s->side)
            better &= load(s->side + i) * sign < v8_set(0);
        best = v8_select(better, v, best);
        found = v8_selecti(better, lane, found);
        lane += v8_seti(8);
    }
    uint32_t at = UINT32_MAX;
    float most = -FLT_MAX;
    for (int i = 0; i < 8; i++)
        if (found[i] >= 0 && best[i] > most) {
            most = best[i];
            at = (uint32_t)found[i];
        }
    return at;
}

// Plane q hides p when its key is larger in the whole square of half-width h around (x, y), with a
// margin for rounding.
struct hidden_by {
    v8f a, b, c, x, y, h, sign, centre, slack;
};

INLINE struct hidden_by hidden_by(const struct plane_source *s, uint32_t q, float x, float y,
                                  float h)
{
    float centre = (s->a[q] + s->b[q] * x) + s->c[q] * y;
    return (struct hidden_by){.a = v8_set(s->a[q]),
                              .b = v8_set(s->b[q]),
                              .c = v8_set(s->c[q]),
                              .x = v8_set(x),
                              .y = v8_set(y),
                              .h = v8_set(h),
                              .sign = v8_set(s->sign),
                              .centre = v8_set(centre),
                              .slack = v8_set(-s->slack[q])};
}

// Bit i: plane i of the eight that begin at `at` is on the source's side and not hidden.
INLINE int shown(const struct hidden_by *k, const struct plane_source *s, uint32_t at)
{
    v8f a = load(s->a + at), b = load(s->b + at), c = load(s->c + at);
    v8f ahead = k->sign * (((a + b * k->x) + c * k->y) - k->centre) +
                (v8_abs(b - k->b) + v8_abs(c - k->c)) * k->h + load(s->slack + at);
    v8i keep = ahead >= k->slack; // equal where all numbers are 0, as for q itself
    if (s->side)
        keep &= load(s->side + at) * k->sign < v8_set(0);
    int bits = v8_bits(keep);
    return s->n - at < 8 ? bits & ((1 << (s->n - at)) - 1) : bits;
}

// Bit i: plane i of the eight that begin at `at` is on the source's side.
INLINE int on_side(const struct plane_source *s, uint32_t at)
{
    int bits = s->side ? v8_bits(load(s->side + at) * s->sign < v8_set(0)) : 255;
    return s->n - at < 8 ? bits & ((1 << (s->n - at)) - 1) : bits;
}

static const v8i lanes = {0, 1, 2, 3, 4, 5, 6, 7};

// The numbers of the planes of the source that q does not hide, at `out` (which has room for eight
// more); returns how many.
INLINE uint32_t list_numbers(const struct tile *t, uint32_t *out, const struct plane_source *s,
                             uint32_t q, float x, float y, float h)
{
    struct hidden_by k = hidden_by(s, q, x, y, h);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s->n; i += 8) {
        int bits = shown(&k, s, i);
        v8i number = t->front_lanes[bits] + v8_seti((int32_t)(s->id + i));
        memcpy(out + kept, &number, sizeof number);
        kept += (uint32_t)__builtin_popcount((unsigned)bits);
    }
    return kept;
}

INLINE void append(const struct tile *t, struct plane_list *out, const struct plane_source *s,
                   const uint32_t *ids, uint32_t at, int bits)
{
    v8i order = t->front_lanes[bits], number = lanes + v8_seti((int32_t)(s->id + at));
    v8f sign = v8_set(s->sign);
    if (ids)
        memcpy(&number, ids + at, sizeof number);
    v8f a = v8_permute(load(s->a + at) * sign, order),
        b = v8_permute(load(s->b + at) * sign, order);
    v8f c = v8_permute(load(s->c + at) * sign, order),
        slack = v8_permute(load(s->slack + at), order);
    v8f id = v8_permute((v8f)number, order);
    memcpy(out->a + out->n, &a, sizeof a);
    memcpy(out->b + out->n, &b, sizeof b);
    memcpy(out->c + out->n, &c, sizeof c);
    memcpy(out->slack + out->n, &slack, sizeof slack);
    memcpy(out->id + out->n, &id, sizeof id);
    out->n += (uint32_t)__builtin_popcount((unsigned)bits);
}

// Copies to `out` the planes of the source that q does not hide. `out` may be the source.
INLINE void list_take(const struct tile *t, struct plane_list *out, const struct plane_source *s,
                      const uint32_t *ids, uint32_t q, float x, float y, float h)
{
    struct hidden_by k = hidden_by(s, q, x, y, h);
    out->n = 0;
    for (uint32_t i = 0; i < s->n; i += 8)
        append(t, out, s, ids, i, shown(&k, s, i));
    list_pad(out);
}

// Copies to `out` all planes of the source's side.
INLINE void list_split(const struct tile *t, struct plane_list *out, const struct plane_source *s)
{
    out->n = 0;
    for (uint32_t i = 0; i < s->n; i += 8)
        append(t, out, s, NULL, i, on_side(s, i));
    list_pad(out);
}

// The planes of the source that may have the largest key somewhere in the square; not all of the
// others are dropped once `enough` or fewer are left.
INLINE void cull_planes(const struct tile *t, struct plane_list *out, const struct plane_source *s,
                        float x, float y, float h, uint32_t enough)
{
    const float cx[5] = {0, -1, 1, -1, 1}, cy[5] = {0, -1, -1, 1, 1};
    uint32_t q = largest_at(s, x, y);
    out->n = 0;
    if (q == UINT32_MAX)
        return;
    list_take(t, out, s, NULL, q, x, y, h);
    struct plane_source rest = {
        .a = out->a, .b = out->b, .c = out->c, .slack = out->slack, .sign = 1};
    for (int k = 1; k < 5 && out->n > enough; k++) {
        rest.n = out->n;
        q = largest_at(&rest, x + h * cx[k], y + h * cy[k]);
        list_take(t, out, &rest, out->id, q, x, y, h);
    }
}

// n . direction of planes over the tile, for unit normals: the slope of the key tells how the plane
// leans against the ray. An affine function of the pixel, written to the pool from `at` on.
INLINE void put_steepness(struct tile *t, uint32_t at, v8f a, v8f b, v8f c)
{
    v8f one = v8_set(1), zero = v8_set(0), per_pixel = zero;
    v8f scale = v8_set(t->slope);
    if (!t->frame->rays->orthographic) {
        per_pixel = one / (v8_set((float)t->frame->t0) - a);
        scale = scale * per_pixel;
    }
    v8f gx = b * scale, gy = c * scale;
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
static float keep_side(struct tile *t, uint32_t planes, float sign, bool whole, uint32_t *count)
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
    memcpy(pool->face + pool->used, list.id, list.n * sizeof *pool->face);
    for (uint32_t i = 0; i < list.n; i++) {
        uint32_t p = list.id[i];
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

void tile_prepare(struct tile *t, struct tile_leaf *l)
{
    const struct frame *f = t->frame;
    const struct leaf *leaf = &f->body->leaves[l->leaf];
    const struct planes *p = &leaf->solid->planes;

    if (!leaf->solid->convex) {
        l->state = LEAF_READY;
        return;
    }
    if (t->planes.size - t->planes.used < p->padded + 8)
        forget_planes(t);
    struct local_rays r = local_rays(t, leaf);
    make_planes(t, p, &r, f->rays->orthographic);

    l->plane = t->planes.used;
    // nothing to cull where the tile holds the whole leaf
    bool whole = l->x0 >= (float)t->x0 && l->x1 <= (float)(t->x1 - 1) && l->y0 >= (float)t->y0 &&
                 l->y1 <= (float)(t->y1 - 1);
    float near = keep_side(t, p->count, 1, whole, &l->front);
    float far = keep_side(t, p->count, -1, whole, &l->back);
    l->near = near > l->near ? near : l->near;
    l->far = far < l->far ? far : l->far;
    l->state = l->near < l->far ? LEAF_READY : LEAF_ABSENT;
}

// Smallest steepness in the block of the planes that remain: bounds how far apart on the ray two
// faces can be that are within epsilon of each other.
static float find_band(const struct tile *t, const struct block_leaf *out)
{
    const struct frame *f = t->frame;
    const struct plane_pool *pool = &t->planes;
    float least = FLT_MAX;
    for (uint32_t i = 0; i < out->front + out->back; i++) {
        uint32_t p = t->index[out->planes + i];
        float x = pool->steep_x[p], y = pool->steep_y[p];
        float steep =
            fabsf(pool->steep[p] + x * t->mx + y * t->my) - (fabsf(x) + fabsf(y)) * (0.5f * BLOCK);
        least = steep < least ? steep : least;
    }
    // d key / d t = (t0 / t)^2 = (1 - key / t0)^2 is largest at the near end
    float growth = f->rays->orthographic ? 1 : 1 - out->near / (float)f->t0;
    return 1.01f * f->epsilon * growth * growth / (least > STEEP_LEAST ? least : STEEP_LEAST);
}

// Numbers of the planes of one side that may count in the current block, at `index`; returns how
// many.
static uint32_t block_side(struct tile *t, uint32_t first, uint32_t n, float sign, uint32_t *index)
{
    enum { FEW = 4 }; // culling would cost more than it saves
    if (n <= FEW) {
        for (uint32_t i = 0; i < n; i++)
            index[i] = first + i;
        return n;
    }
    const struct plane_pool *pool = &t->planes;
    struct plane_source source = {pool->a + first,
                                  pool->b + first,
                                  pool->c + first,
                                  pool->slack + first,
                                  NULL,
                                  first,
                                  n,
                                  sign};
    return list_numbers(t, index, &source, largest_at(&source, t->mx, t->my), t->mx, t->my,
                        0.5f * BLOCK);
}

// Does every ray of the block miss? Yes when one front plane is beyond one back plane in all of it,
// or beyond the limit.
static bool block_misses(const struct tile *t, const uint32_t *index, const float *key,
                         uint32_t fronts, uint32_t backs)
{
    enum { PAIRS = 36 }; // beyond, looking costs more than the crossings
    const struct plane_pool *pool = &t->planes;
    const float h = 0.5f * BLOCK;
    for (uint32_t i = 0; i < fronts; i++) {
        float b = pool->b[index[i]], c = pool->c[index[i]];
        if (key[i] - (fabsf(b) + fabsf(c)) * h > t->limit)
            return true;
        for (uint32_t k = fronts; k < fronts + backs && fronts * backs <= PAIRS; k++)
            if (key[i] - key[k] > (fabsf(b - pool->b[index[k]]) + fabsf(c - pool->c[index[k]])) * h)
                return true;
    }
    return false;
}

static struct block_leaf *convex_block(struct tile *t, struct tile_leaf *l, struct block_leaf *out)
{
    const struct plane_pool *pool = &t->planes;
    uint32_t *index = t->index + t->index_used;
    float *key = t->key + t->index_used;
    uint32_t front = block_side(t, l->plane, l->front, 1, index);
    uint32_t back = block_side(t, l->plane + l->front, l->back, -1, index + front);
    for (uint32_t i = 0; i < front + back; i++) {
        const struct plane_exact *e = &pool->exact[index[i]];
        key[i] = limited(e->a + e->b * t->mx + e->c * t->my);
    }
    if (block_misses(t, index, key, front, back))
        return NULL;

    const v8f steps = BLOCK_STEPS;
    v8f enter[BLOCK], leave[BLOCK];
    for (int y = 0; y < BLOCK; y++) {
        enter[y] = v8_set(t->frame->start);
        leave[y] = v8_set(t->frame->end);
    }
    for (uint32_t i = 0; i < front; i++) {
        v8f row = key[i] + pool->b[index[i]] * steps, c = pool->c[index[i]] * steps;
        for (int y = 0; y < BLOCK; y++)
            enter[y] = v8_max(row + c[y], enter[y]);
    }
    for (uint32_t i = front; i < front + back; i++) {
        v8f row = key[i] + pool->b[index[i]] * steps, c = pool->c[index[i]] * steps;
        for (int y = 0; y < BLOCK; y++)
            leave[y] = v8_min(row + c[y], leave[y]);
    }
    v8f near = v8_set(FLT_MAX), far = v8_set(-FLT_MAX);
    for (int y = 0; y < BLOCK; y++) {
        v8i hit = enter[y] < leave[y];
        enter[y] = v8_select(hit, enter[y], v8_set(FLT_MAX));
        leave[y] = v8_select(hit, leave[y], v8_set(-FLT_MAX));
        near = v8_min(near, enter[y]);
        far = v8_max(far, leave[y]);
        *(v8f *)&out->enter[y * BLOCK] = enter[y];
        *(v8f *)&out->leave[y * BLOCK] = leave[y];
    }
    out->near = v8_lowest(near);
    out->far = v8_highest(far);
    if (!(out->near < out->far))
        return NULL;
    out->mesh = false;
    out->known[0] = out->known[1] = false;
    out->front = front;
    out->back = back;
    out->planes = t->index_used;
    t->index_used += front + back;
    out->band = find_band(t, out);
    return out;
}

struct block_leaf *tile_crossings(struct tile *t, struct tile_leaf *l)
{
    if (l->state == LEAF_ABSENT)
        return NULL;
    if (l->serial == t->serial && l->state == LEAF_READY)
        return l->slot == SLOT_ABSENT ? NULL : &t->slots[l->slot];
    if (l->x0 > (float)(t->bx + BLOCK - 1) || l->x1 < (float)t->bx ||
        l->y0 > (float)(t->by + BLOCK - 1) || l->y1 < (float)t->by || l->near > t->limit)
        return NULL;
    if (l->state == LEAF_NEW) {
        tile_prepare(t, l);
        if (l->state == LEAF_ABSENT)
            return NULL;
    }
    if (t->slot_count == t->slot_size || t->index_size - t->index_used < l->front + l->back + 16) {
        t->slot_count = 0; // forget the crossings of this block
        t->index_used = 0;
        t->mesh.interval_count = 0;
        t->serial++;
    }
    struct block_leaf *out = &t->slots[t->slot_count];
    bool convex = t->frame->body->leaves[l->leaf].solid->convex;
    struct block_leaf *b = convex ? convex_block(t, l, out) : tile_mesh_block(t, l, out);
    l->serial = t->serial;
    l->slot = b ? t->slot_count++ : SLOT_ABSENT;
    l->band = b ? b->band : 0;
    return b;
}

const uint32_t *tile_planes(const struct tile *t, struct block_leaf *b, bool leaving)
{
    if (b->known[leaving])
        return b->plane[leaving];
    const struct plane_pool *pool = &t->planes;
    const v8f *key = (const v8f *)(leaving ? b->leave : b->enter), steps = BLOCK_STEPS;
    uint32_t from = leaving ? b->front : 0, to = leaving ? b->front + b->back : b->front;
    v8i plane[BLOCK];
    for (int y = 0; y < BLOCK; y++)
        plane[y] = v8_seti(-1);
    for (uint32_t k = from; k < to; k++) {
        uint32_t p = t->index[b->planes + k];
        v8f row = t->key[b->planes + k] + pool->b[p] * steps, c = pool->c[p] * steps;
        for (int y = 0; y < BLOCK; y++)
            plane[y] = v8_selecti(row + c[y] == key[y], v8_seti((int32_t)p), plane[y]);
    }
    memcpy(b->plane[leaving], plane, sizeof plane);
    b->known[leaving] = true;
    return b->plane[leaving];
}

// The interval of a mesh on a ray whose end is nearest to a key; NULL when the ray has none.
static const struct mesh_interval *
nearest_interval(const struct tile *t, const struct block_leaf *b, int ray, bool leaving, float key)
{
    const struct mesh_interval *m = t->mesh.intervals + b->interval, *found = NULL;
    float nearest = FLT_MAX; // a key may have been taken over from a face within epsilon
    for (uint32_t k = b->first[ray]; k < b->first[ray + 1]; k++) {
        float away = fabsf((leaving ? m[k].leave : m[k].enter) - key);
        if (away < nearest) {
            nearest = away;
            found = &m[k];
        }
    }
    return found;
}

uint32_t tile_face(struct tile *t, struct tile_leaf *l, int i, bool leaving, float key,
                   float *steep)
{
    struct block_leaf *b = tile_crossings(t, l);
    *steep = 1;
    if (!b || key <= t->frame->start)
        return SURFACE_CAP;
    if (b->mesh) {
        const struct mesh_interval *m = nearest_interval(t, b, i, leaving, key);
        if (!m)
            return SURFACE_CAP;
        *steep = leaving ? m->leave_steep : m->enter_steep;
        return leaving ? m->leave_face : m->enter_face;
    }
    const struct plane_pool *pool = &t->planes;
    uint32_t p = tile_planes(t, b, leaving)[i];
    if (p == UINT32_MAX)
        return SURFACE_CAP;
    float x = t->mx + BLOCK_STEPS[i % BLOCK], y = t->my + BLOCK_STEPS[i / BLOCK];
    *steep = fabsf(pool->steep[p] + pool->steep_x[p] * x + pool->steep_y[p] * y);
    return pool->face[p];
}

double tile_thickness(const struct tile *t, float from, float to, float steep)
{
    const struct frame *f = t->frame;
    steep = fmaxf(steep, STEEP_LEAST);
    if (f->rays->orthographic)
        return ((double)to - from) * steep;
    double t0 = f->t0, a = t0 - from, b = t0 - to;
    if (!(b > 0))
        return INFINITY;
    return t0 * t0 * ((double)to - from) / (a * b) * steep;
}
