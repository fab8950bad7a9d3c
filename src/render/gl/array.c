// array.c - the expression of a body for the array method, which the bench compares with.
#include "render/gl/array.h"

#include "base/mem.h"
#include "shaders/shared.h"

#include <stdio.h>
#include <stdlib.h>

// How a node changes what its parent is.
static uint32_t join_of(const struct expr *e, uint32_t node)
{
    uint32_t parent = e->nodes[node].parent;
    if (parent == EXPR_NONE)
        return NODE_ROOT;
    const struct expr_node *p = &e->nodes[parent];
    return parent << 2 | (p->op == EXPR_UNION ? NODE_ADDS
                          : p->minus == node  ? NODE_CUTS
                                              : NODE_LIMITS);
}

// So that few shaders do for all bodies.
static size_t room_for(size_t count)
{
    size_t room = 64;
    while (room < count)
        room *= 2;
    return room;
}

bool gl_array_upload(struct gl_array *a, struct gl_memory *memory, const struct body *body,
                     struct error *err)
{
    const struct sharing *s = &body->sharing;
    struct expr e;
    sharing_expr(&e, &body->expr, s);
    size_t nodes = e.node_count, room = room_for(nodes), truth = room / 32;
    size_t size = (truth + 1 + NODE_WORDS * nodes + body->leaf_count) * sizeof(uint32_t);
    uint32_t *words = mem_zalloc(size), *to = words + truth;
    *to++ = e.node_count;
    for (uint32_t i = 0; i < e.node_count; i++) {
        const struct expr_node *n = &e.nodes[i];
        const struct value_class *c = n->op == EXPR_LEAF ? &s->classes[n->leaf] : NULL;
        words[i / 32] |= (uint32_t)(n->op == EXPR_INTERSECTION) << i % 32;
        *to++ = c ? n->leaf : NODE_INNER;
        *to++ = c && c->rule == CLASS_ALL ? c->members : 0;
        *to++ = join_of(&e, i);
    }
    for (uint32_t i = 0; i < body->leaf_count; i++) // dropped ones are never crossed
        *to++ = s->class_of_leaf[i];
    expr_free(&e);
    bool fine = gl_buffer_fit(&a->nodes, memory, "nodes", size, err);
    if (fine)
        gl_buffer_write(&a->nodes, 0, words, size);
    free(words);
    snprintf(a->defines, sizeof a->defines, "ARRAY VALUES=%zu NODES=%zu", room_for(s->class_count),
             room);
    return fine;
}
