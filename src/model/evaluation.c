// evaluation.c - the walk over a node that OpenSCAD evaluates as one object, and all below it.
//
// The walk goes down with matrices for solids and comes back up with values. Flat shapes are moved
// on the way up, as OpenSCAD does it, which rounds them between the steps. No recursion: files nest
// as deep as memory allows.
#include "model/evaluation.h"

#include "base/hash.h"
#include "model/nodes.h"

#include <stdlib.h>

enum { KEY_GEOMETRY = 0x67656f6d };

// A node whose children are being evaluated.
struct level {
    const struct csg_node *node, *next;
    const struct node_type *type;
    struct args args;
    struct affine own;       // of a transform
    uint32_t number;         // among the digests
    uint32_t matrix, detail; // newest entries of the stacks that hold for the children
    uint32_t first_value, first_leaf, first_term;
    uint64_t key; // of a combined node
};

struct evaluation {
    struct builder *b; // its messages, imports, cutter and scene are those of this evaluation
    const struct digest *digests;
    uint32_t at; // digest of the node to be visited next
    struct level *levels;
    uint32_t level_count, level_room;
    struct affine *matrices; // since the last combined node
    uint32_t matrix_room;
    struct detail *details;
    uint32_t detail_room;
    struct value *values;
    uint32_t value_count, value_room;
};

static void push_value(struct evaluation *e, struct value v)
{
    array_reserve(&e->values, &e->value_room, (size_t)e->value_count + 1);
    e->values[e->value_count++] = v;
}

static uint32_t push_matrix(struct evaluation *e, uint32_t top, const struct affine *m)
{
    array_reserve(&e->matrices, &e->matrix_room, (size_t)top + 2);
    e->matrices[top + 1] = *m;
    return top + 1;
}

static uint32_t push_detail(struct evaluation *e, uint32_t top, struct detail d)
{
    array_reserve(&e->details, &e->detail_room, (size_t)top + 2);
    e->details[top + 1] = d;
    return top + 1;
}

uint64_t evaluation_key(uint64_t digest, struct detail d)
{
    return hash_bytes(KEY_GEOMETRY ^ digest, &d, sizeof d);
}

// ---------------------------------------------------------------- what is found ready

void evaluation_tell(struct builder *b, const struct geometry *g)
{
    messages_append(b->messages, &g->messages);
    for (uint32_t i = 0; i < g->import_count; i++)
        builder_note_import(b, g->imports[i]);
    b->unsupported += g->unsupported;
}

static struct value value_of(struct evaluation *e, const struct geometry *g)
{
    struct value v = {.kind = g->kind, .term = TERM_EMPTY};
    if (g->kind == GEOMETRY_FLAT)
        outline_copy(&v.outline, &g->outline);
    if (g->kind == GEOMETRY_SOLID)
        v = value_of_term(&e->b->scene, scene_add(&e->b->scene, &g->scene, g->root));
    return v;
}

// ---------------------------------------------------------------- leaves

static void visit_solid(struct evaluation *e, const struct args *args, const struct node_type *type,
                        const struct affine *matrix)
{
    struct leaf leaf;
    struct value v = {.kind = GEOMETRY_SOLID, .term = TERM_EMPTY};
    if (builder_leaf(e->b, args, type, matrix, &v.placed, &leaf))
        v.term = scene_leaf(&e->b->scene, &leaf);
    push_value(e, v);
}

static void visit_flat(struct evaluation *e, const struct args *args, const struct node_type *type)
{
    struct value v = {.kind = GEOMETRY_FLAT, .term = TERM_EMPTY};
    type->flat(e->b, args, &v.outline);
    push_value(e, v);
}

// ---------------------------------------------------------------- down

static void visit_parent(struct evaluation *e, const struct csg_node *n,
                         const struct node_type *type, const struct args *args, struct level l)
{
    l.node = n;
    l.next = n->child;
    l.type = type;
    l.args = *args;
    l.number = e->at++;
    l.first_value = e->value_count;
    l.first_leaf = e->b->scene.leaf_count;
    l.first_term = e->b->scene.term_count;
    l.own = AFFINE_IDENTITY;
    if (args->own_detail && type->parameters)
        l.detail = push_detail(e, l.detail, args->detail);
    if (type->kind == NODE_TRANSFORM) {
        type->transform(e->b, args, &l.own);
        struct affine m = affine_mul(&e->matrices[l.matrix], &l.own);
        if (!affine_is_finite(&m)) {
            builder_warn(e->b, n, "the matrix of %s() is not finite; left out", n->name);
            e->at = l.number + e->digests[l.number].nodes;
            push_value(e, (struct value){0});
            return;
        }
        l.matrix = push_matrix(e, l.matrix, &m);
    }
    if (type->kind == NODE_COMBINED)
        l.matrix = push_matrix(e, l.matrix, &AFFINE_IDENTITY);
    struct detail assigned = e->details[l.detail];
    if (detail_assigned(&assigned, l.next))
        l.detail = push_detail(e, l.detail, assigned);
    array_reserve(&e->levels, &e->level_room, (size_t)e->level_count + 1);
    e->levels[e->level_count++] = l;
}

// A combined node that is in the store already.
static bool visit_ready(struct evaluation *e, uint64_t key, const struct csg_node *n,
                        const struct affine *matrix)
{
    const struct geometry *g = store_geometry(e->b->store, key, n->line);
    if (!g)
        return false;
    evaluation_tell(e->b, g);
    uint32_t first = e->b->scene.leaf_count;
    push_value(e, value_of(e, g));
    for (uint32_t i = first; i < e->b->scene.leaf_count; i++) {
        struct leaf *leaf = &e->b->scene.leaves[i];
        leaf->to_world = affine_mul(matrix, &leaf->to_world);
        leaf->place = builder_place(e->b, n);
    }
    e->at += e->digests[e->at].nodes;
    return true;
}

static void visit(struct evaluation *e, const struct csg_node *n, const struct level *parent)
{
    struct args args = {0};
    const struct node_type *type = node_type_of(n->name);
    struct level l = {.matrix = parent ? parent->matrix : 0, .detail = parent ? parent->detail : 0};
    uint32_t after = e->at + e->digests[e->at].nodes;
    if ((n->modifiers & CSG_DISABLE) || (parent && (n->modifiers & CSG_BACKGROUND)) ||
        type->kind == NODE_ASSIGNMENT) {
        e->at = after;
        return;
    }
    if (type->kind == NODE_COMBINED) {
        l.key = evaluation_key(e->digests[e->at].hash, e->details[l.detail]);
        if (parent && visit_ready(e, l.key, n, &e->matrices[l.matrix]))
            return;
    }
    if (type->kind == NODE_UNKNOWN || type->kind == NODE_UNSUPPORTED) {
        builder_warn_left_out(e->b, n, type);
        e->at = after;
        if (type->kind == NODE_UNSUPPORTED)
            push_value(e, (struct value){0});
        return;
    }
    if (type->parameters)
        args_bind(&args, e->b, n, type->parameters, e->details[l.detail]);
    if (type->kind == NODE_IMPORT)
        type = import_type(&args);
    if (type->kind == NODE_SHAPE)
        visit_solid(e, &args, type, &e->matrices[l.matrix]);
    else if (type->kind == NODE_FLAT)
        visit_flat(e, &args, type);
    else {
        visit_parent(e, n, type, &args, l);
        return;
    }
    e->at = after;
}

// ---------------------------------------------------------------- up

// The first child that is anything says what the node is; others of its children are left out.
static enum geometry_kind common_kind(struct evaluation *e, const struct level *l)
{
    enum geometry_kind kind = GEOMETRY_NONE;
    bool said = false;
    for (uint32_t i = l->first_value; i < e->value_count; i++) {
        struct value *v = &e->values[i];
        if (kind == GEOMETRY_NONE)
            kind = v->kind;
        if (v->kind == GEOMETRY_NONE || v->kind == kind)
            continue;
        if (!said)
            builder_warn(e->b, l->node, "%s() mixes 2D and 3D objects; the %s ones are left out",
                         l->node->name, kind == GEOMETRY_FLAT ? "3D" : "2D");
        said = true;
        value_free(v);
    }
    return kind;
}

// Puts what a combined node below the one being evaluated is into the store as well: it stays when
// something around it changes. What brought up messages or files is made again with them.
static void keep(struct evaluation *e, const struct level *l, const struct value *v)
{
    const struct builder *b = e->b;
    if (b->messages->warnings + b->messages->errors + b->import_count + b->unsupported)
        return;
    struct geometry g = {.kind = v->kind};
    outline_copy(&g.outline, &v->outline);
    if (v->kind == GEOMETRY_SOLID)
        g.root = scene_add(&g.scene, &b->scene, v->term);
    store_add_geometry(b->store, l->key, &g);
}

static void leave(struct evaluation *e)
{
    struct level l = e->levels[--e->level_count];
    struct value out = {.term = TERM_EMPTY};
    struct operands o = {.b = e->b,
                         .args = &l.args,
                         .kind = common_kind(e, &l),
                         .values = e->values + l.first_value,
                         .count = e->value_count - l.first_value,
                         .scene = &e->b->scene,
                         .first_leaf = l.first_leaf,
                         .first_term = l.first_term};
    if (l.type->kind == NODE_COMBINED) {
        l.type->combine(&o, &out);
        for (uint32_t i = l.first_leaf; i < e->b->scene.leaf_count; i++)
            e->b->scene.leaves[i].place = builder_place(e->b, l.node);
        if (out.kind == GEOMETRY_SOLID)
            out.placed = value_of_term(&e->b->scene, out.term).placed;
        if (e->level_count) {
            keep(e, &l, &out);
            operands_move(&o, &e->matrices[e->levels[e->level_count - 1].matrix]);
        }
    } else {
        operands_fold(&o, l.type->operation, &out);
        if (l.type->kind == NODE_TRANSFORM && out.kind == GEOMETRY_FLAT)
            value_place(e->b, l.node, &out, &l.own);
        if (l.type->kind == NODE_TRANSFORM && out.kind == GEOMETRY_SOLID)
            out.placed = affine_mul(&l.own, &out.placed);
    }
    for (uint32_t i = l.first_value; i < e->value_count; i++)
        value_free(&e->values[i]);
    e->value_count = l.first_value;
    push_value(e, out);
    e->at = l.number + e->digests[l.number].nodes;
}

// ---------------------------------------------------------------- a whole node

static void run(struct evaluation *e, const struct csg_node *n)
{
    visit(e, n, NULL);
    while (e->level_count && !builder_cancelled(e->b)) {
        struct level *l = &e->levels[e->level_count - 1];
        const struct csg_node *next = l->next;
        if (next) {
            l->next = next->next;
            struct level parent = *l; // the array may move
            visit(e, next, &parent);
        } else
            leave(e);
    }
}

bool evaluation_run(const struct builder *whole, const struct csg_node *n, struct detail d,
                    const struct digest *digests, struct geometry *g)
{
    struct builder b = {.tree = whole->tree,
                        .file = whole->file,
                        .folder = whole->folder,
                        .options = whole->options,
                        .store = whole->store,
                        .messages = &g->messages};
    struct evaluation e = {.b = &b, .digests = digests};
    array_reserve(&e.details, &e.detail_room, 1);
    array_reserve(&e.matrices, &e.matrix_room, 1);
    e.details[0] = d;
    e.matrices[0] = AFFINE_IDENTITY;
    run(&e, n);
    bool done = !builder_cancelled(&b);
    struct value v = {0};
    if (done && e.value_count)
        v = e.values[--e.value_count];
    g->kind = v.kind;
    g->outline = v.outline;
    g->root = v.term;
    if (v.kind == GEOMETRY_FLAT)
        g->plate = store_plate(b.store, &g->outline);
    if (v.kind == GEOMETRY_SOLID) {
        g->scene = b.scene;
        b.scene = (struct scene){0};
    }
    g->imports = builder_take_imports(&b, &g->import_count);
    g->unsupported = b.unsupported;
    g->line = n->line;
    while (e.value_count)
        value_free(&e.values[--e.value_count]);
    scene_free(&b.scene);
    polygon_cutter_delete(b.cutter);
    free(e.levels);
    free(e.matrices);
    free(e.details);
    free(e.values);
    return done;
}
