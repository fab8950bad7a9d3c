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
    const struct expr *e = &body->expr;
    size_t nodes = e->node_count ? e->node_count : 1, room = room_for(nodes), truth = room / 32;
    uint32_t *words = mem_zalloc((truth + 2 * nodes) * sizeof *words);
    words[truth] = NODE_INNER; // of the empty set
    for (uint32_t i = 0; i < e->node_count; i++) {
        const struct expr_node *n = &e->nodes[i];
        words[i / 32] |= (uint32_t)(n->op == EXPR_INTERSECTION) << i % 32;
        words[truth + 2 * i] = n->op == EXPR_LEAF ? n->leaf : NODE_INNER;
        words[truth + 2 * i + 1] = join_of(e, i);
    }
    size_t size = (truth + 2 * nodes) * sizeof *words;
    bool fine = gl_buffer_fit(&a->nodes, memory, "nodes", size, err);
    if (fine)
        gl_buffer_write(&a->nodes, 0, words, size);
    free(words);
    snprintf(a->defines, sizeof a->defines, "ARRAY LEAVES=%zu NODES=%zu",
             room_for(body->leaf_count), room);
    return fine;
}
