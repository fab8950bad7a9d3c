// shade.c - from surfaces to colours: materials, OpenSCAD's light, transparency.
#include "render/shade.h"

#include "base/mem.h"
#include "render/device.h"

#include <stdlib.h>
#include <string.h>

// OpenSCAD's colours for bodies that are shown beside the model.
static const float background_colour[4] = {180 / 255.0f, 180 / 255.0f, 180 / 255.0f, 128 / 255.0f};
static const float highlight_colour[4] = {1, 81 / 255.0f, 81 / 255.0f, 128 / 255.0f};

#define AMBIENT 0.2

// Numbers the members of the outermost union, and marks those that are a single leaf.
static void find_parts(struct body_shading *out, const struct expr *e)
{
    uint32_t *part = mem_alloc((e->node_count + 1) * sizeof *part);
    for (uint32_t n = e->node_count; n-- > 0;) { // parents come after their children
        const struct expr_node *node = &e->nodes[n];
        bool outermost = node->parent == EXPR_NONE ||
                         (node->parent == e->root && e->nodes[e->root].op == EXPR_UNION);
        part[n] = outermost ? out->part_count++ : part[node->parent];
        if (node->op == EXPR_LEAF) {
            out->materials[node->leaf].part = part[n];
            out->materials[node->leaf].alone = outermost;
        }
    }
    free(part);
}

// What a leaf without a colour of its own has.
static struct rgb stock_colour(const struct model *m, const struct leaf *leaf,
                               const struct scheme *scheme)
{
    if (m->flat)
        return scheme->flat;
    if (m->mode == MODEL_RENDER && !m->single)
        return leaf->subtracted ? scheme->mesh_back : scheme->mesh_front;
    return leaf->subtracted ? scheme->back : scheme->front;
}

static struct material material_of(const struct model *m, const struct leaf *leaf,
                                   enum body_kind kind, const struct scheme *scheme)
{
    struct rgb stock = stock_colour(m, leaf, scheme);
    float c[4] = {(float)stock.r / 255, (float)stock.g / 255, (float)stock.b / 255, 1};
    if (kind == BODY_BACKGROUND)
        memcpy(c, background_colour, sizeof c);
    bool highlighted = kind == BODY_HIGHLIGHT || leaf->highlighted;
    if (highlighted)
        memcpy(c, highlight_colour, sizeof c);
    for (int i = 0; i < 4 && !highlighted; i++)
        if (leaf->colour[i] >= 0)
            c[i] = leaf->colour[i];
    // halves go to the even number, as graphics cards do it: 0.3 is 76
    uint8_t alpha = c[3] < 1 ? (uint8_t)lrintf(c[3] * 255) : 255;
    return (struct material){
        .r = c[0], .g = c[1], .b = c[2], .alpha = alpha, .unlit = m->flat != NULL};
}

void shader_init(struct shader *out, const struct model *m, const struct scheme *scheme)
{
    *out = (struct shader){.model = m, .scheme = scheme};
    out->bodies = mem_zalloc((m->body_count + 1) * sizeof *out->bodies);
    for (uint32_t b = 0; b < m->body_count; b++) {
        const struct body *body = &m->bodies[b];
        struct body_shading *shading = &out->bodies[b];
        shading->materials = mem_alloc((body->leaf_count + 1) * sizeof *shading->materials);
        shading->opaque = true;
        for (uint32_t i = 0; i < body->leaf_count; i++) {
            shading->materials[i] = material_of(m, &body->leaves[i], body->kind, scheme);
            if (shading->materials[i].alpha < 255 && body->expr.leaf_node[i] != EXPR_NONE)
                shading->opaque = false;
        }
        find_parts(shading, &body->expr);
    }
    normals_init(&out->normals, m);
    if (m->mode == MODEL_THROWN_TOGETHER)
        facing_init(&out->facing, m);
}

void shader_free(struct shader *s)
{
    if (s->bodies)
        for (uint32_t b = 0; b < s->model->body_count; b++)
            free(s->bodies[b].materials);
    free(s->bodies);
    normals_free(&s->normals);
    facing_free(&s->facing);
    *s = (struct shader){0};
}

struct light light_of(const struct rays *rays)
{
    struct vec3 right = vec3_normalized(rays->step_x), down = vec3_normalized(rays->step_y);
    struct vec3 ahead = vec3_cross(down, right);
    if (vec3_dot(ahead, rays->forward) < 0)
        ahead = vec3_scale(ahead, -1);
    // From the upper left behind the viewer: (-1, 1, 1) in the viewer's right, up and backwards.
    struct vec3 sum = vec3_add(vec3_add(right, down), ahead);
    return (struct light){vec3_normalized(vec3_scale(sum, -1)), ahead, viewpoint_of(rays)};
}

static uint8_t to_byte(double v)
{
    return v < 1 ? (uint8_t)(255 * v + 0.5) : 255;
}

// Of shapes thrown together, what turns its back is told by its colour.
static bool shows_back(const struct shader *s, uint32_t body, const struct light *light,
                       uint32_t leaf, uint32_t face)
{
    const struct body *b = &s->model->bodies[body];
    if (s->model->mode != MODEL_THROWN_TOGETHER || b->kind != BODY_MAIN)
        return false;
    return face == SURFACE_CAP || facing_back(&s->facing, b, leaf, face, &light->from);
}

struct rgba shade_edge(const struct shader *s, uint32_t body, const struct light *light,
                       uint32_t leaf, uint32_t face, double cover)
{
    const struct leaf *placed = &s->model->bodies[body].leaves[leaf];
    const struct material *m = &s->bodies[body].materials[leaf];
    struct vec3 normal =
        face == SURFACE_CAP ? light->view_axis : normals_find(&s->normals, placed, face);
    double factor = m->unlit ? 1 : AMBIENT + fabs(vec3_dot(normal, light->direction));
    double colour[] = {(double)m->r, (double)m->g, (double)m->b}, alpha = m->alpha / 255.0;
    if (shows_back(s, body, light, leaf, face)) {
        colour[0] = colour[2] = alpha = 1;
        colour[1] = 0;
    }
    uint8_t mixed[3];
    for (int i = 0; i < 3; i++)
        mixed[i] = to_byte(colour[i] * factor * (1 - cover) + (colour[i] + 1) / 2 * cover);
    return (struct rgba){mixed[0], mixed[1], mixed[2], to_byte(alpha * (1 - cover) + cover)};
}

struct rgba shade_face(const struct shader *s, uint32_t body, const struct light *light,
                       uint32_t leaf, uint32_t face)
{
    return shade_edge(s, body, light, leaf, face, 0);
}

void shade_cache_clear(struct shade_cache *c)
{
    memset(c, 0xff, sizeof *c); // a leaf of all ones is SURFACE_NONE, which nobody looks up
}
