// kernel.c - the work of one tile.
#include "render/cpu/kernel.h"

#include "base/mem.h"
#include "render/cpu/query.h"
#include "render/cpu/walk.h"

#include <float.h>
#include <stdlib.h>

static void *worker_new(const struct kernel_job *job, uint32_t worker)
{
    struct tile *t = mem_aligned(64, sizeof *t);
    tile_init(t, job->frame, worker, job->memory);
    t->lists = walk_new(t, job->memory);
    if (job->image)
        t->query = query_new(t);
    return t;
}

static void worker_delete(void *worker, struct kernel_totals *add_to)
{
    struct tile *t = worker;
    add_to->fragments += t->fragments;
    add_to->misses += t->misses;
    add_to->open_rays += t->open_rays;
    add_to->bytes += t->bytes + t->leaf_capacity * sizeof *t->leaves;
    query_delete(t->query);
    walk_delete(t->lists);
    tile_free(t);
    free(t);
}

// The latest leaf of the file that is added, not subtracted, around the start of a ray.
static uint32_t leaf_around_start(struct tile *t, int ray)
{
    uint32_t found = SURFACE_NONE;
    for (uint32_t i = 0; i < t->leaf_count; i++) {
        struct tile_leaf *l = &t->leaves[i];
        if (t->frame->body->leaves[l->leaf].subtracted || l->near > t->frame->start)
            continue;
        const struct block_leaf *b = tile_crossings(t, l);
        bool around =
            b &&
            (b->mesh ? b->first[ray] < b->first[ray + 1] &&
                           t->mesh.intervals[b->interval + b->first[ray]].enter <= t->frame->start
                     : b->enter[ray] <= t->frame->start && b->leave[ray] > t->frame->start);
        if (around && (found == SURFACE_NONE || l->leaf > found))
            found = l->leaf;
    }
    return found;
}

struct block_faces {
    _Alignas(32) uint32_t face[BLOCK_PIXELS];
};

// Faces of all rays that show the crossing `owner`: the plane whose key is the ray's.
static void find_faces(struct tile *t, const struct rays_at *s, int32_t owner, uint64_t rays,
                       struct block_faces *out)
{
    struct tile_leaf *l = &t->leaves[owner >> 1];
    float steep;
    for (; rays; rays &= rays - 1) {
        int i = __builtin_ctzll(rays);
        out->face[i] = tile_face(t, l, i, owner & 1, s->key[i / BLOCK][i % BLOCK], &steep);
    }
}

static void write_block(struct tile *t, const struct rays_at *s, struct surface_image *image)
{
    const struct frame *f = t->frame;
    struct block_faces faces;
    uint64_t done = 0;

    for (int i = 0; i < BLOCK_PIXELS; i++)
        if (!(s->key[i / BLOCK][i % BLOCK] < FLT_MAX))
            done |= (uint64_t)1 << i;
    for (int i = 0; i < BLOCK_PIXELS; i++) {
        int32_t owner = s->owner[i / BLOCK][i % BLOCK];
        if (done >> i & 1)
            continue;
        if (owner < 0) {
            faces.face[i] = SURFACE_CAP;
            done |= (uint64_t)1 << i;
            continue;
        }
        uint64_t same = 0;
        for (int y = 0; y < BLOCK; y++)
            same |= (uint64_t)(unsigned)v8_bits(s->owner[y] == v8_seti(owner)) << (y * BLOCK);
        same &= ~done;
        find_faces(t, s, owner, same, &faces);
        done |= same;
    }
    int width = t->x1 - t->bx < BLOCK ? t->x1 - t->bx : BLOCK;
    int height = t->y1 - t->by < BLOCK ? t->y1 - t->by : BLOCK;
    for (int y = 0; y < height; y++) {
        size_t at = (size_t)(t->by + y) * (size_t)image->width + (size_t)t->bx;
        for (int x = 0; x < width; x++) {
            float key = s->key[y][x];
            int32_t owner = s->owner[y][x];
            uint32_t leaf = SURFACE_NONE;
            float depth = INFINITY;
            if (key < FLT_MAX) {
                leaf =
                    owner >= 0 ? t->leaves[owner >> 1].leaf : leaf_around_start(t, y * BLOCK + x);
                depth = (float)(frame_depth(f, key) - f->rays->reference);
            }
            image->depth[at + (size_t)x] = depth;
            image->leaf[at + (size_t)x] = leaf;
            image->face[at + (size_t)x] =
                leaf == SURFACE_NONE ? SURFACE_CAP : faces.face[y * BLOCK + x];
        }
    }
}

static void write_background(const struct tile *t, struct surface_image *image)
{
    for (int y = t->y0; y < t->y1; y++)
        for (int x = t->x0; x < t->x1; x++) {
            size_t at = (size_t)y * (size_t)image->width + (size_t)x;
            image->depth[at] = INFINITY;
            image->leaf[at] = SURFACE_NONE;
            image->face[at] = SURFACE_CAP;
        }
}

static void first_surface_tile(struct tile *t, struct surface_image *image)
{
    struct rays_at s;
    bool query = t->frame->settings->walk == WALK_AUTO;
    if (!t->leaf_count) {
        write_background(t, image);
        return;
    }
    if (query)
        query_enter(t->query);
    for (int y = t->y0; y < t->y1; y += BLOCK)
        for (int x = t->x0; x < t->x1; x += BLOCK) {
            tile_block(t, x, y);
            if (query)
                query_block(t->query, &s);
            else
                walk_first(t, 0, t->leaf_count, &s);
            write_block(t, &s, image);
        }
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
        first_surface_tile(t, job->image);
    else
        spans_tile(t, job);
}

#define kernel_isa ISA_PASTE(kernel, ISA)
#define TEXT_(x)   #x
#define TEXT(x)    TEXT_(x)

const struct kernel kernel_isa = {TEXT(ISA), worker_new, worker_delete, tile};
