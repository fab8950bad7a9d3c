// wires.c - the edges and vertices of what a boolean leaves, as lines and points.
//
// The picture is taken in bands of rows, with all solid intervals of each ray. Each end of one lies
// in a plane, whose weight (the inverse depth, in orthographic views the depth) is an affine
// function of the pixel.
#include "render/wires.h"

#include "base/mem.h"
#include "render/wire_rows.h"

#include <stdlib.h>
#include <string.h>

enum { BAND = 64 }; // rows

struct pixel {
    const struct span *spans; // of the rays
    uint32_t span_count;
    struct span *block; // of the first pixel of a block: where its spans are
};

struct band {
    struct pixel *pixels; // of its rows and the one below
    int first, width;
};

static void keep_spans(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    const struct band *b = context;
    uint32_t n = (uint32_t)((block->x1 - block->x0) * (block->y1 - block->y0));
    uint32_t first = block->first[0], count = block->first[n] - first, i = 0;
    struct span *copy = mem_alloc((count + 1) * sizeof *copy);
    if (count)
        memcpy(copy, block->spans + first, count * sizeof *copy);
    for (int y = block->y0; y < block->y1; y++)
        for (int x = block->x0; x < block->x1; x++, i++)
            b->pixels[(size_t)y * (size_t)b->width + (size_t)x] =
                (struct pixel){copy + (block->first[i] - first),
                               block->first[i + 1] - block->first[i], i ? NULL : copy};
}

static void fill_row(const struct wires *w, const struct band *b, struct row *row, int y)
{
    const struct pixel *p = b->pixels + (size_t)(y - b->first) * (size_t)b->width;
    row->first[0] = 0;
    for (int x = 0; x < b->width; x++)
        wire_row_add(w, row, x, y, p[x].spans, p[x].span_count);
}

static void draw_band(const struct wires *w, const struct band *b, int rows, bool points)
{
    struct row two[2] = {{0}};
    for (int i = 0; i < 2; i++)
        two[i].first = mem_alloc(((size_t)b->width + 1) * sizeof *two[i].first);
    fill_row(w, b, &two[0], b->first);
    for (int y = b->first; y < b->first + rows; y++) {
        bool below = y + 1 < w->rays->height;
        if (below)
            fill_row(w, b, &two[1], y + 1);
        for (int x = 0; x < b->width; x++) {
            struct list here = wire_row_at(&two[0], x);
            bool beside = x + 1 < b->width;
            if (points && below && beside)
                wire_points_draw(w, two, x, y);
            if (!points && beside)
                wire_edges_draw(w, here, wire_row_at(&two[0], x + 1), x, y, x + 1, y);
            if (!points && below)
                wire_edges_draw(w, here, wire_row_at(&two[1], x), x, y, x, y + 1);
        }
        struct row swap = two[0];
        two[0] = two[1];
        two[1] = swap;
    }
    for (int i = 0; i < 2; i++) {
        free(two[i].first);
        free(two[i].surfaces);
    }
}

void wires_draw(const struct canvas *c, struct device *device, const struct model *m,
                const struct scheme *scheme, const struct facets *facets, const struct rays *rays,
                const struct render_settings *settings)
{
    if (!m->body_count)
        return;
    size_t room = (size_t)rays->width * (BAND + 1);
    struct wires w = {.canvas = c,
                      .body = &m->bodies[0],
                      .scheme = scheme,
                      .facets = facets,
                      .bent = bent_new(&m->bodies[0], facets),
                      .rays = rays,
                      .tolerance = fmax(settings->epsilon, 1e-6 * fabs(rays->reference))};
    struct band b = {.pixels = mem_zalloc(room * sizeof *b.pixels), .width = rays->width};
    // Points lie over all edges.
    for (int points = 0; points < 2; points++)
        for (b.first = 0; b.first < rays->height; b.first += BAND) {
            struct render_stats stats;
            struct rays part = *rays;
            int rows = rays->height - b.first < BAND ? rays->height - b.first : BAND;
            part.height = b.first + rows < rays->height ? rows + 1 : rows;
            struct vec3 down = vec3_scale(rays->step_y, b.first);
            *(rays->orthographic ? &part.origin : &part.forward) =
                vec3_add(rays->orthographic ? rays->origin : rays->forward, down);
            device_spans(device, w.body, &part, settings, keep_spans, &b, &stats);
            draw_band(&w, &b, rows, points);
            for (size_t i = 0; i < room; i++)
                free(b.pixels[i].block);
            memset(b.pixels, 0, room * sizeof *b.pixels);
        }
    free(b.pixels);
    bent_delete(w.bent);
}
