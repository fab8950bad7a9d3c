// blend.c - surfaces mixed with what a picture shows already.
#include "render/blend.h"

#include "base/mem.h"
#include "render/edges.h"

#include <stdlib.h>

enum { LAYERS = 1024 };       // of transparent surfaces that a ray shows at most
#define FAINTEST (1.0f / 512) // what shows through less than this is not seen in 8 bits

// As a frame buffer of 8 bits mixes: both shares are rounded.
static uint8_t over(uint8_t front, uint8_t alpha, uint8_t behind)
{
    uint32_t v = (front * alpha + 127u) / 255 + (behind * (255u - alpha) + 127u) / 255;
    return (uint8_t)(v < 255 ? v : 255);
}

static void mix(uint8_t rgb[3], struct rgba c)
{
    rgb[0] = over(c.r, c.a, rgb[0]);
    rgb[1] = over(c.g, c.a, rgb[1]);
    rgb[2] = over(c.b, c.a, rgb[2]);
}

// ---------------------------------------------------------------- in the order of the file

// A face of a leaf of what is drawn.
struct side {
    bool back;
    uint32_t leaf, face;
    float depth;
};

static uint32_t leaf_of_body(const struct drawing *d, uint32_t leaf)
{
    return d->layer ? d->layer->leaf_of[leaf] : leaf;
}

// Makes the side what shows in a pixel, unless another one lies in front of it.
static bool take_pixel(const struct drawing *d, size_t pixel, struct side side)
{
    struct picture *p = d->picture;
    if (side.depth > p->depth[pixel] + d->tolerance)
        return false;
    uint32_t leaf = leaf_of_body(d, side.leaf);
    p->depth[pixel] = side.depth;
    if (d->record) {
        p->surface.leaf[pixel] = leaf;
        p->surface.face[pixel] = side.face;
    }
    if (d->twin_of)
        p->owners[pixel] = (struct owner){d->twin_of[leaf], side.face, side.back};
    return true;
}

struct rgba blend_colour(const struct drawing *d, struct shade_cache *cache, size_t pixel,
                         uint32_t leaf, uint32_t face)
{
    const struct shader *s = d->shader;
    if (s->edges && face != SURFACE_CAP) {
        size_t width = (size_t)d->picture->width;
        double cover = edges_cover(s->edges, &s->model->bodies[d->body].leaves[leaf], face, d->rays,
                                   (int)(pixel % width), (int)(pixel / width));
        if (cover > 0)
            return shade_edge(s, d->body, &d->light, leaf, face, cover);
    }
    return shade_cached(cache, s, d->body, &d->light, leaf, face);
}

static void mix_face(const struct drawing *d, struct shade_cache *cache, size_t pixel,
                     uint32_t leaf, uint32_t face)
{
    mix(d->picture->rgb + 3 * pixel, blend_colour(d, cache, pixel, leaf_of_body(d, leaf), face));
}

void blend_surface(const struct drawing *d, struct shade_cache *cache, size_t pixel)
{
    const struct surface_image *s = d->surface;
    uint32_t leaf = s->leaf[pixel], face = s->face[pixel];
    if (leaf == SURFACE_NONE)
        return;
    const struct body *whole = &d->shader->model->bodies[d->body];
    bool back = whole->leaves[leaf_of_body(d, leaf)].subtracted;
    if (take_pixel(d, pixel, (struct side){back, leaf, face, s->depth[pixel]}) &&
        !(d->layer && d->layer->repeats))
        mix_face(d, cache, pixel, leaf, face);
}

// The first member with this twin, or the one that would follow it.
static uint32_t find_member(const struct layer *l, uint32_t twin)
{
    uint32_t from = 0, to = l->body.leaf_count;
    while (from < to) {
        uint32_t middle = from + (to - from) / 2;
        if (l->members[middle].twin < twin)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

void blend_repeated(const struct drawing *d)
{
    const struct layer *l = d->layer;
    size_t n = (size_t)d->picture->width * (size_t)d->picture->height;
    struct shade_cache cache;
    uint32_t twin = TWIN_NONE, at = l->body.leaf_count;
    shade_cache_clear(&cache);
    for (size_t i = 0; i < n; i++) {
        struct owner owner = d->picture->owners[i];
        if (owner.twin == TWIN_NONE)
            continue;
        if (owner.twin != twin)
            at = find_member(l, twin = owner.twin);
        for (uint32_t k = at; k < l->body.leaf_count && l->members[k].twin == twin; k++)
            if (owner.back || !l->members[k].cut)
                mix_face(d, &cache, i, l->members[k].leaf, owner.face);
    }
}

static int by_turn(const void *a, const void *b)
{
    const struct side *l = a, *r = b;
    if (l->back != r->back)
        return r->back - l->back;
    return (l->face > r->face) - (l->face < r->face);
}

static int by_face(const void *a, const void *b)
{
    const struct side *l = a, *r = b;
    if (l->leaf != r->leaf)
        return (l->leaf > r->leaf) - (l->leaf < r->leaf);
    return (l->face > r->face) - (l->face < r->face);
}

void blend_both_sides(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    const struct drawing *d = context;
    struct shade_cache cache;
    struct side *sides = NULL;
    uint32_t room = 0, i = 0;
    shade_cache_clear(&cache);
    for (int y = block->y0; y < block->y1; y++) {
        for (int x = block->x0; x < block->x1; x++, i++) {
            uint32_t count = 0;
            array_reserve(&sides, &room, 2 * (size_t)(block->first[i + 1] - block->first[i]));
            for (uint32_t k = block->first[i]; k < block->first[i + 1]; k++) {
                const struct span *s = &block->spans[k];
                if (s->leave_leaf != SURFACE_NONE)
                    sides[count++] = (struct side){true, s->leave_leaf, s->leave_face, s->leave};
                if (s->enter_face != SURFACE_CAP || !d->layer->in_turn)
                    sides[count++] = (struct side){false, s->enter_leaf, s->enter_face, s->enter};
            }
            if (count > (d->layer->in_turn ? 1 : 2))
                qsort(sides, count, sizeof *sides, d->layer->in_turn ? by_face : by_turn);
            size_t pixel = (size_t)y * (size_t)d->picture->width + (size_t)x;
            for (uint32_t k = 0; k < count; k++)
                if (take_pixel(d, pixel, sides[k]))
                    mix_face(d, &cache, pixel, sides[k].leaf, sides[k].face);
        }
    }
    free(sides);
}

// ---------------------------------------------------------------- in the order of depth

// Colours met along a ray, from the front.
struct colours_met {
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
    size_t pixel;
    struct colours_met layers;
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
    struct colours_met *l = &r->layers;
    l->colours[l->count++] = blend_colour(d, r->cache, r->pixel, leaf, face);
    l->through *= 1 - (float)m->alpha / 255;
    return l->through > FAINTEST && l->count < LAYERS;
}

static void finish_ray(const struct ray_state *r)
{
    size_t pixel = r->pixel;
    struct picture *p = r->drawing->picture;
    if (!r->shown)
        return;
    uint8_t *rgb = p->rgb + 3 * pixel;
    for (uint32_t i = r->layers.count; i-- > 0;)
        mix(rgb, r->layers.colours[i]);
    p->depth[pixel] = r->near.enter;
    if (r->drawing->record) {
        p->surface.leaf[pixel] = r->near.enter_leaf;
        p->surface.face[pixel] = r->near.enter_face;
    }
}

void blend_sorted(void *context, uint32_t worker, const struct span_block *block)
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
            r.pixel = pixel;
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
            finish_ray(&r);
        }
    }
}
