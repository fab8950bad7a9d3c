// device.c - the device on the processor: frames cut into tiles, tiles handed to threads.
#include "render/device.h"

#include "base/clock.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "render/cpu/kernel.h"
#include "render/cpu/tree_cache.h"

#include <stdlib.h>

enum { MEMORY_DEFAULT = 256 << 20, TILES_SHARED = 16 };

struct cpu_device {
    struct device device;
    const struct kernel *kernel;
    struct tree_cache trees;
    void **workers; // made when there is work for them; NULL until then
    uint32_t worker_count;
};

// Gives each mesh leaf in the picture the tree of its solid.
static void attach_trees(struct cpu_device *d, struct frame *f)
{
    tree_cache_tick(&d->trees);
    for (uint32_t i = 0; i < f->leaf_count; i++) {
        const struct solid *s = f->body->leaves[f->leaves[i].leaf].solid;
        if (!s->convex)
            f->leaves[i].tree = tree_cache_get(&d->trees, s);
    }
}

struct run {
    const struct kernel *kernel;
    const struct kernel_job *job;
    void **workers;
    bool *ready; // has worked on this frame
    struct pixel_rect tiles;
};

// The tiles to be drawn.
static struct pixel_rect tiles_of(const struct frame *f)
{
    struct pixel_rect all = {0, 0, f->tiles_x, f->tiles_y};
    float x0 = INFINITY, y0 = INFINITY, x1 = -1, y1 = -1;
    if (!f->settings->sparse)
        return all;
    for (uint32_t i = 0; i < f->leaf_count; i++) {
        x0 = fminf(x0, f->leaves[i].x0);
        y0 = fminf(y0, f->leaves[i].y0);
        x1 = fmaxf(x1, f->leaves[i].x1);
        y1 = fmaxf(y1, f->leaves[i].y1);
    }
    if (!(x0 <= x1 && y0 <= y1))
        return (struct pixel_rect){0};
    float right = fminf(x1, (float)(f->rays->width - 1));
    float bottom = fminf(y1, (float)(f->rays->height - 1));
    return (struct pixel_rect){(int)fmaxf(x0, 0) / TILE, (int)fmaxf(y0, 0) / TILE,
                               (int)right / TILE + 1, (int)bottom / TILE + 1};
}

static void run_tile(void *context, uint32_t item, uint32_t worker)
{
    struct run *r = context;
    const atomic_bool *cancelled = r->job->frame->settings->cancelled;
    if (cancelled && atomic_load_explicit(cancelled, memory_order_relaxed))
        return;
    if (!r->ready[worker]) {
        if (r->workers[worker] && !r->kernel->worker_reuse(r->workers[worker], r->job)) {
            r->kernel->worker_delete(r->workers[worker]);
            r->workers[worker] = NULL;
        }
        if (!r->workers[worker])
            r->workers[worker] = r->kernel->worker_new(r->job, worker);
        r->ready[worker] = true;
    }
    uint32_t columns = (uint32_t)(r->tiles.x1 - r->tiles.x0);
    uint32_t x = (uint32_t)r->tiles.x0 + item % columns, y = (uint32_t)r->tiles.y0 + item / columns;
    r->kernel->tile(r->workers[worker], r->job, y * (uint32_t)r->job->frame->tiles_x + x);
}

static void render(struct cpu_device *d, const struct body *body, const struct rays *rays,
                   const struct render_settings *settings, struct kernel_job *job,
                   struct render_stats *stats)
{
    struct frame f;
    struct kernel_totals totals = {0};
    double begun = clock_seconds();
    uint32_t workers = parallel_workers(settings->threads);

    frame_init(&f, body, rays, settings);
    f.clip = !body->borders && (!job->image || settings->walk != WALK_AUTO);
    attach_trees(d, &f);
    job->frame = &f;
    job->memory = (settings->memory ? settings->memory : MEMORY_DEFAULT) / workers;
    if (workers > d->worker_count) {
        d->workers = mem_realloc(d->workers, workers * sizeof *d->workers);
        while (d->worker_count < workers)
            d->workers[d->worker_count++] = NULL;
    }
    struct run r = {d->kernel, job, d->workers, mem_zalloc(workers * sizeof(bool)), tiles_of(&f)};
    double ready = clock_seconds();
    uint32_t tiles = (uint32_t)((r.tiles.x1 - r.tiles.x0) * (r.tiles.y1 - r.tiles.y0));
    // Waking threads takes longer than a few tiles.
    parallel_for(tiles, settings->sparse && tiles < TILES_SHARED ? 1 : settings->threads, run_tile,
                 &r);
    for (uint32_t i = 0; i < workers; i++)
        if (r.ready[i])
            d->kernel->worker_add(r.workers[i], &totals);
    free(r.ready);
    discovery_settle(body->table);
    *stats = (struct render_stats){.seconds_setup = ready - begun,
                                   .seconds_draw = clock_seconds() - ready,
                                   .fragments = totals.fragments,
                                   .misses = totals.misses,
                                   .open_rays = totals.open_rays,
                                   .peak_bytes = f.bytes + totals.bytes};
    frame_free(&f);
}

static int first_surface(struct device *d, const struct body *body, const struct rays *rays,
                         const struct render_settings *settings, struct surface_image *out,
                         void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                         void *context, struct render_stats *stats, struct error *err)
{
    (void)err;
    struct kernel_job job = {.image = out, .drawn = drawn, .context = context};
    render((struct cpu_device *)d, body, rays, settings, &job, stats);
    return rays->height;
}

static int spans(struct device *d, const struct body *body, const struct rays *rays,
                 const struct render_settings *settings,
                 void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                 void *context, struct render_stats *stats, struct error *err)
{
    (void)err;
    struct kernel_job job = {.sink = sink, .context = context};
    render((struct cpu_device *)d, body, rays, settings, &job, stats);
    return rays->height;
}

static void end(struct device *device)
{
    struct cpu_device *d = (struct cpu_device *)device;
    tree_cache_free(&d->trees);
    for (uint32_t i = 0; i < d->worker_count; i++)
        if (d->workers[i])
            d->kernel->worker_delete(d->workers[i]);
    free(d->workers);
    free(d);
}

struct device *cpu_device_new(void)
{
    static const struct device_kind kind = {
        .first_surface = first_surface, .spans = spans, .delete = end};
    struct cpu_device *d = mem_zalloc(sizeof *d);
    d->device.kind = &kind;
    d->kernel = &kernel_baseline;
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2"))
        d->kernel = &kernel_avx2;
#endif
    return &d->device;
}
