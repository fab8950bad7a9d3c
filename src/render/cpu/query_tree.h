// query_tree.h - the expression as far as one tile needs it: what interval queries walk over.
#pragma once
#include "render/cpu/query.h"

#include <float.h>

#define NEVER    FLT_MAX
#define NO_REF   UINT32_MAX
#define LEAF_BIT 0x80000000u // in a reference: index of a tile leaf; else of a query node

// Where a node can be solid: keys and pixels.
struct extent {
    float near, far, x0, y0, x1, y1;
};

struct query_node { // a node of the expression, as far as the tile needs it
    enum expr_op op;
    uint32_t expr; // node number
    uint32_t minus;
    uint32_t first_link, last_link; // children while they are collected
    uint32_t first, count;          // children in query.kids afterwards, front to back
    struct extent extent;
    uint32_t block;              // number of the block for which the next two hold
    uint32_t found, found_count; // children that may be in the block, in query.found
};

struct query_link {
    uint32_t ref, next;
};

struct query_part {
    uint32_t root;         // NO_REF: nothing of it can show in the tile
    uint32_t first, count; // its leaves in tile.leaves
    struct extent extent;
    bool query;
};

// A crossing that a ray met; the owner as in struct rays_at.
struct crossed {
    float key;
    int32_t owner;
};

// Crossings at one place. Should the surface of the ray be there, whose is it?
enum tie_kind {
    TIE_EITHER, // the first makes it, and the last would alone
    TIE_BOTH,   // it takes both
    TIE_CROWD,  // depends on all that meet there
};
struct query_tie {
    int ray;
    enum tie_kind kind;
    struct crossed first, last;
};

struct query {
    struct tile *t;
    struct query_node *nodes;
    uint32_t node_count, node_capacity;
    struct query_link *links;
    uint32_t link_count, link_capacity;
    uint32_t *kids;
    float *kid_rects; // x0, y0, x1, y1 of eight children after each other
    uint32_t kid_count, kid_capacity, rect_capacity;
    uint32_t *found; // children that may be in the current block
    uint32_t found_count, found_capacity;
    uint32_t block; // counts blocks
    struct query_part *parts;
    uint32_t part_count, part_capacity;
    uint32_t *node_of;                // per node of the expression: its query node in this tile
    const struct mesh_interval *lane; // intervals of one leaf on one ray
    uint32_t lane_count;
    struct mesh_interval *copy; // of a mesh in the block
    uint32_t copy_capacity;
    struct query_tie *ties; // of the block
    uint32_t tie_count, tie_capacity;
    uint64_t tied;    // rays that have any, a bit each
    uint64_t crowded; // rays that had more than there is room for
    float reach;      // the largest band of the leaves that were asked in the block
    v8f limit[BLOCK]; // nothing beyond these keys matters
};

static inline struct extent extent_of(const struct query *q, uint32_t ref)
{
    if (!(ref & LEAF_BIT))
        return q->nodes[ref].extent;
    const struct tile_leaf *l = &q->t->leaves[ref & ~LEAF_BIT];
    return (struct extent){l->near, l->far, l->x0, l->y0, l->x1, l->y1};
}

// Can none of it be in the current block?
static inline bool misses_block(const struct query *q, uint32_t ref)
{
    if (ref & LEAF_BIT)
        return false; // tile_crossings looks for itself
    const struct extent *e = &q->nodes[ref].extent;
    float x = (float)q->t->bx, y = (float)q->t->by;
    return e->x1 < x || e->x0 > x + (BLOCK - 1) || e->y1 < y || e->y0 > y + (BLOCK - 1);
}

#define query_find_kids ISA_PASTE(query_find_kids, ISA)

// Finds the children of a node that may be in the current block, once a block.
void query_find_kids(struct query *q, struct query_node *n);
