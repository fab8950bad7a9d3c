// picture.c - the picture of a model: its bodies drawn by a device, shaded and laid over each
// other.
//
// OpenSCAD's order: the model, then the background objects, then the highlights; each tests depth
// against what is there and writes its own, transparent or not.
#include "render/picture.h"

#include "base/mem.h"
#include "base/parallel.h"
#include "render/blend.h"
#include "render/outlines.h"
#include "render/sides.h"
#include "render/wires.h"

#include <stdlib.h>
#include <string.h>

enum { ROWS = 16 };   // given to a worker at a time
#define ROUNDING 1e-6 // of depths, which are floats, relative to the distance of the scene

static void reserve(struct picture *p, int width, int height)
{
    if (p->rgb && p->width == width && p->height == height)
        return;
    const struct picture kept = *p;
    picture_free(p);
    p->overlay = kept.overlay;
    p->wires = kept.wires;
    p->sides = kept.sides;
    p->bare = kept.bare;
    size_t n = (size_t)width * (size_t)height;
    struct surface_image *images[] = {&p->surface, &p->scratch};
    for (size_t i = 0; i < array_count(images); i++)
        *images[i] = (struct surface_image){.width = width,
                                            .height = height,
                                            .depth = mem_alloc(n * sizeof(float)),
                                            .leaf = mem_alloc(n * sizeof(uint32_t)),
                                            .face = mem_alloc(n * sizeof(uint32_t))};
    p->rgb = mem_alloc(3 * n);
    p->depth = p->surface.depth;
    p->width = width;
    p->height = height;
}

void picture_free(struct picture *p)
{
    struct surface_image *images[] = {&p->surface, &p->scratch};
    for (size_t i = 0; i < array_count(images); i++) {
        free(images[i]->depth);
        free(images[i]->leaf);
        free(images[i]->face);
    }
    free(p->rgb);
    free(p->owners);
    *p = (struct picture){0};
}

static uint8_t mixed(uint8_t from, uint8_t to, double share)
{
    return (uint8_t)(from + (to - from) * share + 0.5);
}

static void background_at(const struct drawing *d, int y, uint8_t colour[3])
{
    struct rgb top = d->shader->scheme->background, bottom = d->shader->scheme->background_bottom;
    double share = (y + 0.5) / d->picture->height;
    colour[0] = mixed(top.r, bottom.r, share);
    colour[1] = mixed(top.g, bottom.g, share);
    colour[2] = mixed(top.b, bottom.b, share);
}

static void clear_row(const struct drawing *d, int y, int x0, int x1)
{
    struct picture *p = d->picture;
    size_t width = (size_t)(x1 - x0), at = (size_t)y * (size_t)p->width + (size_t)x0;
    uint8_t *row = p->rgb + 3 * at;
    background_at(d, y, row);
    for (size_t done = 1; done < width; done *= 2) // doubles what is there
        memcpy(row + 3 * done, row, 3 * (done < width - done ? done : width - done));
}

static void clear_rows(void *context, uint32_t item, uint32_t worker)
{
    (void)worker;
    const struct drawing *d = context;
    struct picture *p = d->picture;
    int last = (int)(item + 1) * ROWS;
    for (int y = (int)item * ROWS; y < last && y < p->height; y++) {
        clear_row(d, y, 0, p->width);
        for (size_t i = 0, at = (size_t)y * (size_t)p->width; i < (size_t)p->width; i++) {
            p->depth[at + i] = INFINITY;
            p->surface.leaf[at + i] = SURFACE_NONE;
        }
    }
}

static void fill(uint8_t *rgb, const uint8_t colour[3], size_t count)
{
    for (size_t i = 0; i < count; i++)
        memcpy(rgb + 3 * i, colour, 3);
}

// A row of the first body: background and surfaces in runs of one face.
static void shade_runs(const struct drawing *d, struct shade_cache *cache, int y, int x0, int x1)
{
    const struct surface_image *s = d->surface;
    size_t row = (size_t)y * (size_t)s->width, end = row + (size_t)x1, next;
    uint8_t background[3];
    background_at(d, y, background);
    for (size_t i = row + (size_t)x0; i < end; i = next) {
        uint32_t leaf = s->leaf[i];
        next = i + 1;
        if (leaf == SURFACE_NONE) {
            while (next < end && s->leaf[next] == SURFACE_NONE)
                next++;
            fill(d->picture->rgb + 3 * i, background, next - i);
            continue;
        }
        uint32_t face = s->face[i];
        while (!d->shader->edges && next < end && s->leaf[next] == leaf && s->face[next] == face)
            next++;
        struct rgba c = blend_colour(d, cache, i, leaf, face);
        fill(d->picture->rgb + 3 * i, (uint8_t[3]){c.r, c.g, c.b}, next - i);
    }
}

// A row of a later body or layer.
static void shade_nearer(const struct drawing *d, struct shade_cache *cache, int y, int x0, int x1)
{
    size_t row = (size_t)y * (size_t)d->surface->width;
    for (size_t i = row + (size_t)x0; i < row + (size_t)x1; i++)
        blend_surface(d, cache, i);
}

// Shades what was just drawn while it is in the processor's cache.
static void shade_rect(void *context, struct pixel_rect rect, bool nothing)
{
    const struct drawing *d = context;
    struct shade_cache cache;
    if (nothing && !d->first)
        return;
    if (!nothing)
        shade_cache_clear(&cache);
    for (int y = rect.y0; y < rect.y1; y++) {
        if (nothing)
            clear_row(d, y, rect.x0, rect.x1);
        else if (d->first)
            shade_runs(d, &cache, y, rect.x0, rect.x1);
        else
            shade_nearer(d, &cache, y, rect.x0, rect.x1);
    }
}

static void draw_layers(struct device *device, struct drawing *d, const struct body_layers *layers,
                        const struct rays *rays, const struct render_settings *settings,
                        struct render_stats *stats)
{
    d->surface = &d->picture->scratch;
    for (uint32_t i = 0; i < layers->count; i++) {
        const struct layer *layer = &layers->items[i];
        struct render_settings there = *settings;
        struct render_stats one = {0};
        there.sparse = true;
        d->layer = layer;
        if (layer->both_sides)
            device_spans(device, &layer->body, rays, &there, blend_both_sides, d, &one);
        else
            device_first_surface(device, &layer->body, rays, &there, d->surface, shade_rect, d,
                                 &one);
        if (layer->repeats)
            blend_repeated(d);
        render_stats_add(stats, &one);
    }
}

// Notes whose faces the first body shows, if a layer asks. A whole opaque body has noted nothing.
static void begin_owners(const struct drawing *d)
{
    struct picture *p = d->picture;
    size_t n = (size_t)p->width * (size_t)p->height;
    const struct body *body = &d->shader->model->bodies[d->body];
    if (!p->owners)
        p->owners = mem_alloc(n * sizeof *p->owners);
    for (size_t i = 0; i < n; i++) {
        uint32_t leaf = p->surface.leaf[i];
        p->owners[i] = (struct owner){TWIN_NONE, 0, false};
        if (d->first && leaf != SURFACE_NONE)
            p->owners[i] =
                (struct owner){d->twin_of[leaf], p->surface.face[i], body->leaves[leaf].subtracted};
    }
}

void picture_draw(struct picture *p, struct device *device, const struct shader *shader,
                  const struct rays *rays, const struct render_settings *settings,
                  struct render_stats *stats)
{
    struct layers *around = layers_around(shader, rays);
    const struct layers *layers = around ? around : shader->layers;
    *stats = (struct render_stats){0};
    reserve(p, rays->width, rays->height);
    const struct model *model = shader->model;
    bool begun = !p->bare && model->body_count && shader->bodies[0].opaque && !around &&
                 model->bodies[0].kind == BODY_MAIN; // it brings the background
    if (!begun)
        parallel_for(((uint32_t)p->height + ROWS - 1) / ROWS, settings->threads, clear_rows,
                     &(struct drawing){.picture = p, .shader = shader});
    const struct canvas canvas = {p->width, p->height, p->rgb, p->depth};
    if (p->overlay && !begun)
        overlay_draw_among(p->overlay, rays, &canvas);
    for (uint32_t b = 0; b < model->body_count && !p->bare; b++) {
        const struct body *body = &model->bodies[b];
        bool main = body->kind == BODY_MAIN;
        struct drawing d = {.picture = p,
                            .shader = shader,
                            .shading = &shader->bodies[b],
                            .body = b,
                            .light = light_of(rays),
                            .rays = rays,
                            .surface = main ? &p->surface : &p->scratch,
                            .record = main,
                            .first = begun && b == 0,
                            .tolerance =
                                (float)fmax(settings->epsilon, ROUNDING * fabs(rays->reference))};
        struct render_stats one = {0};
        bool owned = layers && layers->repeat;
        d.twin_of = owned ? layers->bodies[b].twin_of : NULL;
        if (owned && b == 0 && !d.first)
            begin_owners(&d);
        if (d.shading->opaque && !(around && main))
            device_first_surface(device, body, rays, settings, d.surface, shade_rect, &d, &one);
        else if (layers)
            draw_layers(device, &d, &layers->bodies[b], rays, settings, stats);
        else
            device_spans(device, body, rays, settings, blend_sorted, &d, &one);
        if (owned && d.first)
            begin_owners(&d);
        render_stats_add(stats, &one);
        if (p->overlay && d.first) // the body is opaque and hides afterwards what is behind it
            overlay_draw_among(p->overlay, rays, &canvas);
    }
    layers_delete(around);
    if (p->wires)
        wires_draw(&canvas, device, model, shader->scheme, p->wires, rays, settings);
    if (p->sides)
        sides_draw(&canvas, model, p->sides, rays);
    outlines_draw(&canvas, shader, rays);
    if (p->overlay)
        overlay_draw_over(p->overlay, rays, &canvas);
}
