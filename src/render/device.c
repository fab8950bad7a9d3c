// device.c - the functions of a device, whichever kind it is, and what happens when one fails.
#include "render/device.h"

#include <string.h>

void render_stats_pass(struct render_stats *stats, const struct render_pass *pass)
{
    struct render_pass *p = stats->passes, *end = stats->passes + RENDER_PASSES;
    while (p < end && p->name && strcmp(p->name, pass->name))
        p++;
    if (p == end)
        return;
    p->name = pass->name;
    p->seconds += pass->seconds;
    p->count += pass->count;
}

void render_waits_add(struct render_waits *sum, const struct render_waits *one)
{
    sum->count += one->count;
    sum->seconds += one->seconds;
    if (one->longest > sum->longest)
        sum->longest = one->longest;
}

void render_stats_add(struct render_stats *sum, const struct render_stats *one)
{
    sum->seconds_setup += one->seconds_setup;
    sum->seconds_draw += one->seconds_draw;
    sum->fragments += one->fragments;
    sum->misses += one->misses;
    sum->missing += one->missing;
    sum->open_rays += one->open_rays;
    if (one->peak_bytes > sum->peak_bytes)
        sum->peak_bytes = one->peak_bytes;
    if (one->model_bytes > sum->model_bytes)
        sum->model_bytes = one->model_bytes;
    sum->table_bytes += one->table_bytes;
    render_waits_add(&sum->waits, &one->waits);
    for (int i = 0; i < RENDER_PASSES && one->passes[i].name; i++)
        render_stats_pass(sum, &one->passes[i]);
}

void device_delete(struct device *d)
{
    if (!d)
        return;
    device_delete(d->instead);
    d->kind->delete (d);
}

bool device_failed(struct device *d, struct error *why)
{
    bool failed = d->failure.text[0] != 0;
    if (failed)
        *why = d->failure;
    d->failure.text[0] = 0;
    return failed;
}

static void replace(struct device *d, const struct error *why)
{
    d->instead = cpu_device_new();
    error_set(&d->failure, "%s; the processor draws from here on", why->text);
}

// Whoever asked for a picture is told of rows that another device draws as a picture of their own.
struct below {
    int rows; // above them
    void (*drawn)(void *context, struct pixel_rect rect, bool nothing);
    void (*sink)(void *context, uint32_t worker, const struct span_block *block);
    void *context;
};

static void drawn_below(void *context, struct pixel_rect rect, bool nothing)
{
    const struct below *b = context;
    rect.y0 += b->rows;
    rect.y1 += b->rows;
    b->drawn(b->context, rect, nothing);
}

static void sink_below(void *context, uint32_t worker, const struct span_block *block)
{
    const struct below *b = context;
    struct span_block moved = *block;
    moved.y0 += b->rows;
    moved.y1 += b->rows;
    b->sink(b->context, worker, &moved);
}

void device_first_surface(struct device *d, const struct body *body, const struct rays *rays,
                          const struct render_settings *settings, struct surface_image *out,
                          void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                          void *context, struct render_stats *stats)
{
    struct error err = {0};
    struct render_stats begun = {0}, unwanted;
    int rows = 0;
    stats = stats ? stats : &unwanted;
    *stats = begun;
    out->width = rays->width;
    out->height = rays->height;
    if (!d->instead) {
        rows = d->kind->first_surface(d, body, rays, settings, out, drawn, context, stats, &err);
        if (rows == rays->height)
            return;
        begun = *stats;
        replace(d, &err);
    }
    size_t done = (size_t)rows * (size_t)rays->width;
    struct rays rest = rays_below(rays, rows);
    struct below below = {.rows = rows, .drawn = drawn, .context = context};
    struct surface_image image = {
        .depth = out->depth + done, .leaf = out->leaf + done, .face = out->face + done};
    device_first_surface(d->instead, body, &rest, settings, &image, drawn ? drawn_below : NULL,
                         &below, stats);
    render_stats_add(stats, &begun);
}

void device_spans(struct device *d, const struct body *body, const struct rays *rays,
                  const struct render_settings *settings,
                  void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                  void *context, struct render_stats *stats)
{
    struct error err = {0};
    struct render_stats begun = {0}, unwanted;
    int rows = 0;
    stats = stats ? stats : &unwanted;
    *stats = begun;
    if (!d->instead) {
        rows = d->kind->spans(d, body, rays, settings, sink, context, stats, &err);
        if (rows == rays->height)
            return;
        begun = *stats;
        replace(d, &err);
    }
    struct rays rest = rays_below(rays, rows);
    struct below below = {.rows = rows, .sink = sink, .context = context};
    device_spans(d->instead, body, &rest, settings, sink_below, &below, stats);
    render_stats_add(stats, &begun);
}
