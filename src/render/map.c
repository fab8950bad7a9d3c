// map.c - what each pixel shows, as numbers: depth, normal and leaf of its nearest surface.
#include "render/map.h"

#include "base/mem.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

static void reserve(struct surface_image *s, int width, int height)
{
    if (s->depth && s->width == width && s->height == height)
        return;
    size_t n = (size_t)width * (size_t)height;
    s->width = width;
    s->height = height;
    s->depth = mem_realloc(s->depth, n * sizeof(float));
    s->leaf = mem_realloc(s->leaf, n * sizeof(uint32_t));
    s->face = mem_realloc(s->face, n * sizeof(uint32_t));
}

static void release(struct surface_image *s)
{
    free(s->depth);
    free(s->leaf);
    free(s->face);
}

void map_free(struct map *m)
{
    release(&m->surface);
    release(&m->scratch);
    free(m->body);
    *m = (struct map){0};
}

struct layer {
    struct map *map;
    uint32_t body;
};

// Takes over what is nearer than all before it.
static void merge_rect(void *context, struct pixel_rect rect, bool nothing)
{
    const struct layer *l = context;
    struct surface_image *to = &l->map->surface;
    const struct surface_image *from = &l->map->scratch;
    for (int y = rect.y0; y < rect.y1 && !nothing; y++) {
        size_t row = (size_t)y * (size_t)to->width;
        for (size_t i = row + (size_t)rect.x0; i < row + (size_t)rect.x1; i++) {
            if (from->leaf[i] == SURFACE_NONE || from->depth[i] >= to->depth[i])
                continue;
            to->depth[i] = from->depth[i];
            to->leaf[i] = from->leaf[i];
            to->face[i] = from->face[i];
            l->map->body[i] = l->body;
        }
    }
}

void map_draw(struct map *m, struct device *device, const struct model *model,
              const struct rays *rays, const struct render_settings *settings,
              struct render_stats *stats)
{
    *stats = (struct render_stats){0};
    bool resized = m->surface.width != rays->width || m->surface.height != rays->height;
    reserve(&m->surface, rays->width, rays->height);
    size_t n = map_pixels(m);
    if (resized || !m->body)
        m->body = mem_realloc(m->body, n * sizeof *m->body);
    memset(m->body, 0, n * sizeof *m->body);
    if (!model->body_count)
        for (size_t i = 0; i < n; i++) {
            m->surface.leaf[i] = SURFACE_NONE;
            m->surface.depth[i] = INFINITY;
        }
    for (uint32_t b = 0; b < model->body_count; b++) {
        struct layer l = {m, b};
        struct render_stats one = {0};
        if (m->model_only && !model->bodies[b].part)
            continue;
        if (b)
            reserve(&m->scratch, rays->width, rays->height);
        device_first_surface(device, &model->bodies[b], rays, settings,
                             b ? &m->scratch : &m->surface, b ? merge_rect : NULL, &l, &one);
        render_stats_add(stats, &one);
    }
}

// Axes of the viewer in the world, and what is needed to turn normals into them.
struct normals_job {
    const struct map *map;
    const struct shader *shader;
    const struct rays *rays;
    struct vec3 right, up, back;
    float (*out)[3];
};

static void normals_row(void *context, uint32_t y, uint32_t worker)
{
    (void)worker;
    const struct normals_job *j = context;
    const struct surface_image *s = &j->map->surface;
    const uint32_t *body = j->map->body;
    size_t row = (size_t)y * (size_t)s->width;
    struct vec3 normal = {0};
    for (size_t i = row; i < row + (size_t)s->width; i++) {
        float *out = j->out[i];
        out[0] = out[1] = out[2] = 0;
        if (s->leaf[i] == SURFACE_NONE)
            continue;
        struct vec3 ray = rays_direction(j->rays, (double)(i - row), y);
        bool known = i > row && s->leaf[i - 1] == s->leaf[i] && s->face[i - 1] == s->face[i] &&
                     body[i - 1] == body[i];
        if (!known)
            normal = s->face[i] == SURFACE_CAP
                         ? j->back
                         : normals_find(&j->shader->normals,
                                        &j->shader->model->bodies[body[i]].leaves[s->leaf[i]],
                                        s->face[i]);
        double side = vec3_dot(normal, ray) > 0 ? -1 : 1; // inside out where material was cut away
        out[0] = (float)(side * vec3_dot(normal, j->right));
        out[1] = (float)(side * vec3_dot(normal, j->up));
        out[2] = (float)(side * vec3_dot(normal, j->back));
    }
}

void map_normals(const struct map *m, const struct shader *shader, const struct rays *rays,
                 uint32_t threads, float (*out)[3])
{
    struct normals_job j = {
        .map = m,
        .shader = shader,
        .rays = rays,
        .right = vec3_normalized(rays->step_x),
        .up = vec3_scale(vec3_normalized(rays->step_y), -1),
        .back = vec3_scale(light_of(rays).view_axis, -1),
        .out = out,
    };
    parallel_for((uint32_t)m->surface.height, threads, normals_row, &j);
}
