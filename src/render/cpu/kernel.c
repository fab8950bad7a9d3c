// kernel.c - the work of one tile.
#include "render/cpu/kernel.h"

#include "base/mem.h"
#include "render/cpu/query.h"
#include "render/cpu/walk.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// What a worker has room for.
static struct tile_room room_for(const struct kernel_job *job)
{
    const struct body *b = job->frame->body;
    return (struct tile_room){.memory = job->memory,
                              .planes = job->frame->planes_most,
                              .leaves = b->leaf_count,
                              .nodes = b->expr.node_count};
}

static void *worker_new(const struct kernel_job *job, uint32_t worker)
{
    struct tile *t = mem_aligned(64, sizeof *t);
    tile_init(t, room_for(job), worker);
    t->lists = walk_new(t->room);
    t->query = query_new(t);
    t->frame = job->frame;
    return t;
}

static bool worker_reuse(void *worker, const struct kernel_job *job)
{
    struct tile *t = worker;
    struct tile_room need = room_for(job), have = t->room;
    if (need.memory != have.memory || need.planes > have.planes || need.leaves > have.leaves ||
        need.nodes > have.nodes)
        return false;
    t->frame = job->frame;
    t->fragments = t->misses = t->open_rays = 0;
    return true;
}

static void worker_add(const void *worker, struct kernel_totals *add_to)
{
    const struct tile *t = worker;
    add_to->fragments += t->fragments;
    add_to->misses += t->misses;
    add_to->open_rays += t->open_rays;
    add_to->bytes += tile_bytes(t) + walk_bytes(t->lists) + query_bytes(t->query);
}

static void worker_delete(void *worker)
{
    struct tile *t = worker;
    query_delete(t->query);
    walk_delete(t->lists);
    tile_free(t);
    free(t);
}

// Faces of all rays that show the crossing `owner`.
static void find_faces(struct tile *t, const struct rays_at *s, int32_t owner, v8i *face)
{
    struct tile_leaf *l = &t->leaves[owner >> 1];
    struct block_leaf *b = tile_crossings(t, l);
    const uint32_t *plane = b && !b->mesh ? tile_planes(t, b, owner & 1) : NULL;
    for (int y = 0; y < BLOCK; y++)
        for (int bits = v8_bits(s->owner[y] == v8_seti(owner)); bits; bits &= bits - 1) {
            int x = __builtin_ctz((unsigned)bits);
            uint32_t p = plane ? plane[y * BLOCK + x] : UINT32_MAX;
            float steep;
            face[y][x] = (int32_t)(p != UINT32_MAX ? t->planes.face[p]
                                                   : tile_face(t, l, y * BLOCK + x, owner & 1,
                                                               s->key[y][x], &steep));
        }
}

// depth - reference of a row of keys.
static v8f row_depth(const struct frame *f, v8f key)
{
    v8f shift = v8_set((float)(f->t0 - f->rays->reference));
    if (f->rays->orthographic)
        return key + shift;
    return key / (v8_set(1) - key * (float)(1 / f->t0)) + shift;
}

// Up to eight numbers; mostly all eight, which is one store.
static void put_row(void *to, const void *from, int width)
{
    if (width == BLOCK)
        memcpy(to, from, BLOCK * 4);
    else
        memcpy(to, from, (size_t)width * 4);
}

static void write_block(struct tile *t, const struct rays_at *s, struct surface_image *image)
{
    const struct frame *f = t->frame;
    v8i face[BLOCK], leaf[BLOCK];
    uint64_t done = 0;

    for (int y = 0; y < BLOCK; y++) {
        v8i nothing = ~(s->key[y] < v8_set(FLT_MAX));
        face[y] = v8_seti((int32_t)SURFACE_CAP);
        leaf[y] = v8_seti((int32_t)SURFACE_NONE);
        done |= (uint64_t)(unsigned)v8_bits(nothing) << (y * BLOCK);
    }
    for (int i = 0; ~done && i < BLOCK_PIXELS; i++) {
        if (done >> i & 1)
            continue;
        int32_t owner = s->owner[i / BLOCK][i % BLOCK];
        v8i number = v8_seti((int32_t)t->leaves[owner >> 1].leaf);
        for (int y = 0; y < BLOCK; y++) {
            v8i same = s->owner[y] == v8_seti(owner);
            leaf[y] = v8_selecti(same, number, leaf[y]);
            done |= (uint64_t)(unsigned)v8_bits(same) << (y * BLOCK);
        }
        find_faces(t, s, owner, face);
    }
    int width = t->x1 - t->bx < BLOCK ? t->x1 - t->bx : BLOCK;
    int height = t->y1 - t->by < BLOCK ? t->y1 - t->by : BLOCK;
    for (int y = 0; y < height; y++) {
        size_t at = (size_t)(t->by + y) * (size_t)image->width + (size_t)t->bx;
        v8i nothing = leaf[y] == v8_seti((int32_t)SURFACE_NONE);
        v8f depth = v8_select(nothing, v8_set(INFINITY), row_depth(f, s->key[y]));
        put_row(image->depth + at, &depth, width);
        put_row(image->leaf + at, &leaf[y], width);
        put_row(image->face + at, &face[y], width);
    }
}

static void clear(struct surface_image *image, struct pixel_rect r)
{
    for (int y = r.y0; y < r.y1; y++) {
        size_t at = (size_t)y * (size_t)image->width + (size_t)r.x0;
        for (int x = 0; x < r.x1 - r.x0; x++) {
            image->depth[at + (size_t)x] = INFINITY;
            image->leaf[at + (size_t)x] = SURFACE_NONE;
        }
    }
}

static bool any_surface(const struct rays_at *s)
{
    v8i some = v8_seti(0);
    for (int y = 0; y < BLOCK; y++)
        some |= s->key[y] < v8_set(FLT_MAX);
    return v8_bits(some);
}

static void first_surface_tile(struct tile *t, const struct kernel_job *job)
{
    struct rays_at s;
    bool query = t->frame->settings->walk == WALK_AUTO, any = false;
    if (query && t->leaf_count)
        query_enter(t->query);
    for (int y = t->y0; y < t->y1 && t->leaf_count; y += BLOCK)
        for (int x = t->x0; x < t->x1; x += BLOCK) {
            tile_block(t, x, y);
            if (query)
                query_block(t->query, &s);
            else
                walk_first(t, 0, t->leaf_count, &s);
            if (any_surface(&s)) {
                write_block(t, &s, job->image);
                any = true;
                continue;
            }
            clear(job->image, (struct pixel_rect){x, y, x + BLOCK < t->x1 ? x + BLOCK : t->x1,
                                                  y + BLOCK < t->y1 ? y + BLOCK : t->y1});
        }
    struct pixel_rect whole = {t->x0, t->y0, t->x1, t->y1};
    if (!t->leaf_count)
        clear(job->image, whole);
    if (job->drawn)
        job->drawn(job->context, whole, !any);
}

static void spans_tile(struct tile *t, const struct kernel_job *job)
{
    if (!t->leaf_count) {
        static const uint32_t none[TILE * TILE + 1];
        struct span_block empty = {t->x0, t->y0, t->x1, t->y1, none, NULL};
        job->sink(job->context, t->worker, &empty);
        return;
    }
    for (int y = t->y0; y < t->y1; y += BLOCK)
        for (int x = t->x0; x < t->x1; x += BLOCK) {
            tile_block(t, x, y);
            walk_block(t, job->sink, job->context);
        }
}

static void tile(void *worker, const struct kernel_job *job, uint32_t tile_number)
{
    struct tile *t = worker;
    tile_enter(t, tile_number);
    if (job->image)
        first_surface_tile(t, job);
    else
        spans_tile(t, job);
}

#define kernel_isa ISA_PASTE(kernel, ISA)

const struct kernel kernel_isa = {.worker_new = worker_new,
                                  .worker_reuse = worker_reuse,
                                  .worker_add = worker_add,
                                  .worker_delete = worker_delete,
                                  .tile = tile};
