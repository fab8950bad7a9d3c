// walk.c - from the tree of the file to placed shapes and operations between them.
//
// No recursion: files nest as deep as memory allows.
#include "model/evaluate.h"
#include "model/nodes.h"
#include "model/operands.h"

#include <stdlib.h>
#include <string.h>

struct colour {
    float c[4];
};

enum render_state { RENDER_OUTSIDE, RENDER_NODE, RENDER_BELOW };

// A node whose children are being visited. They are folded when all are there: what one of them
// shows apart comes before what the node itself does, as in OpenSCAD.
struct frame {
    const struct csg_node *node;     // NULL: the top level
    const struct csg_node *next;     // child to be visited
    uint32_t first;                  // of its operands: the terms of the children so far
    uint32_t matrix, colour, detail; // newest entries of the stacks that hold for the children
    uint8_t operation, render;
    bool aside; // only for what is marked below it, which is shown apart
};

struct walk {
    struct builder *b;
    struct frame *frames;
    uint32_t frame_count, frame_room;
    uint32_t *operands;
    uint32_t operand_count, operand_room;
    struct affine *matrices;
    uint32_t matrix_room;
    struct colour *colours;
    uint32_t colour_room;
    struct detail *details;
    uint32_t detail_room;
    // Names are interned: what a pointer means is remembered by its address.
    struct {
        const char *name;
        const struct node_type *type;
    } cache[64];
};

static const struct node_type *type_of(struct walk *w, const struct csg_node *n)
{
    size_t slot = ((uintptr_t)n->name >> 4 ^ (uintptr_t)n->name >> 10) % array_count(w->cache);
    if (w->cache[slot].name != n->name) {
        w->cache[slot].name = n->name;
        w->cache[slot].type = node_type_of(n->name);
    }
    return w->cache[slot].type;
}

static void push_matrix(struct walk *w, struct frame *f, const struct affine *m)
{
    array_reserve(&w->matrices, &w->matrix_room, (size_t)f->matrix + 2);
    w->matrices[f->matrix + 1] = affine_mul(&w->matrices[f->matrix], m);
    f->matrix++;
}

// The outermost colour whose components are all set wins.
static void push_colour(struct walk *w, struct frame *f, const struct args *args)
{
    const float *now = w->colours[f->colour].c;
    struct colour colour;
    colour_of(w->b, args, colour.c);
    if (f->render != RENDER_OUTSIDE || (now[0] >= 0 && now[1] >= 0 && now[2] >= 0 && now[3] >= 0))
        return;
    array_reserve(&w->colours, &w->colour_room, (size_t)f->colour + 2);
    w->colours[++f->colour] = colour;
}

static void push_detail(struct walk *w, struct frame *f, struct detail d)
{
    array_reserve(&w->details, &w->detail_room, (size_t)f->detail + 2);
    w->details[++f->detail] = d;
}

static void push_frame(struct walk *w, struct frame f)
{
    struct detail assigned = w->details[f.detail];
    if (detail_assigned(&assigned, f.next))
        push_detail(w, &f, assigned);
    f.first = w->operand_count;
    array_reserve(&w->frames, &w->frame_room, (size_t)w->frame_count + 1);
    w->frames[w->frame_count++] = f;
}

// Below render() the parts are one object: objects marked % are left out of it, those marked # take
// part, and both are shown beside it as elsewhere, except those directly below render().
static uint32_t fold_rendered(struct scene *s, const struct frame *f, uint32_t left, uint32_t term)
{
    uint32_t marks = scene_marks(s, term);
    if (f->render == RENDER_NODE) {
        if (marks)
            s->terms[term].marks = 0;
        if (marks & CSG_BACKGROUND)
            return left;
    } else if (f->operation == TERM_UNION && left != TERM_NONE) {
        uint32_t before = scene_marks(s, left);
        if ((marks | before) == CSG_HIGHLIGHT && marks != before)
            scene_show_apart(s, marks ? term : left); // no longer marked, it stays in the union
    }
    return scene_fold(s, f->operation, left, term);
}

// Does render() make one object of several operands of a node?
static bool are_combined(const struct walk *w, const struct frame *f)
{
    uint32_t count = 0;
    for (uint32_t i = f->first; i < w->operand_count && f->render != RENDER_OUTSIDE; i++)
        count += !(scene_marks(&w->b->scene, w->operands[i]) & CSG_BACKGROUND) &&
                 (f->operation != TERM_UNION || w->operands[i] < TERM_EMPTY);
    return count > 1;
}

// Takes the operands of a node off the stack and returns what they make, TERM_NONE without any.
static uint32_t fold(struct walk *w, const struct frame *f)
{
    struct scene *s = &w->b->scene;
    uint32_t term = TERM_NONE;
    bool combined = are_combined(w, f);
    for (uint32_t i = f->first; i < w->operand_count; i++) {
        uint32_t one = combined && !scene_marks(s, w->operands[i])
                           ? closed_term(w->b, w->operands[i])
                           : w->operands[i];
        term = f->render != RENDER_OUTSIDE ? fold_rendered(s, f, term, one)
                                           : scene_fold(s, f->operation, term, one);
    }
    w->operand_count = f->first;
    return term;
}

static void put_operand(struct walk *w, uint32_t term)
{
    array_reserve(&w->operands, &w->operand_room, (size_t)w->operand_count + 1);
    w->operands[w->operand_count++] = term;
}

static void mark(struct walk *w, const struct csg_node *n, uint32_t term)
{
    scene_mark(&w->b->scene, term, n->modifiers & (CSG_BACKGROUND | CSG_HIGHLIGHT));
}

static void visit_shape(struct walk *w, const struct csg_node *n, const struct node_type *type)
{
    const struct frame *f = &w->frames[w->frame_count - 1];
    struct args args;
    struct leaf leaf;
    struct affine place;
    uint32_t term = TERM_EMPTY;
    args_bind(&args, w->b, n, type->parameters, w->details[f->detail]);
    if (builder_leaf(w->b, &args, type, &w->matrices[f->matrix], &place, &leaf)) {
        memcpy(leaf.colour, w->colours[f->colour].c, sizeof leaf.colour);
        term = scene_leaf(&w->b->scene, &leaf);
    }
    mark(w, n, term);
    put_operand(w, term);
}

static void visit_parent(struct walk *w, const struct csg_node *n, const struct node_type *type)
{
    struct frame f = w->frames[w->frame_count - 1];
    f.node = n;
    f.next = n->child;
    f.operation = (uint8_t)type->operation;
    if (type->parameters) {
        struct args args;
        args_bind(&args, w->b, n, type->parameters, w->details[f.detail]);
        if (args.own_detail)
            push_detail(w, &f, args.detail);
        if (type->kind == NODE_COLOUR)
            push_colour(w, &f, &args);
        if (type->kind == NODE_TRANSFORM) {
            struct affine m;
            type->transform(w->b, &args, &m);
            push_matrix(w, &f, &m);
        }
    }
    if (!affine_is_finite(&w->matrices[f.matrix])) {
        builder_warn(w->b, n, "the matrix of %s() is not finite; left out", n->name);
        put_operand(w, TERM_EMPTY);
        return;
    }
    if (f.render == RENDER_NODE)
        f.render = RENDER_BELOW;
    else if (type->kind == NODE_RENDER && f.render == RENDER_OUTSIDE)
        f.render = RENDER_NODE;
    push_frame(w, f);
}

// Is a node below this one marked % or #?
static bool has_marked(const struct csg_node *root)
{
    struct csg_iterator it = {0};
    const struct csg_node *n;
    bool found = false;
    csg_enter(&it, root->child);
    while (!found && (n = csg_next(&it))) {
        if (n->modifiers & CSG_DISABLE)
            continue;
        found = n->modifiers & (CSG_BACKGROUND | CSG_HIGHLIGHT);
        csg_enter(&it, n->child);
    }
    csg_iterator_free(&it);
    return found;
}

// A flat shape is shown as its plate, an evaluated object as what it is made of.
static void visit_geometry(struct walk *w, const struct csg_node *n, const struct node_type *type)
{
    const struct frame *f = &w->frames[w->frame_count - 1];
    struct scene *s = &w->b->scene;
    const struct geometry *g = evaluate_node(w->b, n, w->details[f->detail]);
    uint32_t first = s->leaf_count, term = TERM_EMPTY;
    bool fits = true;
    if (g && g->kind == GEOMETRY_FLAT && g->plate)
        term = scene_leaf(
            s, &(struct leaf){.solid = g->plate, .to_world = AFFINE_IDENTITY, .flat = true});
    if (g && g->kind == GEOMETRY_SOLID) {
        term = scene_add(s, &g->scene, g->root);
        scene_rendered(s, term);
    }
    for (uint32_t i = first; i < s->leaf_count; i++) {
        struct leaf *leaf = &s->leaves[i];
        leaf->to_world = affine_mul(&w->matrices[f->matrix], &leaf->to_world);
        leaf->place = builder_place(w->b, n);
        memcpy(leaf->colour, w->colours[f->colour].c, sizeof leaf->colour);
        fits &= leaf_fits(leaf);
    }
    if (!fits) {
        builder_warn_too_large(w->b, n);
        term = TERM_EMPTY;
    }
    mark(w, n, term);
    put_operand(w, term);
    if (type->shows_marked && has_marked(n)) {
        struct frame aside = *f;
        aside.node = n;
        aside.next = n->child;
        aside.operation = TERM_UNION;
        aside.aside = true;
        push_frame(w, aside);
    }
}

static void visit_import(struct walk *w, const struct csg_node *n)
{
    const struct node_type *type = import_type_of(n);
    if (type->kind == NODE_FLAT)
        visit_geometry(w, n, type);
    else
        visit_shape(w, n, type);
}

static void visit(struct walk *w, const struct csg_node *n)
{
    bool rendered = w->b->options->mode == MODEL_RENDER; // then it is only to be collected
    if (n->modifiers & (rendered ? CSG_DISABLE | CSG_BACKGROUND : CSG_DISABLE))
        return;
    const struct node_type *type = type_of(w, n);
    switch (type->kind) {
    case NODE_OPERATION:
    case NODE_TRANSFORM:
    case NODE_COLOUR:
        visit_parent(w, n, type);
        break;
    case NODE_RENDER:
        if (!rendered && w->frames[w->frame_count - 1].render == RENDER_OUTSIDE &&
            evaluates_flat(n))
            visit_geometry(w, n, type);
        else
            visit_parent(w, n, type);
        break;
    case NODE_SHAPE:
        visit_shape(w, n, type);
        break;
    case NODE_FLAT:
        if (!rendered)
            visit_geometry(w, n, type);
        break;
    case NODE_COMBINED:
        visit_geometry(w, n, type);
        break;
    case NODE_IMPORT:
        if (!rendered)
            visit_import(w, n);
        break;
    case NODE_UNSUPPORTED:
        builder_warn_left_out(w->b, n, type);
        put_operand(w, TERM_EMPTY);
        break;
    case NODE_UNKNOWN: // as if it were not there
        builder_warn_left_out(w->b, n, type);
        break;
    case NODE_ASSIGNMENT:
        break;
    }
}

static void leave(struct walk *w)
{
    struct frame f = w->frames[--w->frame_count];
    uint32_t term = fold(w, &f);
    if (term == TERM_NONE)
        term = TERM_EMPTY;
    if (f.aside) {
        scene_show_apart(&w->b->scene, term);
        return;
    }
    mark(w, f.node, term);
    if (f.render == RENDER_NODE)
        scene_rendered(&w->b->scene, term);
    put_operand(w, term);
}

const struct csg_node *builder_root(struct builder *b)
{
    struct csg_iterator it = {0};
    const struct csg_node *n, *root = NULL;
    csg_enter(&it, b->tree->first);
    while ((n = csg_next(&it))) {
        if (n->modifiers & CSG_DISABLE)
            continue;
        if ((n->modifiers & CSG_ROOT) && root) {
            builder_warn(b, n, "another object is marked with '!' before; it is the root");
            break;
        }
        if (n->modifiers & CSG_ROOT)
            root = n;
        csg_enter(&it, n->child);
    }
    csg_iterator_free(&it);
    return root;
}

void builder_walk(struct builder *b)
{
    struct walk w = {.b = b};
    array_reserve(&w.matrices, &w.matrix_room, 1);
    array_reserve(&w.colours, &w.colour_room, 1);
    array_reserve(&w.details, &w.detail_room, 1);
    w.matrices[0] = AFFINE_IDENTITY;
    w.colours[0] = (struct colour){{-1, -1, -1, -1}};
    w.details[0] = DETAIL_DEFAULT;

    const struct csg_node *root = builder_root(b);
    push_frame(&w, (struct frame){.next = b->tree->first, .operation = TERM_UNION});
    if (root) {
        w.frames[0].next = NULL;
        visit(&w, root);
    }
    while (!builder_cancelled(b)) {
        struct frame *f = &w.frames[w.frame_count - 1];
        const struct csg_node *n = f->next;
        if (n) {
            f->next = n->next;
            visit(&w, n);
        } else if (f->node)
            leave(&w);
        else
            break;
    }
    scene_finish(&b->scene, builder_cancelled(b) ? TERM_NONE : fold(&w, &w.frames[0]));
    free(w.frames);
    free(w.operands);
    free(w.matrices);
    free(w.colours);
    free(w.details);
}
