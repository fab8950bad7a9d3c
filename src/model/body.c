// body.c - from operations between placed shapes to a body that can be drawn.
#include "model/builder.h"
#include "model/products.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

// Where a term stands. SUBTRACTED: under an odd number of subtractions. PALE: as it counts for the
// colour of faces; below render() it no longer changes. APART: in the rendered shape of a
// subtracted object. HIGHLIGHTED: is or was marked #, and shown so.
enum {
    STANDS_SUBTRACTED = 1,
    STANDS_PALE = 2,
    STANDS_RENDERED = 4,
    STANDS_APART = 8,
    STANDS_HIGHLIGHTED = 16
};

#define CUTTING_PLATE 1.1 // thickness of a subtracted plate over that of others

struct todo {
    uint32_t term;  // TERM_NONE: the operands are done, put the operation
    uint32_t count; // of operands
    uint8_t op, stands;
};

struct emitter {
    struct builder *b;
    struct body *body;
    uint32_t leaf_room;
    bool *intersected; // per leaf
    uint32_t intersected_room;
    struct expr_token *tokens;
    uint32_t token_count, token_room;
    struct todo *todo;
    uint32_t todo_count, todo_room;
};

static void put_token(struct emitter *e, enum expr_op op, uint32_t arg)
{
    array_reserve(&e->tokens, &e->token_room, (size_t)e->token_count + 1);
    e->tokens[e->token_count++] = (struct expr_token){op, arg};
}

static void put_todo(struct emitter *e, struct todo t)
{
    array_reserve(&e->todo, &e->todo_room, (size_t)e->todo_count + 1);
    e->todo[e->todo_count++] = t;
}

static void put_leaf(struct emitter *e, uint32_t number, uint8_t stands)
{
    struct leaf leaf = e->b->scene.leaves[number];
    leaf.subtracted = stands & STANDS_PALE;
    leaf.highlighted = stands & STANDS_HIGHLIGHTED;
    if (e->body->kind != BODY_MAIN)
        leaf.grid = 0;
    if (leaf.flat && (stands & STANDS_SUBTRACTED)) // as OpenSCAD does, to cut what is as thick
        for (int i = 0; i < 3; i++)
            leaf.to_world.m[i][2] *= CUTTING_PLATE;
    if (!leaf.solid || !affine_inverse(&leaf.to_world, &leaf.to_local)) {
        put_token(e, EXPR_UNION, 0);
        return;
    }
    leaf.mirrored = affine_determinant(&leaf.to_world) < 0;
    leaf.box = box_transformed(leaf.solid->bounds, &leaf.to_world);
    store_hold(e->b->store, leaf.solid);

    struct body *body = e->body;
    size_t needed = (size_t)body->leaf_count + 1;
    if (body->kind == BODY_MAIN) // compacted in place: numbers come in the order of the file
        assert(number >= body->leaf_count);
    else
        array_reserve(&body->leaves, &e->leaf_room, needed);
    array_reserve(&e->intersected, &e->intersected_room, needed);
    body->leaves[body->leaf_count] = leaf;
    e->intersected[body->leaf_count] = !(stands & (STANDS_SUBTRACTED | STANDS_APART));
    put_token(e, EXPR_LEAF, body->leaf_count++);
}

static uint8_t stands_as_subtrahend(uint8_t stands)
{
    return stands ^
           (stands & STANDS_RENDERED ? STANDS_SUBTRACTED : STANDS_SUBTRACTED | STANDS_PALE);
}

static void put_term(struct emitter *e, struct todo now)
{
    const struct scene *s = &e->b->scene;
    const struct term *t = &s->terms[now.term];
    uint8_t stands = now.stands;
    if (t->rendered && !(stands & STANDS_RENDERED))
        stands |= stands & STANDS_SUBTRACTED ? STANDS_RENDERED | STANDS_APART : STANDS_RENDERED;
    if (t->op == TERM_LEAF) {
        put_leaf(e, t->left, stands);
        return;
    }
    // A chain of one operation down the left operands is one operation on many.
    enum term_op op = t->op;
    uint8_t right = op == TERM_DIFFERENCE ? stands_as_subtrahend(stands) : stands;
    uint32_t close = e->todo_count, count = 1, left;
    put_todo(e, (struct todo){.term = TERM_NONE, .op = (uint8_t)op});
    for (;; t = &s->terms[left]) {
        put_todo(e, (struct todo){.term = t->right, .stands = right});
        count++;
        left = t->left;
        if (s->terms[left].op != op || s->terms[left].rendered)
            break;
    }
    put_todo(e, (struct todo){.term = left, .stands = stands});
    e->todo[close].count = count;
}

static void emit(struct emitter *e, uint32_t term, uint8_t stands)
{
    static const enum expr_op op_of[] = {[TERM_UNION] = EXPR_UNION,
                                         [TERM_INTERSECTION] = EXPR_INTERSECTION,
                                         [TERM_DIFFERENCE] = EXPR_DIFFERENCE};
    put_todo(e, (struct todo){.term = term, .stands = stands});
    while (e->todo_count) {
        struct todo now = e->todo[--e->todo_count];
        if (now.term == TERM_NONE)
            put_token(e, op_of[now.op], now.count);
        else if (now.term == TERM_EMPTY)
            put_token(e, EXPR_UNION, 0);
        else
            put_term(e, now);
    }
}

// Each shape that takes part in the term, whole.
static void emit_parts(struct emitter *e, uint32_t term)
{
    struct part *parts;
    uint32_t count;
    products_parts(&e->b->scene, term, &parts, &count);
    for (uint32_t i = 0; i < count; i++) {
        int stands = parts[i].role == PART_SUBTRACTED ? STANDS_SUBTRACTED | STANDS_PALE : 0;
        stands |= parts[i].highlighted ? STANDS_HIGHLIGHTED : 0;
        emit(e, parts[i].term, (uint8_t)stands);
    }
    put_token(e, EXPR_UNION, count);
    free(parts);
}

// The leaves and their expression.
static void emit_all(struct emitter *e, const uint32_t *terms, uint32_t term_count)
{
    struct body *body = e->body;
    struct scene *s = &e->b->scene;
    if (body->kind == BODY_MAIN)
        body->leaves = s->leaves;
    for (uint32_t i = 0; i < term_count; i++)
        if (e->b->options->mode == MODEL_THROWN_TOGETHER)
            emit_parts(e, terms[i]);
        else
            emit(e, terms[i], 0);
    put_token(e, EXPR_UNION, term_count);
    free(e->todo);
    if (body->kind == BODY_MAIN) {
        body->grids = s->grids;
        s->leaves = NULL;
        s->grids = NULL;
        scene_free(s);
        body->leaves = mem_realloc(body->leaves, body->leaf_count * sizeof *body->leaves);
    }
    expr_build(&body->expr, e->tokens, e->token_count, body->leaf_count);
    free(e->tokens);
}

// The box of a flat shape is that of its outline, not of its plate.
static struct box box_to_show(const struct leaf *leaf)
{
    if (!leaf->flat)
        return leaf->box;
    struct box box = leaf->solid->bounds;
    box.min.z = box.max.z = 0;
    return box_transformed(box, &leaf->to_world);
}

static bool is_see_through(const struct body *body)
{
    bool any = body->kind != BODY_MAIN;
    for (uint32_t i = 0; i < body->leaf_count && !any; i++)
        any = body->leaves[i].colour[3] >= 0 && body->leaves[i].colour[3] < 1;
    return any;
}

// Regions of interest, and the expression without the leaves that have none.
static void restrict_leaves(struct body *body, const bool *intersected, bool wanted,
                            struct box *bounds)
{
    uint32_t count = body->leaf_count;
    bool *keep = mem_alloc(count), drop = false;
    body->roi = mem_alloc(count * sizeof *body->roi);
    for (uint32_t i = 0; i < count; i++)
        body->roi[i] = body->leaves[i].box;
    roi_build(body->roi, &body->expr, body->roi);
    for (uint32_t i = 0; i < count; i++) {
        bool stands = body->expr.leaf_node[i] != EXPR_NONE;
        keep[i] = !box_is_empty(body->roi[i]);
        drop |= stands && !keep[i];
        if (keep[i] && intersected[i] && stands)
            *bounds = box_union(*bounds, box_to_show(&body->leaves[i]));
    }
    if (wanted && drop) {
        body->whole = body->expr;
        expr_without(&body->expr, &body->whole, keep);
        if (!is_see_through(body))
            expr_free(&body->whole);
    }
    for (uint32_t i = 0; i < count && !wanted; i++)
        body->roi[i] = body->leaves[i].box;
    free(keep);
}

void body_build(struct body *out, enum body_kind kind, struct builder *b,
                const struct model_options *options, const uint32_t *terms, uint32_t term_count,
                struct box *intersected)
{
    *out = (struct body){
        .kind = kind, .part = kind == BODY_MAIN, .borders = options->mode == MODEL_RENDER};
    for (uint32_t i = 0; i < term_count && kind == BODY_HIGHLIGHT; i++)
        out->part |= b->scene.terms[terms[i]].taken_out;
    struct emitter e = {.b = b, .body = out};
    emit_all(&e, terms, term_count);
    restrict_leaves(out, e.intersected, options->roi, intersected);

    bool *convex = mem_alloc(out->leaf_count);
    for (uint32_t i = 0; i < out->leaf_count; i++)
        convex[i] = out->leaves[i].solid->convex;
    sharing_build(&out->sharing, &out->expr, convex, options->share);
    out->table = discovery_new(&out->expr, &out->sharing);
    free(convex);
    free(e.intersected);
}

void body_free(struct body *body)
{
    discovery_delete(body->table);
    sharing_free(&body->sharing);
    expr_free(&body->expr);
    expr_free(&body->whole);
    for (uint32_t i = 0; i < body->leaf_count; i++)
        store_release(body->leaves[i].solid);
    free(body->leaves);
    free(body->roi);
    free(body->grids);
    *body = (struct body){0};
}
