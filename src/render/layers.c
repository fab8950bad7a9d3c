// layers.c - the order in which OpenSCAD draws bodies that can be seen through.
#include "render/layers.h"

#include "base/hash.h"
#include "base/mem.h"
#include "hcsg/products.h"
#include "render/part.h"

#include <stdlib.h>
#include <string.h>

// Of all products of one part; OpenSCAD gives up at as many nodes. A part that has more is drawn
// whole.
enum { PRODUCT_LEAVES = 100000 };

struct builder {
    bool thrown;    // together
    struct box eye; // thrown together: what meets it is drawn with its back faces
    bool around;    // the layer under construction does
    const struct body *body;
    const struct expr *e; // the body's
    const struct material *materials;
    struct box *boxes; // of the leaves, as OpenSCAD has them
    struct body_layers *out;
    uint32_t room;

    // the layer under construction
    struct leaf *leaves;
    uint32_t *leaf_of;
    uint32_t leaf_count, leaf_room, number_room;
    struct expr_token *tokens;
    uint32_t token_count, token_room;
    uint32_t members; // of its union
};

static bool is_opaque(const struct builder *b, uint32_t leaf)
{
    return b->materials[leaf].alpha == 255;
}

static void put_token(struct builder *b, enum expr_op op, uint32_t arg)
{
    array_reserve(&b->tokens, &b->token_room, (size_t)b->token_count + 1);
    b->tokens[b->token_count++] = (struct expr_token){op, arg};
}

static uint32_t copy_leaf(struct builder *b, uint32_t leaf)
{
    array_reserve(&b->leaves, &b->leaf_room, (size_t)b->leaf_count + 1);
    array_reserve(&b->leaf_of, &b->number_room, (size_t)b->leaf_count + 1);
    b->leaves[b->leaf_count] = b->body->leaves[leaf];
    b->leaf_of[b->leaf_count] = leaf;
    return b->leaf_count++;
}

// A member that is a subtree of the body's expression.
static void put_subtree(struct builder *b, uint32_t node)
{
    uint32_t first = expr_first(b->e, node);
    array_reserve(&b->tokens, &b->token_room, b->token_count + 2 * (size_t)(node - first + 1));
    struct expr_token *tokens = b->tokens + b->token_count;
    size_t count = expr_postfix(tokens, b->e, node, NULL);
    for (size_t i = 0; i < count; i++)
        if (tokens[i].op == EXPR_LEAF)
            tokens[i].arg = copy_leaf(b, tokens[i].arg);
    b->token_count += (uint32_t)count;
    b->members++;
}

static void put_product(struct builder *b, const uint32_t *leaves, struct product p)
{
    for (uint32_t i = 0; i < p.added + p.cut; i++) {
        if (i == p.added)
            put_token(b, EXPR_INTERSECTION, p.added);
        put_token(b, EXPR_LEAF, copy_leaf(b, leaves[p.first + i]));
    }
    if (p.cut)
        put_token(b, EXPR_DIFFERENCE, 1 + p.cut);
    else
        put_token(b, EXPR_INTERSECTION, p.added);
    b->members++;
}

// Ends the layer under construction, if there is one. The address of its expression must not move
// any more, so the list of layers is made anew when all are there.
static void end_layer(struct builder *b, bool see_through)
{
    if (!b->members)
        return;
    put_token(b, EXPR_UNION, b->members);
    struct body_layers *out = b->out;
    array_reserve(&out->items, &b->room, (size_t)out->count + 1);
    struct layer *layer = &out->items[out->count++];
    *layer = (struct layer){
        .body = {.kind = b->body->kind, .leaves = b->leaves, .leaf_count = b->leaf_count},
        .leaf_of = b->leaf_of,
        .see_through = see_through,
        .both_sides = see_through &&
                      (b->thrown ? b->around || b->body->kind != BODY_MAIN : b->leaf_count == 1),
        .in_turn = b->thrown};
    expr_build(&layer->body.expr, b->tokens, b->token_count, b->leaf_count);
    b->leaves = NULL;
    b->leaf_of = NULL;
    b->leaf_count = b->leaf_room = b->number_room = b->token_count = b->members = 0;
}

static bool product_is_opaque(const struct builder *b, const uint32_t *leaves, struct product p)
{
    for (uint32_t i = 0; i < p.added + p.cut; i++)
        if (!is_opaque(b, leaves[p.first + i]))
            return false;
    return true;
}

// A child of the root union with leaves that can be seen through.
static void add_part(struct builder *b, uint32_t node)
{
    struct products products;
    if (b->thrown || !products_build(&products, b->e, node, b->boxes, PRODUCT_LEAVES)) {
        end_layer(b, false);
        put_subtree(b, node);
        end_layer(b, true);
        return;
    }
    for (uint32_t i = 0; i < products.count; i++) {
        bool opaque = product_is_opaque(b, products.leaves, products.items[i]);
        if (!opaque)
            end_layer(b, false);
        put_product(b, products.leaves, products.items[i]);
        if (!opaque)
            end_layer(b, true);
    }
    products_free(&products);
}

static bool subtree_is_opaque(const struct builder *b, uint32_t node)
{
    const struct expr *e = b->e;
    for (uint32_t n = expr_first(e, node); n <= node; n++)
        if (e->nodes[n].op == EXPR_LEAF && !is_opaque(b, e->nodes[n].leaf))
            return false;
    return true;
}

static bool meets_eye(const struct builder *b, uint32_t node)
{
    const struct expr *e = b->e;
    for (uint32_t n = expr_first(e, node); n <= node; n++)
        if (e->nodes[n].op == EXPR_LEAF &&
            !box_is_empty(box_intersection(b->body->leaves[e->nodes[n].leaf].box, b->eye)))
            return true;
    return false;
}

static void find_boxes(struct builder *b)
{
    b->boxes = mem_alloc((b->body->leaf_count + 1) * sizeof *b->boxes);
    for (uint32_t i = 0; i < b->body->leaf_count; i++) {
        const struct leaf *leaf = &b->body->leaves[i];
        b->boxes[i] = leaf->box;
        if (!leaf->flat)
            continue;
        struct box outline = leaf->solid->bounds;
        outline.min.z = outline.max.z = 0;
        b->boxes[i] = box_transformed(outline, &leaf->to_world);
    }
}

static void body_layers_init(struct body_layers *out, const struct shader *shader, uint32_t number,
                             struct box eye)
{
    const struct body *body = &shader->model->bodies[number];
    struct builder b = {.body = body,
                        .materials = shader->bodies[number].materials,
                        .thrown = shader->model->mode == MODEL_THROWN_TOGETHER,
                        .eye = eye,
                        .out = out};
    const struct expr *e = b.e = body->whole.node_count ? &body->whole : &body->expr;
    const struct expr_node *root = &e->nodes[e->root];
    bool several = root->op == EXPR_UNION;
    find_boxes(&b);
    for (uint32_t k = 0; k < (several ? root->count : 1); k++) {
        uint32_t part = several ? e->kids[root->first + k] : e->root;
        b.around = meets_eye(&b, part);
        if (b.around || !subtree_is_opaque(&b, part))
            add_part(&b, part);
        else
            put_subtree(&b, part);
    }
    end_layer(&b, false);
    for (uint32_t i = 0; i < out->count; i++) // their places are final: tables borrow from bodies
        part_finish(&out->items[i].body);
    free(b.boxes);
    free(b.tokens);
}

// ---------------------------------------------------------------- leaves that are drawn again

// A solid in a place, in a table with open addressing.
struct place_key {
    const struct leaf *leaf; // NULL: free
    uint64_t hash;
};

struct twins {
    struct place_key *keys;
    uint32_t size; // a power of two
    bool *drawn;   // per key
};

static uint64_t hash_of(const struct leaf *leaf)
{
    uintptr_t solid = (uintptr_t)leaf->solid;
    return hash_bytes(hash_bytes(0, &solid, sizeof solid), &leaf->to_world, sizeof leaf->to_world);
}

// The place of a leaf in the table, or of the free key where it belongs.
static uint32_t twin_place(const struct twins *t, const struct leaf *leaf, uint64_t hash)
{
    uint32_t at = (uint32_t)hash & (t->size - 1);
    for (;; at = (at + 1) & (t->size - 1)) {
        const struct leaf *other = t->keys[at].leaf;
        if (!other || (t->keys[at].hash == hash && other->solid == leaf->solid &&
                       memcmp(&other->to_world, &leaf->to_world, sizeof leaf->to_world) == 0))
            return at;
    }
}

static uint32_t twin_of(const struct twins *t, const struct leaf *leaf)
{
    uint32_t at = twin_place(t, leaf, hash_of(leaf));
    return t->keys[at].leaf ? at : TWIN_NONE;
}

static bool has_members(const struct layer *l)
{
    return l->see_through && l->body.leaf_count > 1;
}

static void add_twins(struct twins *t, const struct layers *layers)
{
    uint64_t count = 0;
    for (uint32_t b = 0; b < layers->body_count; b++)
        for (uint32_t k = 0; k < layers->bodies[b].count; k++)
            if (has_members(&layers->bodies[b].items[k]))
                count += layers->bodies[b].items[k].body.leaf_count;
    t->size = 1;
    while (t->size < 2 * count)
        t->size *= 2;
    t->keys = mem_zalloc(t->size * sizeof *t->keys);
    t->drawn = mem_zalloc(t->size);
    for (uint32_t b = 0; b < layers->body_count && count; b++)
        for (uint32_t k = 0; k < layers->bodies[b].count; k++) {
            const struct body *body = &layers->bodies[b].items[k].body;
            if (!has_members(&layers->bodies[b].items[k]))
                continue;
            for (uint32_t i = 0; i < body->leaf_count; i++) {
                uint64_t hash = hash_of(&body->leaves[i]);
                uint32_t at = twin_place(t, &body->leaves[i], hash);
                t->keys[at] = (struct place_key){&body->leaves[i], hash};
            }
        }
}

static int by_twin(const void *a, const void *b)
{
    const struct factor *l = a, *r = b;
    if (l->twin != r->twin)
        return l->twin < r->twin ? -1 : 1;
    return (l->leaf > r->leaf) - (l->leaf < r->leaf);
}

// Whether a leaf of the layer was drawn before; from now on all of them were.
static void draw_members(struct layer *l, const struct twins *t)
{
    const struct body *body = &l->body;
    if (has_members(l))
        l->members = mem_alloc((body->leaf_count + 1) * sizeof *l->members);
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        uint32_t twin = twin_of(t, &body->leaves[i]);
        if (l->members)
            l->members[i] = (struct factor){twin, i, body->leaves[i].subtracted};
        if (twin == TWIN_NONE)
            continue;
        l->repeats |= l->members && t->drawn[twin];
        t->drawn[twin] = true;
    }
    if (l->members)
        qsort(l->members, body->leaf_count, sizeof *l->members, by_twin);
}

static void find_repeats(struct layers *layers, const struct model *m)
{
    struct twins t;
    add_twins(&t, layers);
    for (uint32_t b = 0; b < layers->body_count && t.size > 1; b++) {
        struct body_layers *l = &layers->bodies[b];
        const struct body *body = &m->bodies[b];
        l->twin_of = mem_alloc((body->leaf_count + 1) * sizeof *l->twin_of);
        for (uint32_t i = 0; i < body->leaf_count; i++) {
            l->twin_of[i] = twin_of(&t, &body->leaves[i]);
            if (!l->count && l->twin_of[i] != TWIN_NONE)
                t.drawn[l->twin_of[i]] = true;
        }
        for (uint32_t k = 0; k < l->count; k++) {
            draw_members(&l->items[k], &t);
            layers->repeat |= l->items[k].repeats;
        }
    }
    free(t.keys);
    free(t.drawn);
}

static struct layers *make(const struct shader *shader, struct box eye)
{
    const struct model *m = shader->model;
    struct layers *out = mem_alloc(sizeof *out);
    *out = (struct layers){.bodies = mem_zalloc((m->body_count + 1) * sizeof *out->bodies),
                           .body_count = m->body_count};
    for (uint32_t i = 0; i < m->body_count; i++)
        if (!shader->bodies[i].opaque || (i == 0 && !box_is_empty(eye)))
            body_layers_init(&out->bodies[i], shader, i, eye);
    if (m->mode != MODEL_THROWN_TOGETHER)
        find_repeats(out, m);
    return out;
}

struct layers *layers_new(const struct shader *shader)
{
    return make(shader, BOX_EMPTY);
}

struct layers *layers_around(const struct shader *shader, const struct rays *rays)
{
    const struct model *m = shader->model;
    struct box eye = BOX_EMPTY;
    for (int i = 0; i < 4; i++) {
        double x = i & 1 ? rays->width - 0.5 : -0.5, y = i & 2 ? rays->height - 0.5 : -0.5;
        eye = box_of_point(eye, vec3_add(rays_origin(rays, x, y),
                                         vec3_scale(rays_direction(rays, x, y), rays->near)));
    }
    if (m->mode != MODEL_THROWN_TOGETHER || !m->body_count)
        return NULL;
    const struct body *body = &m->bodies[0];
    for (uint32_t i = 0; i < body->leaf_count; i++)
        if (body->expr.leaf_node[i] != EXPR_NONE &&
            !box_is_empty(box_intersection(body->leaves[i].box, eye)))
            return make(shader, eye);
    return NULL;
}

void layers_delete(struct layers *l)
{
    if (!l)
        return;
    for (uint32_t i = 0; i < l->body_count; i++) {
        struct body_layers *layers = &l->bodies[i];
        for (uint32_t k = 0; k < layers->count; k++) {
            part_free(&layers->items[k].body);
            free(layers->items[k].leaf_of);
            free(layers->items[k].members);
        }
        free(layers->items);
        free(layers->twin_of);
    }
    free(l->bodies);
    free(l);
}
