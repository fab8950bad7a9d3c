// share.c - finds the leaves that can share one value.
#include "hcsg/share.h"

#include "base/mem.h"
#include "hcsg/values.h"

#include <stdlib.h>
#include <string.h>

enum { VALUE_SEED = 0x48435347 };

// The node whose value a leaf can share with its siblings, or the leaf's own node.
static uint32_t shared_node(const struct expr *e, uint32_t leaf_node, const bool *convex,
                            bool share)
{
    const struct expr_node *n = &e->nodes[leaf_node];
    if (!share || n->parent == EXPR_NONE)
        return leaf_node;
    const struct expr_node *p = &e->nodes[n->parent];
    if (p->op == EXPR_UNION)
        return n->parent;
    return p->minus != leaf_node && convex[n->leaf] ? n->parent : leaf_node;
}

// Classes are numbered in the order of their nodes: evaluate.h relies on it.
void sharing_build(struct sharing *out, const struct expr *e, const bool *convex, bool share)
{
    *out = (struct sharing){0};
    out->class_of_leaf = mem_alloc(e->leaf_count * sizeof *out->class_of_leaf);
    memset(out->class_of_leaf, 0xff, e->leaf_count * sizeof *out->class_of_leaf);
    uint32_t *members = mem_zalloc(e->node_count * sizeof *members);
    for (uint32_t i = 0; i < e->node_count; i++)
        if (e->nodes[i].op == EXPR_LEAF)
            members[shared_node(e, i, convex, share)]++;
    for (uint32_t i = 0; i < e->node_count; i++)
        if (e->nodes[i].op == EXPR_LEAF) {
            uint32_t node = shared_node(e, i, convex, share);
            if (node != i && members[node] == 1) {
                members[node] = 0;
                members[i] = 1;
            }
        }

    uint32_t *class_of_node = mem_alloc(e->node_count * sizeof *class_of_node);
    for (uint32_t i = 0; i < e->node_count; i++)
        out->class_count += members[i] > 0;
    out->classes = mem_alloc(out->class_count * sizeof *out->classes);
    uint32_t next = 0;
    for (uint32_t i = 0; i < e->node_count; i++) {
        if (members[i] == 0)
            continue;
        bool all = e->nodes[i].op == EXPR_INTERSECTION;
        class_of_node[i] = next;
        out->classes[next++] = (struct value_class){
            .rule = all ? CLASS_ALL : CLASS_ANY, .node = i, .members = members[i]};
    }
    for (uint32_t i = 0; i < e->node_count; i++)
        if (e->nodes[i].op == EXPR_LEAF) {
            uint32_t node = members[i] ? i : shared_node(e, i, convex, share);
            out->class_of_leaf[e->nodes[i].leaf] = class_of_node[node];
        }
    values_fill(out->classes, out->class_count, VALUE_SEED);
    free(members);
    free(class_of_node);
}

enum { MIXED = EXPR_NONE - 1 }; // of several classes

static void note(uint32_t *noted, uint32_t class_id)
{
    if (*noted == EXPR_NONE)
        *noted = class_id;
    else if (*noted != class_id)
        *noted = MIXED;
}

void sharing_inherit(struct sharing *s, uint32_t leaf_count, const struct sharing *before,
                     const uint32_t *counterpart, uint32_t *image)
{
    uint32_t *origin = mem_alloc((size_t)s->class_count * sizeof *origin);
    memset(origin, 0xff, s->class_count * sizeof *origin);
    memset(image, 0xff, before->class_count * sizeof *image);
    for (uint32_t i = 0; i < leaf_count; i++) {
        uint32_t now = s->class_of_leaf[i];
        uint32_t then =
            counterpart[i] == EXPR_NONE ? EXPR_NONE : before->class_of_leaf[counterpart[i]];
        if (now == EXPR_NONE || then == EXPR_NONE)
            continue;
        note(&origin[now], then);
        note(&image[then], now);
    }
    for (uint32_t i = 0; i < s->class_count; i++)
        s->classes[i].value = 0;
    for (uint32_t i = 0; i < before->class_count; i++) {
        if (image[i] >= MIXED || origin[image[i]] != i)
            image[i] = EXPR_NONE;
        else
            s->classes[image[i]].value = before->classes[i].value;
    }
    values_fill_rest(s->classes, s->class_count, VALUE_SEED);
    free(origin);
}

bool sharing_equal(const struct sharing *s, const struct expr *e, const struct sharing *other,
                   const struct expr *other_e)
{
    bool equal = s->class_count == other->class_count && e->node_count == other_e->node_count &&
                 e->kid_count == other_e->kid_count && e->root == other_e->root;
    for (uint32_t i = 0; equal && i < s->class_count; i++) {
        const struct value_class *a = &s->classes[i], *b = &other->classes[i];
        equal = a->rule == b->rule && a->node == b->node && a->members == b->members;
    }
    for (uint32_t i = 0; equal && i < e->node_count; i++) {
        const struct expr_node *a = &e->nodes[i], *b = &other_e->nodes[i];
        equal = a->op == b->op && a->parent == b->parent && a->count == b->count &&
                a->minus == b->minus;
    }
    return equal;
}

// Of the operands of each operator those are left that are not members of a class that has been.
void sharing_expr(struct expr *out, const struct expr *e, const struct sharing *s)
{
    struct expr_token *tokens = mem_alloc((2 * (size_t)e->node_count + 1) * sizeof *tokens);
    bool *seen = mem_zalloc(s->class_count + 1), *left = mem_alloc(e->node_count + 1);
    size_t count = e->node_count ? expr_postfix(tokens, e, e->root, NULL) : 0, kept = 0, depth = 0;
    for (size_t i = 0; i < count; i++) {
        struct expr_token t = tokens[i];
        bool stays = true;
        if (t.op == EXPR_LEAF) {
            t.arg = s->class_of_leaf[t.arg];
            stays = !seen[t.arg];
            seen[t.arg] = true;
        } else {
            depth -= t.arg;
            uint32_t operands = 0;
            for (uint32_t k = 0; k < t.arg; k++)
                operands += left[depth + k];
            t.arg = operands;
        }
        left[depth++] = stays;
        if (stays)
            tokens[kept++] = t;
    }
    expr_build(out, tokens, kept, s->class_count);
    free(tokens);
    free(seen);
    free(left);
}

void sharing_free(struct sharing *s)
{
    free(s->class_of_leaf);
    free(s->classes);
    *s = (struct sharing){0};
}
