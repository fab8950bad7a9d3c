// picture.c - the picture of a model: its bodies drawn by a device, shaded and laid over each
// other.
//
// OpenSCAD's order: the model, then the background objects, then the highlights; each tests depth
// against what is there and writes its own, transparent or not. Of a transparent object that is cut
// or intersected only the nearest surface shows, of one that stands alone also its far side.
#include "render/picture.h"

#include "base/mem.h"
#include "base/parallel.h"
#include "render/outlines.h"

#include <stdlib.h>
#include <string.h>

enum { ROWS = 16 };           // given to a worker at a time
enum { LAYERS = 1024 };       // of transparent surfaces that a ray shows at most
#define ROUNDING 1e-6         // of depths, which are floats, relative to the distance of the scene
#define FAINTEST (1.0f / 512) // what shows through less than this is not seen in 8 bits

// One body being drawn, as the workers see it.
struct drawing {
    struct picture *picture;
    const struct shader *shader;
    const struct body_shading *shading;
    uint32_t body;
    struct light light;
    struct surface_image *surface; // of an opaque body
    bool record;                   // into picture->surface
    bool first;                    // nothing was drawn before it
    float tolerance;               // depths within it are equal
};

static void reserve(struct picture *p, int width, int height)
{
    if (p->rgb && p->width == width && p->height == height)
        return;
    const struct overlay *overlay = p->overlay;
    picture_free(p);
    p->overlay = overlay;
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
        while (next < end && s->leaf[next] == leaf && s->face[next] == face)
            next++;
        struct rgba c = shade_cached(cache, d->shader, d->body, &d->light, leaf, face);
        fill(d->picture->rgb + 3 * i, (uint8_t[3]){c.r, c.g, c.b}, next - i);
    }
}

// A row of a later body: what is nearer than all before it.
static void shade_nearer(const struct drawing *d, struct shade_cache *cache, int y, int x0, int x1)
{
    const struct surface_image *s = d->surface;
    struct picture *p = d->picture;
    size_t row = (size_t)y * (size_t)s->width;
    for (size_t i = row + (size_t)x0; i < row + (size_t)x1; i++) {
        if (s->leaf[i] == SURFACE_NONE || s->depth[i] > p->depth[i] + d->tolerance)
            continue;
        struct rgba c = shade_cached(cache, d->shader, d->body, &d->light, s->leaf[i], s->face[i]);
        memcpy(p->rgb + 3 * i, &c, 3);
        p->depth[i] = s->depth[i];
    }
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

// Colours met along a ray, from the front.
struct layers {
    struct rgba colours[LAYERS];
    uint32_t count;
    float through; // share that what follows still has
};

// Which parts of the body have shown their nearest surface on this ray. Past the capacity a part
// may show again: with that many layers in front it is all but invisible.
struct parts_seen {
    uint32_t numbers[16];
    uint32_t count;
};

static bool part_is_new(struct parts_seen *seen, uint32_t part)
{
    for (uint32_t i = 0; i < seen->count; i++)
        if (seen->numbers[i] == part)
            return false;
    if (seen->count < array_count(seen->numbers))
        seen->numbers[seen->count++] = part;
    return true;
}

struct ray_state {
    const struct drawing *drawing;
    struct shade_cache *cache;
    struct layers layers;
    struct parts_seen seen;
    float limit;      // surfaces behind it are hidden
    bool shown;       // something was
    struct span near; // enter_* of the nearest surface shown
};

// False when nothing behind this surface can show.
static bool meet_surface(struct ray_state *r, float depth, uint32_t leaf, uint32_t face,
                         bool far_side)
{
    const struct drawing *d = r->drawing;
    const struct material *m = &d->shading->materials[leaf];
    if (depth > r->limit)
        return false;
    bool shows = m->alone || (!far_side && (part_is_new(&r->seen, m->part) || m->alpha == 255));
    if (!shows)
        return true;
    if (!r->shown)
        r->near = (struct span){.enter = depth, .enter_leaf = leaf, .enter_face = face};
    r->shown = true;
    struct layers *l = &r->layers;
    l->colours[l->count++] = shade_cached(r->cache, d->shader, d->body, &d->light, leaf, face);
    l->through *= 1 - (float)m->alpha / 255;
    return l->through > FAINTEST && l->count < LAYERS;
}

// As a frame buffer of 8 bits mixes: both shares are rounded.
static uint8_t over(uint8_t front, uint8_t alpha, uint8_t behind)
{
    uint32_t v = (front * alpha + 127u) / 255 + (behind * (255u - alpha) + 127u) / 255;
    return (uint8_t)(v < 255 ? v : 255);
}

static void finish_ray(const struct ray_state *r, size_t pixel)
{
    struct picture *p = r->drawing->picture;
    if (!r->shown)
        return;
    uint8_t *rgb = p->rgb + 3 * pixel;
    for (uint32_t i = r->layers.count; i-- > 0;) {
        struct rgba c = r->layers.colours[i];
        rgb[0] = over(c.r, c.a, rgb[0]);
        rgb[1] = over(c.g, c.a, rgb[1]);
        rgb[2] = over(c.b, c.a, rgb[2]);
    }
    p->depth[pixel] = r->near.enter;
    if (r->drawing->record) {
        p->surface.leaf[pixel] = r->near.enter_leaf;
        p->surface.face[pixel] = r->near.enter_face;
    }
}

static void blend_block(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    const struct drawing *d = context;
    struct shade_cache cache;
    shade_cache_clear(&cache);
    struct ray_state r = {.drawing = d, .cache = &cache};
    uint32_t i = 0;
    for (int y = block->y0; y < block->y1; y++) {
        for (int x = block->x0; x < block->x1; x++, i++) {
            size_t pixel = (size_t)y * (size_t)d->picture->width + (size_t)x;
            r.limit = d->picture->depth[pixel] + d->tolerance;
            r.layers.count = r.seen.count = 0;
            r.layers.through = 1;
            r.shown = false;
            bool more = true;
            for (uint32_t k = block->first[i]; more && k < block->first[i + 1]; k++) {
                const struct span *s = &block->spans[k];
                more = meet_surface(&r, s->enter, s->enter_leaf, s->enter_face, false) &&
                       s->leave_leaf != SURFACE_NONE &&
                       meet_surface(&r, s->leave, s->leave_leaf, s->leave_face, true);
            }
            finish_ray(&r, pixel);
        }
    }
}

void picture_draw(struct picture *p, struct cpu_device *device, const struct shader *shader,
                  const struct rays *rays, const struct render_settings *settings,
                  struct render_stats *stats)
{
    *stats = (struct render_stats){0};
    reserve(p, rays->width, rays->height);
    const struct model *model = shader->model;
    bool begun = model->body_count && shader->bodies[0].opaque &&
                 model->bodies[0].kind == BODY_MAIN; // it brings the background
    if (!begun)
        parallel_for(((uint32_t)p->height + ROWS - 1) / ROWS, settings->threads, clear_rows,
                     &(struct drawing){.picture = p, .shader = shader});
    const struct canvas canvas = {p->width, p->height, p->rgb, p->depth};
    if (p->overlay && !begun)
        overlay_draw_among(p->overlay, rays, &canvas);
    for (uint32_t b = 0; b < model->body_count; b++) {
        const struct body *body = &model->bodies[b];
        bool main = body->kind == BODY_MAIN;
        struct drawing d = {.picture = p,
                            .shader = shader,
                            .shading = &shader->bodies[b],
                            .body = b,
                            .light = light_of(rays),
                            .surface = main ? &p->surface : &p->scratch,
                            .record = main,
                            .first = begun && b == 0,
                            .tolerance =
                                (float)fmax(settings->epsilon, ROUNDING * fabs(rays->reference))};
        struct render_stats one = {0};
        if (d.shading->opaque) {
            cpu_first_surface(device, body, rays, settings, d.surface, shade_rect, &d, &one);
        } else {
            cpu_spans(device, body, rays, settings, blend_block, &d, &one);
        }
        render_stats_add(stats, &one);
        if (p->overlay && d.first) // the body is opaque and hides afterwards what is behind it
            overlay_draw_among(p->overlay, rays, &canvas);
    }
    outlines_draw(&canvas, shader, rays);
    if (p->overlay)
        overlay_draw_over(p->overlay, rays, &canvas);
}
