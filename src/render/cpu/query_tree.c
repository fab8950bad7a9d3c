// query_tree.c - prunes the expression to the leaves of a tile and finds what a block needs of it.
#include "render/cpu/query_tree.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

struct query *query_new(struct tile *t)
{
    struct query *q = mem_aligned(32, sizeof *q); // holds vectors
    *q = (struct query){0};
    uint32_t n = t->room.nodes;
    q->t = t;
    q->node_of = mem_alloc((n + 1) * sizeof *q->node_of);
    for (uint32_t i = 0; i < n; i++)
        q->node_of[i] = NO_REF;
    return q;
}

size_t query_bytes(const struct query *q)
{
    return q->node_capacity * sizeof *q->nodes + q->link_capacity * sizeof *q->links +
           (q->kid_capacity + q->found_capacity) * sizeof *q->kids +
           q->rect_capacity * sizeof *q->kid_rects + q->copy_capacity * sizeof *q->copy +
           q->tie_capacity * sizeof *q->ties + q->part_capacity * sizeof *q->parts +
           q->t->room.nodes * sizeof *q->node_of;
}

void query_delete(struct query *q)
{
    if (!q)
        return;
    free(q->nodes);
    free(q->links);
    free(q->kids);
    free(q->kid_rects);
    free(q->found);
    free(q->copy);
    free(q->ties);
    free(q->parts);
    free(q->node_of);
    free(q);
}

static void add_child(struct query *q, uint32_t parent, uint32_t ref)
{
    array_reserve(&q->links, &q->link_capacity, q->link_count + 1);
    q->links[q->link_count] = (struct query_link){ref, NO_REF};
    struct query_node *n = &q->nodes[parent];
    if (n->first_link == NO_REF)
        n->first_link = q->link_count;
    else
        q->links[n->last_link].next = q->link_count;
    n->last_link = q->link_count++;
}

// Links a leaf to its ancestors up to the part's node, as far as they are not linked yet.
static uint32_t link_leaf(struct query *q, uint32_t index, uint32_t top)
{
    const struct expr *e = &q->t->frame->body->expr;
    uint32_t node = e->leaf_node[q->t->leaves[index].leaf], ref = index | LEAF_BIT;
    while (node != top) {
        uint32_t parent = e->nodes[node].parent, known = q->node_of[parent];
        if (known == NO_REF) {
            array_reserve(&q->nodes, &q->node_capacity, q->node_count + 1);
            known = q->node_count++;
            q->node_of[parent] = known;
            q->nodes[known] = (struct query_node){.op = e->nodes[parent].op,
                                                  .expr = parent,
                                                  .minus = NO_REF,
                                                  .block = q->block,
                                                  .first_link = NO_REF,
                                                  .last_link = NO_REF};
            if (e->nodes[parent].minus == node)
                q->nodes[known].minus = ref;
            else
                add_child(q, known, ref);
            ref = known;
            node = parent;
            continue;
        }
        if (e->nodes[parent].minus == node)
            q->nodes[known].minus = ref;
        else
            add_child(q, known, ref);
        return NO_REF;
    }
    return ref;
}

static float least(float a, float b)
{
    return a < b ? a : b;
}

static float most(float a, float b)
{
    return a > b ? a : b;
}

static struct extent extent_hull(struct extent a, struct extent b)
{
    return (struct extent){least(a.near, b.near), most(a.far, b.far), least(a.x0, b.x0),
                           least(a.y0, b.y0),     most(a.x1, b.x1),   most(a.y1, b.y1)};
}

static struct extent extent_overlap(struct extent a, struct extent b)
{
    return (struct extent){most(a.near, b.near), least(a.far, b.far), most(a.x0, b.x0),
                           most(a.y0, b.y0),     least(a.x1, b.x1),   least(a.y1, b.y1)};
}

static void add_kid(struct query *q, uint32_t ref)
{
    struct extent e = extent_of(q, ref);
    float *rect = q->kid_rects + (q->kid_count & ~7u) * 4 + (q->kid_count & 7);
    rect[0] = e.x0;
    rect[8] = e.y0;
    rect[16] = e.x1;
    rect[24] = e.y1;
    q->kids[q->kid_count++] = ref;
}

void query_find_kids(struct query *q, struct query_node *n)
{
    if (n->block == q->block)
        return;
    float x = (float)q->t->bx, y = (float)q->t->by;
    n->block = q->block;
    n->found = q->found_count;
    array_reserve(&q->found, &q->found_capacity, q->found_count + n->count);
    for (uint32_t i = 0; i < n->count; i += 8) {
        const float *rect = q->kid_rects + (n->first + i) * 4;
        v8f x0, y0, x1, y1;
        memcpy(&x0, rect, sizeof x0);
        memcpy(&y0, rect + 8, sizeof y0);
        memcpy(&x1, rect + 16, sizeof x1);
        memcpy(&y1, rect + 24, sizeof y1);
        int bits = v8_bits((x1 >= v8_set(x)) & (x0 <= v8_set(x + (BLOCK - 1))) & (y1 >= v8_set(y)) &
                           (y0 <= v8_set(y + (BLOCK - 1))));
        if (n->count - i < 8)
            bits &= (1 << (n->count - i)) - 1;
        for (; bits; bits &= bits - 1)
            q->found[q->found_count++] =
                q->kids[n->first + i + (uint32_t)__builtin_ctz((unsigned)bits)];
    }
    n->found_count = q->found_count - n->found;
}

// Drops what cannot be solid here; returns what is left of the node. Depth is bounded by frame.c.
static uint32_t prune(struct query *q, uint32_t ref)
{
    if (ref == NO_REF)
        return NO_REF;
    if (ref & LEAF_BIT)
        return q->t->leaves[ref & ~LEAF_BIT].state == LEAF_ABSENT ? NO_REF : ref;
    uint32_t needed = q->t->frame->body->expr.nodes[q->nodes[ref].expr].count;
    bool any = q->nodes[ref].op == EXPR_UNION;
    uint32_t kept = 0, last = NO_REF;
    struct extent extent = {0};

    for (uint32_t l = q->nodes[ref].first_link; l != NO_REF; l = q->links[l].next) {
        uint32_t kid = prune(q, q->links[l].ref);
        q->links[l].ref = kid;
        if (kid == NO_REF)
            continue;
        struct extent e = extent_of(q, kid);
        extent = !kept ? e : any ? extent_hull(extent, e) : extent_overlap(extent, e);
        kept++;
        last = kid;
    }
    if (!kept || (!any && (kept < needed || extent.near > extent.far)))
        return NO_REF;
    uint32_t minus = prune(q, q->nodes[ref].minus);
    if (kept == 1 && minus == NO_REF)
        return last;
    uint32_t first = (q->kid_count + 7) & ~7u; // so that rectangles are looked at by eights
    q->kid_count = first;
    array_reserve(&q->kids, &q->kid_capacity, first + kept);
    array_reserve(&q->kid_rects, &q->rect_capacity, (first + kept + 8) * 4);
    for (uint32_t l = q->nodes[ref].first_link; l != NO_REF; l = q->links[l].next)
        if (q->links[l].ref != NO_REF)
            add_kid(q, q->links[l].ref);
    struct query_node *n = &q->nodes[ref];
    n->first = first;
    n->count = kept;
    n->minus = minus;
    n->extent = extent;
    return ref;
}

static int by_near(const void *a, const void *b)
{
    const struct query_part *p = a, *q = b;
    if (p->extent.near != q->extent.near)
        return p->extent.near < q->extent.near ? -1 : 1;
    return p->first < q->first ? -1 : p->first > q->first;
}

// Leaves of few planes are cheap to look at for the whole tile: it tells where they begin in it.
static void prepare_small(struct tile *t)
{
    enum { SMALL = 16 };
    if (!t->leaf_count || t->leaves[0].part == t->leaves[t->leaf_count - 1].part)
        return; // one part: nothing to put in order
    for (uint32_t i = 0; i < t->leaf_count; i++) {
        const struct solid *s = t->frame->body->leaves[t->leaves[i].leaf].solid;
        if (s->convex && s->planes.padded <= SMALL &&
            t->planes.size - t->planes.used > t->planes.size / 2)
            tile_prepare(t, &t->leaves[i]);
    }
}

void query_enter(struct query *q)
{
    struct tile *t = q->t;
    prepare_small(t);
    q->node_count = q->link_count = q->kid_count = q->part_count = 0;
    for (uint32_t i = 0, end; i < t->leaf_count; i = end) {
        const struct frame_part *fp = &t->frame->parts[t->leaves[i].part];
        struct query_part p = {.root = NO_REF, .first = i, .query = fp->query};
        for (end = i; end < t->leaf_count && t->leaves[end].part == t->leaves[i].part; end++)
            p.extent = end == i ? extent_of(q, end | LEAF_BIT)
                                : extent_hull(p.extent, extent_of(q, end | LEAF_BIT));
        p.count = end - i;
        if (p.query) {
            uint32_t begun = q->node_count, top = NO_REF;
            for (uint32_t k = i; k < end; k++) {
                uint32_t ref = link_leaf(q, k, fp->node);
                top = ref != NO_REF ? ref : top;
            }
            for (uint32_t n = begun; n < q->node_count; n++)
                q->node_of[q->nodes[n].expr] = NO_REF;
            p.root = prune(q, top);
            if (p.root == NO_REF)
                continue;
            p.extent = extent_of(q, p.root);
        }
        array_reserve(&q->parts, &q->part_capacity, q->part_count + 1);
        q->parts[q->part_count++] = p;
    }
    if (q->part_count)
        qsort(q->parts, q->part_count, sizeof *q->parts, by_near);
}
