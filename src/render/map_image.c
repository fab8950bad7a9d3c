// map_image.c - maps as pixels of files: depths, normals, and colours that stand for leaves.
#include "render/map_image.h"

#include "base/mem.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct depth_range map_depth_range(const struct map *m, const struct rays *rays)
{
    struct depth_range r = {INFINITY, -INFINITY};
    for (size_t i = 0; i < map_pixels(m); i++) {
        if (map_is_empty_at(m, i))
            continue;
        double depth = (double)m->surface.depth[i] + rays->reference;
        r.nearest = fmin(r.nearest, depth);
        r.farthest = fmax(r.farthest, depth);
    }
    return r;
}

void map_depths(const struct map *m, const struct rays *rays, float *out)
{
    for (size_t i = 0; i < map_pixels(m); i++)
        out[i] = map_is_empty_at(m, i) ? INFINITY
                                       : (float)((double)m->surface.depth[i] + rays->reference);
}

void map_greys(const struct map *m, const struct rays *rays, struct depth_range range,
               uint16_t *out)
{
    double extent = range.farthest - range.nearest;
    for (size_t i = 0; i < map_pixels(m); i++) {
        double behind = (double)m->surface.depth[i] + rays->reference - range.nearest;
        double share = extent > 0 ? behind / extent : 0;
        out[i] = map_is_empty_at(m, i) ? 0 : (uint16_t)(65535.5 - share * 65534);
    }
}

void map_normal_colours(const float (*normals)[3], size_t pixels, uint8_t *rgb)
{
    for (size_t i = 0; i < pixels; i++) {
        const float *n = normals[i];
        bool nothing = n[0] == 0 && n[1] == 0 && n[2] == 0;
        for (size_t k = 0; k < 3; k++)
            rgb[3 * i + k] = nothing ? 0 : (uint8_t)((n[k] + 1) * 127.5f + 0.5f);
    }
}

// Where the leaves of each body start when all are counted through. The caller frees it.
static uint64_t *first_numbers(const struct model *model)
{
    uint64_t *first = mem_alloc((model->body_count + 1) * sizeof *first), sum = 0;
    for (uint32_t b = 0; b < model->body_count; b++) {
        first[b] = sum;
        sum += model->bodies[b].leaf_count;
    }
    return first;
}

// Steps of the golden ratio through the numbers of 24 bits: neighbours look different and none is
// met twice.
static uint32_t id_colour(uint64_t number)
{
    return (uint32_t)((number % 0xffffff + 1) * 0x9e3779) & 0xffffff;
}

void map_ids(const struct map *m, const struct model *model, uint8_t *rgb)
{
    uint64_t *first = first_numbers(model);
    for (size_t i = 0; i < map_pixels(m); i++, rgb += 3) {
        uint32_t c = 0;
        if (!map_is_empty_at(m, i))
            c = id_colour(first[m->body[i]] + m->surface.leaf[i]);
        rgb[0] = (uint8_t)(c >> 16);
        rgb[1] = (uint8_t)(c >> 8);
        rgb[2] = (uint8_t)c;
    }
    free(first);
}

static void print_leaf(FILE *out, const struct body *body, uint32_t leaf, uint64_t number)
{
    struct place p = body->leaves[leaf].place;
    fprintf(out, "#%06x %s:%u:%u%s\n", id_colour(number), p.file ? p.file : "-", p.line, p.column,
            body->kind == BODY_HIGHLIGHT ? " highlight" : "");
}

char *map_legend(const struct map *m, const struct model *model)
{
    uint64_t *first = first_numbers(model), total = 0;
    for (uint32_t b = 0; b < model->body_count; b++)
        total += model->bodies[b].leaf_count;
    bool *shows = mem_zalloc((total + 1) * sizeof *shows);
    for (size_t i = 0; i < map_pixels(m); i++)
        if (!map_is_empty_at(m, i))
            shows[first[m->body[i]] + m->surface.leaf[i]] = true;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        for (uint32_t b = 0; b < model->body_count; b++)
            for (uint32_t i = 0; i < model->bodies[b].leaf_count; i++)
                if (shows[first[b] + i])
                    print_leaf(out, &model->bodies[b], i, first[b] + i);
        fclose(out);
    }
    free(shows);
    free(first);
    return text ? text : mem_strdup("");
}
