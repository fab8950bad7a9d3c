// tile.c - leaves of a tile and the crossings of convex leaves with its blocks.
#include "render/cpu/tile.h"

#include "base/mem.h"
#include "render/cpu/plane_list.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

void tile_init(struct tile *t, struct tile_room room, uint32_t worker)
{
    *t = (struct tile){.worker = worker, .room = room};
    for (int bits = 0; bits < 256; bits++)
        for (int lane = 0, at = 0; lane < 8; lane++)
            if (bits >> lane & 1)
                t->front_lanes[bits][at++] = lane;
    uint32_t most = room.planes + 24;
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
           (t->room.planes + 24) * (13 * sizeof(float) + 3 * sizeof(double)) +
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
    t->slope_x = (float)(1 / pixel_x);
    t->slope_y = (float)(1 / pixel_y);
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
