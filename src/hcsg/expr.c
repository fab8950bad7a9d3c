// expr.c - brings a CSG expression into normal form.
//
// Works in two passes over explicit stacks. The first reads the postfix tokens and keeps the
// operands of every open node in linked lists, so that merging a nested node into its parent is
// O(1). The second writes what is left in postorder.
#include "hcsg/expr.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

struct list { // of parts, linked by part.next
    uint32_t first, last, count;
};

#define LIST_EMPTY ((struct list){EXPR_NONE, EXPR_NONE, 0})

struct part {
    enum expr_op op;
    uint32_t next;
    union {
        uint32_t leaf;    // LEAF
        struct list kids; // UNION, INTERSECTION
    };
    struct list minus; // INTERSECTION; never holds a union
};

struct builder {
    struct part *parts;
    uint32_t part_count, part_capacity;
    uint32_t *stack; // of operands: parts, or EXPR_NONE for the empty set
    uint32_t depth, stack_capacity;
};

static uint32_t part_new(struct builder *b, enum expr_op op)
{
    array_reserve(&b->parts, &b->part_capacity, (size_t)b->part_count + 1);
    b->parts[b->part_count] =
        (struct part){.op = op, .next = EXPR_NONE, .kids = LIST_EMPTY, .minus = LIST_EMPTY};
    return b->part_count++;
}

static void list_join(struct part *parts, struct list *into, struct list l)
{
    if (l.count == 0)
        return;
    if (into->count == 0)
        into->first = l.first;
    else
        parts[into->last].next = l.first;
    into->last = l.last;
    into->count += l.count;
}

static void list_add(struct part *parts, struct list *into, uint32_t p)
{
    parts[p].next = EXPR_NONE;
    list_join(parts, into, (struct list){p, p, 1});
}

// Adds a part, or the children of it when it is a union.
static void list_add_union(struct part *parts, struct list *into, uint32_t p)
{
    if (parts[p].op == EXPR_UNION)
        list_join(parts, into, parts[p].kids);
    else
        list_add(parts, into, p);
}

static uint32_t make_union(struct builder *b, const uint32_t *operands, uint32_t count)
{
    uint32_t only = EXPR_NONE, present = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (operands[i] == EXPR_NONE)
            continue;
        only = operands[i];
        present++;
    }
    if (present <= 1)
        return only;
    struct list kids = LIST_EMPTY;
    for (uint32_t i = 0; i < count; i++)
        if (operands[i] != EXPR_NONE)
            list_add_union(b->parts, &kids, operands[i]);
    uint32_t p = part_new(b, EXPR_UNION);
    b->parts[p].kids = kids;
    return p;
}

static uint32_t make_intersection(struct builder *b, const uint32_t *operands, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (operands[i] == EXPR_NONE)
            return EXPR_NONE;
    if (count <= 1)
        return count ? operands[0] : EXPR_NONE;
    struct list kids = LIST_EMPTY, minus = LIST_EMPTY;
    for (uint32_t i = 0; i < count; i++) {
        struct part *operand = &b->parts[operands[i]];
        if (operand->op == EXPR_INTERSECTION) {
            list_join(b->parts, &kids, operand->kids);
            list_join(b->parts, &minus, operand->minus);
        } else {
            list_add(b->parts, &kids, operands[i]);
        }
    }
    uint32_t p = part_new(b, EXPR_INTERSECTION);
    b->parts[p].kids = kids;
    b->parts[p].minus = minus;
    return p;
}

static uint32_t make_difference(struct builder *b, const uint32_t *operands, uint32_t count)
{
    if (count == 0 || operands[0] == EXPR_NONE)
        return EXPR_NONE;
    struct list minus = LIST_EMPTY;
    for (uint32_t i = 1; i < count; i++)
        if (operands[i] != EXPR_NONE)
            list_add_union(b->parts, &minus, operands[i]);
    uint32_t p = operands[0];
    if (minus.count == 0)
        return p;
    if (b->parts[p].op != EXPR_INTERSECTION) {
        p = part_new(b, EXPR_INTERSECTION);
        list_add(b->parts, &b->parts[p].kids, operands[0]);
    }
    list_join(b->parts, &b->parts[p].minus, minus);
    return p;
}

static uint32_t read_postfix(struct builder *b, const struct expr_token *postfix, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct expr_token t = postfix[i];
        uint32_t p = EXPR_NONE;
        if (t.op == EXPR_LEAF) {
            p = part_new(b, EXPR_LEAF);
            b->parts[p].leaf = t.arg;
        } else {
            b->depth -= t.arg;
            const uint32_t *operands = t.arg ? b->stack + b->depth : NULL;
            if (t.op == EXPR_UNION)
                p = make_union(b, operands, t.arg);
            else if (t.op == EXPR_INTERSECTION)
                p = make_intersection(b, operands, t.arg);
            else
                p = make_difference(b, operands, t.arg);
        }
        array_reserve(&b->stack, &b->stack_capacity, (size_t)b->depth + 1);
        b->stack[b->depth++] = p;
    }
    return count ? b->stack[0] : EXPR_NONE;
}

struct frame { // a part whose children are being written
    uint32_t part, next;
    uint32_t first, done; // its range in kids
    uint32_t minus;
};

struct writer {
    struct builder *b;
    struct expr *out;
    struct frame *frames;
    uint32_t depth, frame_capacity;
    uint32_t node_capacity, kid_capacity;
};

static void write_open(struct writer *w, uint32_t p)
{
    struct part *part = &w->b->parts[p];
    array_reserve(&w->frames, &w->frame_capacity, (size_t)w->depth + 1);
    struct frame *f = &w->frames[w->depth++];
    *f = (struct frame){.part = p, .next = EXPR_NONE, .minus = EXPR_NONE};
    if (part->op == EXPR_LEAF)
        return;
    f->next = part->kids.first;
    f->first = w->out->kid_count;
    w->out->kid_count += part->kids.count;
    array_reserve(&w->out->kids, &w->kid_capacity, w->out->kid_count);
}

// The next child of the newest frame, EXPR_NONE when all are written.
static uint32_t write_next(struct writer *w)
{
    struct frame *f = &w->frames[w->depth - 1];
    if (f->next != EXPR_NONE) {
        uint32_t p = f->next;
        f->next = w->b->parts[p].next;
        return p;
    }
    struct list minus = w->b->parts[f->part].minus;
    if (minus.count == 0 || f->minus != EXPR_NONE)
        return EXPR_NONE;
    if (minus.count == 1)
        return minus.first;
    uint32_t p = part_new(w->b, EXPR_UNION);
    w->b->parts[p].kids = minus;
    return p;
}

static void write_close(struct writer *w)
{
    struct expr *out = w->out;
    struct frame f = w->frames[--w->depth];
    const struct part *part = &w->b->parts[f.part];
    uint32_t n = out->node_count++;
    array_reserve(&out->nodes, &w->node_capacity, out->node_count);
    struct expr_node *node = &out->nodes[n];
    *node = (struct expr_node){.op = part->op,
                               .parent = EXPR_NONE,
                               .first = f.first,
                               .count = f.done,
                               .minus = f.minus,
                               .leaf = EXPR_NONE};
    if (part->op == EXPR_LEAF) {
        node->leaf = part->leaf;
        out->leaf_node[part->leaf] = n;
    }
    for (uint32_t i = 0; i < f.done; i++)
        out->nodes[out->kids[f.first + i]].parent = n;
    if (f.minus != EXPR_NONE)
        out->nodes[f.minus].parent = n;
    if (w->depth == 0)
        return;
    struct frame *above = &w->frames[w->depth - 1];
    if (above->done < w->b->parts[above->part].kids.count)
        out->kids[above->first + above->done++] = n;
    else
        above->minus = n;
}

static void write_postorder(struct builder *b, struct expr *out, uint32_t root)
{
    struct writer w = {.b = b, .out = out};
    write_open(&w, root);
    while (w.depth > 0) {
        uint32_t p = write_next(&w);
        if (p != EXPR_NONE)
            write_open(&w, p);
        else
            write_close(&w);
    }
    out->root = out->node_count - 1;
    free(w.frames);
}

void expr_build(struct expr *out, const struct expr_token *postfix, size_t count,
                uint32_t leaf_count)
{
    *out = (struct expr){.root = EXPR_NONE, .leaf_count = leaf_count};
    out->leaf_node = mem_alloc(leaf_count * sizeof *out->leaf_node);
    memset(out->leaf_node, 0xff, leaf_count * sizeof *out->leaf_node);
    struct builder b = {0};
    uint32_t root = read_postfix(&b, postfix, count);
    if (root != EXPR_NONE)
        write_postorder(&b, out, root);
    free(b.parts);
    free(b.stack);
}

// Whether node i is the last child of an intersection (its subtracted node is none of the
// children).
static bool ends_intersection(const struct expr *e, uint32_t i)
{
    uint32_t p = e->nodes[i].parent;
    if (p == EXPR_NONE || e->nodes[p].op != EXPR_INTERSECTION)
        return false;
    return e->kids[e->nodes[p].first + e->nodes[p].count - 1] == i;
}

uint32_t expr_first(const struct expr *e, uint32_t node)
{
    while (e->nodes[node].op != EXPR_LEAF)
        node = e->kids[e->nodes[node].first];
    return node;
}

size_t expr_postfix(struct expr_token *out, const struct expr *e, uint32_t node,
                    const uint32_t *number_of)
{
    // One token per node, and one more per intersection: after its last child, in front of what it
    // subtracts.
    size_t count = 0;
    for (uint32_t i = expr_first(e, node); i <= node; i++) {
        const struct expr_node *n = &e->nodes[i];
        if (n->op == EXPR_LEAF) {
            uint32_t leaf = number_of ? number_of[n->leaf] : n->leaf;
            out[count++] = leaf != EXPR_NONE ? (struct expr_token){EXPR_LEAF, leaf}
                                             : (struct expr_token){EXPR_UNION, 0};
        } else if (n->op == EXPR_UNION) {
            out[count++] = (struct expr_token){EXPR_UNION, n->count};
        } else if (n->minus != EXPR_NONE) {
            out[count++] = (struct expr_token){EXPR_DIFFERENCE, 2};
        }
        if (i < node && ends_intersection(e, i))
            out[count++] = (struct expr_token){EXPR_INTERSECTION, e->nodes[n->parent].count};
    }
    return count;
}

void expr_without(struct expr *out, const struct expr *e, const bool *keep)
{
    struct expr_token *tokens = mem_alloc((size_t)e->node_count * 2 * sizeof *tokens);
    uint32_t *number = mem_alloc(e->leaf_count * sizeof *number);
    for (uint32_t i = 0; i < e->leaf_count; i++)
        number[i] = keep[i] ? i : EXPR_NONE;
    size_t count = e->node_count ? expr_postfix(tokens, e, e->node_count - 1, number) : 0;
    expr_build(out, tokens, count, e->leaf_count);
    free(tokens);
    free(number);
}

void expr_free(struct expr *e)
{
    free(e->nodes);
    free(e->kids);
    free(e->leaf_node);
    *e = (struct expr){0};
}

bool expr_evaluate(const struct expr *e, const bool *inside)
{
    if (e->node_count == 0)
        return false;
    bool *value = mem_alloc(e->node_count);
    for (uint32_t i = 0; i < e->node_count; i++) {
        const struct expr_node *n = &e->nodes[i];
        if (n->op == EXPR_LEAF) {
            value[i] = inside[n->leaf];
            continue;
        }
        bool all = n->op == EXPR_INTERSECTION;
        bool v = all;
        for (uint32_t k = 0; k < n->count && v == all; k++)
            v = value[e->kids[n->first + k]];
        value[i] = v && !(n->minus != EXPR_NONE && value[n->minus]);
    }
    bool result = value[e->node_count - 1];
    free(value);
    return result;
}
