// subject.c - what is under test.
#include "subject.h"

#include "base/hash.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "render/choose.h"

#include <stdlib.h>
#include <string.h>

// From the last token back: each operator hands its side to its operands, last operand on top.
static void mark_subtracted(struct body *b, const struct random_scene *scene)
{
    bool *stack = mem_zalloc(scene->token_count + 1);
    uint32_t top = 1;
    for (uint32_t i = scene->token_count; i-- > 0;) {
        struct expr_token token = scene->tokens[i];
        bool subtracted = stack[--top];
        if (token.op == EXPR_LEAF)
            b->leaves[token.arg].subtracted = subtracted;
        else
            for (uint32_t k = 0; k < token.arg; k++)
                stack[top++] = subtracted != (token.op == EXPR_DIFFERENCE && k > 0);
    }
    free(stack);
}

static void make_leaves(struct subject *s, const struct random_scene *scene)
{
    for (uint32_t i = 0; i < scene->leaf_count; i++) {
        struct leaf *leaf = &s->body.leaves[i];
        leaf->solid = &s->solids[scene->leaves[i].mesh];
        leaf->to_world = scene->leaves[i].to_world;
        affine_inverse(&leaf->to_world, &leaf->to_local);
        leaf->mirrored = affine_determinant(&leaf->to_world) < 0;
        leaf->box = BOX_EMPTY;
        for (uint32_t k = 0; k < leaf->solid->mesh.vertex_count; k++)
            leaf->box = box_of_point(leaf->box,
                                     affine_point(&leaf->to_world, leaf->solid->mesh.vertices[k]));
    }
}

// A device may know a solid by it, from tree to tree.
static uint64_t content_hash(const struct random_mesh *m)
{
    uint64_t hash =
        hash_bytes(m->convex, m->mesh.vertices, m->mesh.vertex_count * sizeof *m->mesh.vertices);
    return hash_bytes(hash, m->mesh.triangles, m->mesh.triangle_count * sizeof *m->mesh.triangles);
}

void subject_make(struct subject *out, const struct random_scene *scene)
{
    uint32_t n = scene->leaf_count;
    *out = (struct subject){.solid_count = scene->mesh_count};
    struct body *b = &out->body;
    out->solids = mem_zalloc(scene->mesh_count * sizeof *out->solids);
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        struct mesh copy;
        shape_copy(&copy, &scene->meshes[i].mesh);
        solid_from_mesh(&out->solids[i], &copy, scene->meshes[i].convex,
                        content_hash(&scene->meshes[i]));
    }
    b->leaf_count = n;
    b->leaves = mem_zalloc(n * sizeof *b->leaves);
    b->roi = mem_alloc((n + 1) * sizeof *b->roi);
    make_leaves(out, scene);
    mark_subtracted(b, scene);

    struct box *boxes = mem_alloc((n + 1) * sizeof *boxes);
    bool *flags = mem_alloc(n + 1);
    struct expr whole;
    for (uint32_t i = 0; i < n; i++)
        boxes[i] = b->leaves[i].box;
    expr_build(&whole, scene->tokens, scene->token_count, n);
    roi_build(b->roi, &whole, boxes);
    for (uint32_t i = 0; i < n; i++)
        flags[i] = !box_is_empty(b->roi[i]);
    expr_without(&b->expr, &whole, flags);
    expr_free(&whole);
    roi_build(b->roi, &b->expr, boxes);
    for (uint32_t i = 0; i < n; i++)
        flags[i] = b->leaves[i].solid->convex;
    sharing_build(&b->sharing, &b->expr, flags, true);
    b->table = discovery_new(&b->expr, &b->sharing);
    free(boxes);
    free(flags);
}

void subject_free(struct subject *s)
{
    discovery_delete(s->body.table);
    sharing_free(&s->body.sharing);
    expr_free(&s->body.expr);
    free(s->body.leaves);
    free(s->body.roi);
    for (uint32_t i = 0; i < s->solid_count; i++)
        solid_free(&s->solids[i]);
    free(s->solids);
    *s = (struct subject){0};
}

struct oracle_leaf *subject_leaves(const struct body *body)
{
    struct oracle_leaf *leaves = mem_alloc((body->leaf_count + 1) * sizeof *leaves);
    for (uint32_t i = 0; i < body->leaf_count; i++)
        leaves[i] = (struct oracle_leaf){&body->leaves[i].solid->mesh, body->leaves[i].to_world};
    return leaves;
}

struct expr_token *subject_tokens(const struct expr *e, size_t *count)
{
    struct expr_token *tokens = mem_alloc((2 * (size_t)e->node_count + 1) * sizeof *tokens);
    *count = e->node_count ? expr_postfix(tokens, e, e->node_count - 1, NULL) : 0;
    return tokens;
}

struct device *device_under_test(bool gl)
{
    struct error why;
    struct device *d = device_choose(gl ? DEVICE_GL : DEVICE_CPU, NULL, &why);
    if (d)
        return d;
    printf("skipped: %s\n", why.text);
    exit(77);
}

void crew_init(struct crew *out, uint32_t threads, bool gl)
{
    out->count = parallel_workers(threads);
    out->devices = mem_alloc(out->count * sizeof(struct device *));
    for (uint32_t i = 0; i < out->count; i++)
        out->devices[i] = device_under_test(gl);
}

void crew_free(struct crew *c)
{
    for (uint32_t i = 0; i < c->count; i++)
        device_delete(c->devices[i]);
    free(c->devices);
    *c = (struct crew){0};
}

struct collector {
    struct picture *picture;
    int width;
};

static void collect(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    struct collector *c = context;
    uint32_t i = 0;
    for (int y = block->y0; y < block->y1; y++)
        for (int x = block->x0; x < block->x1; x++, i++) {
            struct pixel_spans *p = &c->picture->spans[y * c->width + x];
            p->visits++;
            p->count = block->first[i + 1] - block->first[i];
            free(p->items);
            p->items = mem_alloc((p->count + 1) * sizeof *p->items);
            for (uint32_t k = 0; k < p->count; k++)
                p->items[k] = block->spans[block->first[i] + k];
        }
}

void picture_render(struct picture *out, struct device *device, const struct body *body,
                    const struct rays *rays, const struct render_settings *settings)
{
    size_t n = (size_t)rays->width * (size_t)rays->height;
    *out = (struct picture){.image = {.width = rays->width, .height = rays->height}};
    out->image.depth = mem_zalloc(n * sizeof *out->image.depth);
    out->image.leaf = mem_zalloc(n * sizeof *out->image.leaf);
    out->image.face = mem_zalloc(n * sizeof *out->image.face);
    out->spans = mem_zalloc(n * sizeof *out->spans);
    struct collector c = {out, rays->width};
    device_first_surface(device, body, rays, settings, &out->image, NULL, NULL,
                         &out->surface_stats);
    device_spans(device, body, rays, settings, collect, &c, &out->span_stats);
    struct error why;
    if (device_failed(device, &why)) { // what there is was drawn by another one
        printf("%s\n", why.text);
        exit(1);
    }
}

void picture_free(struct picture *p)
{
    for (int i = 0; i < p->image.width * p->image.height; i++)
        free(p->spans[i].items);
    free(p->spans);
    free(p->image.depth);
    free(p->image.leaf);
    free(p->image.face);
    *p = (struct picture){0};
}

static bool pixel_equal(const struct picture *a, const struct picture *b, int i)
{
    if (a->image.leaf[i] != b->image.leaf[i] || a->spans[i].count != b->spans[i].count)
        return false;
    if (a->image.leaf[i] != SURFACE_NONE &&
        (memcmp(&a->image.depth[i], &b->image.depth[i], sizeof(float)) != 0 ||
         a->image.face[i] != b->image.face[i]))
        return false;
    return memcmp(a->spans[i].items, b->spans[i].items, a->spans[i].count * sizeof(struct span)) ==
           0;
}

bool picture_equal(const struct picture *a, const struct picture *b, int *x, int *y)
{
    for (int i = 0; i < a->image.width * a->image.height; i++)
        if (!pixel_equal(a, b, i)) {
            *x = i % a->image.width;
            *y = i / a->image.width;
            return false;
        }
    return true;
}
