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

void sharing_free(struct sharing *s)
{
    free(s->class_of_leaf);
    free(s->classes);
    *s = (struct sharing){0};
}
