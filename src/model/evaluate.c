// evaluate.c - nodes that OpenSCAD evaluates as one object, with all below them.
//
// The walk goes down with matrices for solids and comes back up with values. Flat shapes are moved
// on the way up, as OpenSCAD does it, which rounds them between the steps. No recursion: files nest
// as deep as memory allows.
#include "model/evaluate.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "model/digest.h"
#include "model/nodes.h"

#include <stdlib.h>
#include <string.h>

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

static uint64_t key_of(uint64_t digest, struct detail d)
{
    return hash_bytes(KEY_GEOMETRY ^ digest, &d, sizeof d);
}

// ---------------------------------------------------------------- what is found ready

static void use_notes(struct builder *b, const struct geometry *g)
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
    use_notes(e->b, g);
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
        l.key = key_of(e->digests[e->at].hash, e->details[l.detail]);
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

// Fills *g; false when it was cancelled.
static bool evaluate(const struct builder *whole, const struct csg_node *n, struct detail d,
                     struct digest *digests, struct geometry *g)
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

static const struct geometry *make(struct builder *b, const struct csg_node *n, struct detail d,
                                   struct digest *digests, uint64_t key)
{
    struct geometry g = {0};
    if (evaluate(b, n, d, digests, &g))
        return store_add_geometry(b->store, key, &g);
    geometry_free(&g);
    return NULL;
}

const struct geometry *evaluate_node(struct builder *b, const struct csg_node *n, struct detail d)
{
    struct digest *digests = digest_tree(n);
    uint64_t key = key_of(digests[0].hash, d);
    const struct geometry *g = store_geometry(b->store, key, n->line);
    if (!g && b->collecting) {
        array_reserve(&b->jobs, &b->job_room, (size_t)b->job_count + 1);
        b->jobs[b->job_count++] = (struct job){n, d, key};
    } else if (!g)
        g = make(b, n, d, digests, key);
    free(digests);
    if (g)
        use_notes(b, g);
    return g;
}

bool evaluate_once(struct builder *b, const struct csg_node *n, struct geometry *out)
{
    struct digest *digests = digest_tree(n);
    *out = (struct geometry){0};
    bool done = evaluate(b, n, DETAIL_DEFAULT, digests, out);
    use_notes(b, out);
    free(digests);
    return done;
}

bool evaluates_flat(const struct csg_node *root)
{
    struct csg_iterator it = {0};
    const struct csg_node *n;
    enum geometry_kind kind = GEOMETRY_NONE;
    csg_enter(&it, root->child);
    while (kind == GEOMETRY_NONE && (n = csg_next(&it))) {
        if (n->modifiers & (CSG_DISABLE | CSG_BACKGROUND))
            continue;
        const struct node_type *type = node_type_of(n->name);
        kind = type->kind == NODE_IMPORT ? import_type_of(n)->gives : type->gives;
        csg_enter(&it, n->child);
    }
    csg_iterator_free(&it);
    return kind == GEOMETRY_FLAT;
}

static void evaluate_job(void *context, uint32_t item, uint32_t worker)
{
    struct builder *b = context;
    const struct job *j = &b->jobs[item];
    (void)worker;
    if (builder_cancelled(b))
        return;
    struct digest *digests = digest_tree(j->node);
    make(b, j->node, j->detail, digests, j->key);
    free(digests);
}

static int by_key(const void *a, const void *b)
{
    uint64_t p = ((const struct job *)a)->key, q = ((const struct job *)b)->key;
    return p < q ? -1 : p > q;
}

void evaluate_collected(struct builder *b)
{
    uint32_t kept = 0;
    if (b->job_count)
        qsort(b->jobs, b->job_count, sizeof *b->jobs, by_key);
    for (uint32_t i = 0; i < b->job_count; i++)
        if (!i || b->jobs[i].key != b->jobs[kept - 1].key)
            b->jobs[kept++] = b->jobs[i];
    parallel_for(kept, 0, evaluate_job, b);
    free(b->jobs);
    b->jobs = NULL;
    b->job_count = b->job_room = 0;
}
