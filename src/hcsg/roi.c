// roi.c - regions of interest, from boxes up and down the expression.
//
// Why a round is sound: let region(n) be where the value of node n is asked for, with region(root)
// all of space. The children of a union are asked in its region. Those of an intersection, and what
// it subtracts, are asked in its region cut by the boxes of all its children: elsewhere in the
// region some child is empty, and it stays empty when leaves are cut, since the box of a node
// bounds it whatever it subtracts. Hence leaves cut to their regions give the same result, and are
// the leaves of the next round. Bounds of boxes only ever come from bounds of leaves, so rounds
// end; few are needed.
#include "hcsg/roi.h"

#include "base/mem.h"

#include <stdlib.h>

enum { ROUNDS_MOST = 32 };

static struct box overlap(struct box a, struct box b)
{
    struct box r = box_intersection(a, b);
    return box_is_empty(r) ? BOX_EMPTY : r;
}

static bool box_equal(struct box a, struct box b)
{
    return a.min.x == b.min.x && a.min.y == b.min.y && a.min.z == b.min.z && a.max.x == b.max.x &&
           a.max.y == b.max.y && a.max.z == b.max.z;
}

// Boxes of all inner nodes from those of the leaves.
static void boxes_up(struct box *box, const struct expr *e)
{
    for (uint32_t i = 0; i < e->node_count; i++) {
        const struct expr_node *n = &e->nodes[i];
        if (n->op == EXPR_LEAF)
            continue;
        const uint32_t *kids = e->kids + n->first;
        struct box b = box[kids[0]];
        for (uint32_t k = 1; k < n->count; k++)
            b = n->op == EXPR_UNION ? box_union(b, box[kids[k]]) : overlap(b, box[kids[k]]);
        box[i] = b;
    }
}

// Cuts all boxes to the regions, parents first. True when the box of a leaf became smaller.
static bool boxes_down(struct box *box, const struct expr *e)
{
    bool changed = false;
    for (uint32_t i = e->node_count; i-- > 0;) {
        const struct expr_node *n = &e->nodes[i];
        if (n->parent == EXPR_NONE)
            continue;
        // The box of the parent is its region cut by its children: of a union that cuts a child no
        // more than the region alone.
        struct box b = overlap(box[i], box[n->parent]);
        changed |= n->op == EXPR_LEAF && !box_equal(b, box[i]);
        box[i] = b;
    }
    return changed;
}

void roi_build(struct box *roi, const struct expr *e, const struct box *leaf_box)
{
    struct box *box = mem_alloc(e->node_count * sizeof *box);
    for (uint32_t i = 0; i < e->node_count; i++)
        if (e->nodes[i].op == EXPR_LEAF)
            box[i] = overlap(leaf_box[e->nodes[i].leaf], BOX_ALL);
    for (uint32_t round = 0; round < ROUNDS_MOST; round++) {
        boxes_up(box, e);
        if (!boxes_down(box, e))
            break;
    }
    for (uint32_t l = 0; l < e->leaf_count; l++)
        roi[l] = BOX_EMPTY;
    for (uint32_t i = 0; i < e->node_count; i++)
        if (e->nodes[i].op == EXPR_LEAF)
            roi[e->nodes[i].leaf] = box[i];
    free(box);
}
