// query.c - first surfaces by interval queries, a block of rays at a time.
#include "render/cpu/query.h"

#include "base/mem.h"
#include "render/cpu/walk.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

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
    v8f limit[BLOCK]; // nothing beyond these keys matters
};

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
           q->part_capacity * sizeof *q->parts + q->t->room.nodes * sizeof *q->node_of;
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
    free(q->parts);
    free(q->node_of);
    free(q);
}

// ---------------------------------------------------------------- pruning

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

static struct extent extent_of(const struct query *q, uint32_t ref)
{
    if (!(ref & LEAF_BIT))
        return q->nodes[ref].extent;
    const struct tile_leaf *l = &q->t->leaves[ref & ~LEAF_BIT];
    return (struct extent){l->near, l->far, l->x0, l->y0, l->x1, l->y1};
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

// Can none of it be in the current block?
static bool misses_block(const struct query *q, uint32_t ref)
{
    if (ref & LEAF_BIT)
        return false; // tile_crossings looks for itself
    const struct extent *e = &q->nodes[ref].extent;
    float x = (float)q->t->bx, y = (float)q->t->by;
    return e->x1 < x || e->x0 > x + (BLOCK - 1) || e->y1 < y || e->y0 > y + (BLOCK - 1);
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

// Finds the children of a node that may be in the current block, once a block.
static void find_kids(struct query *q, struct query_node *n)
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

// ---------------------------------------------------------------- rays of a block

static float highest(const v8f *key) // of the rays that still have something ahead
{
    v8f m = v8_set(-NEVER);
    for (int y = 0; y < BLOCK; y++)
        m = v8_max(m, v8_select(key[y] < v8_set(NEVER), key[y], v8_set(-NEVER)));
    return v8_highest(m);
}

static float lowest(const v8f *key)
{
    v8f m = v8_set(NEVER);
    for (int y = 0; y < BLOCK; y++)
        m = v8_min(m, key[y]);
    return v8_lowest(m);
}

// The file's order decides between surfaces at one place.
static bool later(const struct query *q, int32_t owner, int32_t than)
{
    if (owner < 0 || than < 0)
        return owner >= 0;
    return q->t->leaves[owner >> 1].leaf > q->t->leaves[than >> 1].leaf;
}

static float steep_of(struct query *q, int32_t owner, int ray, float key)
{
    float steep = 1; // of the plane where the ray begins
    if (owner >= 0)
        tile_face(q->t, &q->t->leaves[owner >> 1], ray, owner & 1, key, &steep);
    return steep;
}

// Is the interval between key `a` at the face of `owner_a` and key `b` at that of `owner_b` too
// thin to exist?
static bool thin(struct query *q, int ray, float a, int32_t owner_a, float b, int32_t owner_b,
                 float band)
{
    if (b - a > band)
        return false;
    if (a >= b)
        return true;
    float steep = fmaxf(steep_of(q, owner_a, ray, a), steep_of(q, owner_b, ray, b));
    return tile_thickness(q->t, a, b, steep) < q->t->frame->settings->epsilon;
}

// One ray moves to where it is next inside the leaf, with the filter.
static void ray_in(struct query *q, int ray, float band, int32_t id, float *key, int32_t *owner)
{
    float c = *key;
    for (uint32_t i = 0; i < q->lane_count; i++) {
        float e = q->lane[i].enter, x = q->lane[i].leave;
        if (!(x > c))
            continue;
        if (thin(q, ray, e > c ? e : c, e > c ? id : *owner, x, id | 1, band))
            continue;
        if (e > c) {
            if (!(e - c <= band && *owner >= 0 && later(q, *owner, id) &&
                  thin(q, ray, c, *owner, e, id, band)))
                *owner = id;
            *key = e;
        } else if (c - e <= band && *owner >= 0 && later(q, id, *owner) &&
                   thin(q, ray, e, id, c, *owner, band)) {
            *owner = id;
        }
        return;
    }
    *key = NEVER;
}

// One ray moves to where it is next outside of the leaf.
static void ray_out(struct query *q, int ray, float band, int32_t id, float *key, int32_t *owner)
{
    for (uint32_t i = 0; i < q->lane_count; i++) {
        float e = q->lane[i].enter, x = q->lane[i].leave, c = *key;
        if (x > c && (e <= c || thin(q, ray, c, *owner, e, id, band))) {
            bool same = x - c <= band && *owner >= 0 && later(q, *owner, id | 1) &&
                        thin(q, ray, c, *owner, x, id | 1, band);
            *key = x;
            *owner = same ? *owner : (id | 1);
        } else if (x <= c && c - x <= band && *owner >= 0 && (*owner & 1) && later(q, id, *owner) &&
                   thin(q, ray, x, id | 1, c, *owner, band)) {
            *owner = id | 1;
        }
    }
}

static uint64_t block_bits(const v8i *mask) // bit i: ray i
{
    uint64_t bits = 0;
    for (int y = 0; y < BLOCK; y++)
        bits |= (uint64_t)(unsigned)v8_bits(mask[y]) << (y * BLOCK);
    return bits;
}

static bool kill(struct rays_at *s)
{
    bool changed = lowest(s->key) < NEVER;
    for (int y = 0; y < BLOCK; y++)
        s->key[y] = v8_set(NEVER);
    return changed;
}

// Moves the rays in `rays` (a bit each) one at a time, from where they are in `from`, and writes
// them to `s`. Works on copies of the crossings, since asking for faces may forget those of the
// block.
static void move_rays(struct query *q, const struct block_leaf *b, int32_t id, bool out,
                      uint64_t rays, const struct rays_at *from, struct rays_at *s)
{
    struct mesh_interval ends[BLOCK_PIXELS];
    uint32_t first[BLOCK_PIXELS + 1];
    float band = b->band;
    bool mesh = b->mesh;
    if (mesh) {
        uint32_t n = b->first[BLOCK_PIXELS];
        array_reserve(&q->copy, &q->copy_capacity, n + 1);
        memcpy(q->copy, q->t->mesh.intervals + b->interval, n * sizeof *q->copy);
        memcpy(first, b->first, sizeof first);
    } else {
        for (uint64_t left = rays; left; left &= left - 1) {
            int i = __builtin_ctzll(left);
            ends[i] = (struct mesh_interval){.enter = b->enter[i], .leave = b->leave[i]};
        }
    }
    for (; rays; rays &= rays - 1) {
        int i = __builtin_ctzll(rays), y = i / BLOCK, x = i % BLOCK;
        float key = from->key[y][x];
        int32_t owner = from->owner[y][x];
        q->lane = mesh ? q->copy + first[i] : &ends[i];
        q->lane_count = mesh ? first[i + 1] - first[i] : 1;
        if (key < NEVER)
            (out ? ray_out : ray_in)(q, i, band, id, &key, &owner);
        s->key[y][x] = key;
        s->owner[y][x] = owner;
    }
}

static bool differs(const struct rays_at *a, const struct rays_at *b)
{
    v8i d = v8_seti(0);
    for (int y = 0; y < BLOCK; y++)
        d |= a->key[y] != b->key[y];
    return v8_bits(d);
}

static bool leaf_in(struct query *q, uint32_t index, struct rays_at *s)
{
    const struct block_leaf *b = tile_crossings(q->t, &q->t->leaves[index]);
    int32_t id = (int32_t)(index << 1);
    if (!b)
        return kill(s);
    struct rays_at moved;
    uint64_t close = UINT64_MAX;
    if (!b->mesh) {
        const v8f *enter = (const v8f *)b->enter, *leave = (const v8f *)b->leave;
        v8f band = v8_set(b->band), never = v8_set(NEVER);
        v8i any = v8_seti(0), near[BLOCK];
        for (int y = 0; y < BLOCK; y++) {
            v8f c = s->key[y], e = enter[y], x = leave[y], m = v8_max(c, e);
            v8i in = x > c, other = s->owner[y] != v8_seti(id);
            near[y] = ((x - m <= band) & in) | ((v8_abs(e - c) <= band) & other & (c < never));
            any |= near[y];
            moved.key[y] = v8_select(in, m, never);
            moved.owner[y] = v8_selecti((e > c) & in, v8_seti(id), s->owner[y]);
        }
        close = v8_bits(any) ? block_bits(near) : 0;
    }
    if (close)
        move_rays(q, b, id, false, close, s, &moved);
    bool changed = differs(&moved, s);
    *s = moved;
    return changed;
}

static bool leaf_out(struct query *q, uint32_t index, float high, struct rays_at *s)
{
    const struct block_leaf *b = tile_crossings(q->t, &q->t->leaves[index]);
    int32_t id = (int32_t)(index << 1);
    if (!b || b->near - b->band > high)
        return false;
    struct rays_at moved;
    uint64_t close = UINT64_MAX;
    if (!b->mesh) {
        const v8f *enter = (const v8f *)b->enter, *leave = (const v8f *)b->leave;
        v8f band = v8_set(b->band);
        v8i any = v8_seti(0), inside_any = v8_seti(0), near[BLOCK];
        for (int y = 0; y < BLOCK; y++) {
            v8f c = s->key[y], e = enter[y], x = leave[y];
            v8i inside = (e <= c) & (x > c), other = s->owner[y] != v8_seti(id | 1);
            near[y] = ((v8_abs(e - c) <= band) | (v8_abs(x - c) <= band)) & other;
            any |= near[y];
            inside_any |= inside;
            moved.key[y] = v8_select(inside, x, c);
            moved.owner[y] = v8_selecti(inside, v8_seti(id | 1), s->owner[y]);
        }
        close = v8_bits(any) ? block_bits(near) : 0;
        if (!close && !v8_bits(inside_any))
            return false;
    }
    if (close)
        move_rays(q, b, id, true, close, s, &moved);
    bool changed = differs(&moved, s);
    *s = moved;
    return changed;
}

// s = the nearer of s and other, ray by ray; of two within epsilon the later one owns the place.
static void nearer(struct query *q, struct rays_at *s, const struct rays_at *other)
{
    v8f epsilon = v8_set(q->t->frame->epsilon);
    for (int y = 0; y < BLOCK; y++) {
        v8f a = s->key[y], b = other->key[y];
        v8i b_first = b < a;
        int tie = v8_bits((v8_abs(a - b) <= epsilon) & (b < v8_set(NEVER)));
        v8i owner = v8_selecti(b_first, other->owner[y], s->owner[y]);
        for (int x = 0; tie; x++, tie >>= 1)
            if (tie & 1)
                owner[x] = later(q, other->owner[y][x], s->owner[y][x]) ? other->owner[y][x]
                                                                        : s->owner[y][x];
        s->key[y] = v8_min(b, a);
        s->owner[y] = owner;
    }
}

// ---------------------------------------------------------------- inner nodes

static bool move_in(struct query *q, uint32_t ref, struct rays_at *s);
static bool move_out(struct query *q, uint32_t ref, struct rays_at *s);

static bool union_in(struct query *q, struct query_node *n, struct rays_at *s)
{
    find_kids(q, n);
    struct rays_at best, one;
    float high = NEVER;
    for (int y = 0; y < BLOCK; y++) {
        best.key[y] = v8_set(NEVER);
        best.owner[y] = v8_seti(-1);
    }
    for (uint32_t i = 0; i < n->found_count; i++) {
        uint32_t kid = q->found[n->found + i]; // deeper unions may move the array
        if (extent_of(q, kid).near > high)
            continue;
        one = *s;
        move_in(q, kid, &one);
        nearer(q, &best, &one);
        high = -NEVER; // rays that are done (never) need no answer
        for (int y = 0; y < BLOCK; y++) {
            v8i alive = s->key[y] < v8_set(NEVER);
            high = fmaxf(high, v8_highest(v8_select(alive, best.key[y], v8_set(-NEVER))));
        }
    }
    bool changed = differs(&best, s);
    for (int y = 0; y < BLOCK; y++) { // a ray that did not move keeps its owner
        v8i moved = best.key[y] != s->key[y];
        s->key[y] = best.key[y];
        s->owner[y] = v8_selecti(moved | (s->owner[y] == v8_seti(-1)), best.owner[y], s->owner[y]);
    }
    return changed;
}

static bool union_out(struct query *q, struct query_node *n, struct rays_at *s)
{
    find_kids(q, n);
    bool changed = false, again = true;
    float reach = 1000 * q->t->frame->epsilon;
    while (again) {
        again = false;
        float high = highest(s->key), low = lowest(s->key);
        for (uint32_t i = 0; i < n->found_count; i++) {
            uint32_t ref = q->found[n->found + i];
            struct extent e = extent_of(q, ref);
            if (e.near > high + reach || e.far < low - reach)
                continue;
            bool moved =
                ref & LEAF_BIT ? leaf_out(q, ref & ~LEAF_BIT, high, s) : move_out(q, ref, s);
            if (moved) {
                again = changed = true;
                high = highest(s->key);
                low = lowest(s->key);
            }
        }
    }
    return changed;
}

static bool intersection_in(struct query *q, const struct query_node *n, struct rays_at *s)
{
    bool changed = false;
    uint32_t parts = n->count + (n->minus != NO_REF), settled = 0;
    for (uint32_t i = 0; settled < parts; i = i + 1 < parts ? i + 1 : 0) {
        bool moved = i < n->count ? move_in(q, q->kids[n->first + i], s) : move_out(q, n->minus, s);
        settled = moved ? 1 : settled + 1;
        changed |= moved;
        if (!moved)
            continue;
        v8i beyond = v8_seti(0);
        for (int y = 0; y < BLOCK; y++) {
            v8i past = (s->key[y] > q->limit[y]) & (s->key[y] < v8_set(NEVER));
            s->key[y] = v8_select(past, v8_set(NEVER), s->key[y]);
            beyond |= s->key[y] < v8_set(NEVER);
        }
        if (!v8_bits(beyond))
            break;
    }
    return changed;
}

static bool intersection_out(struct query *q, const struct query_node *n, struct rays_at *s)
{
    struct rays_at best = *s, one;
    bool first = true;
    for (uint32_t i = 0; i < n->count + (n->minus != NO_REF); i++) {
        one = *s;
        if (i < n->count)
            move_out(q, q->kids[n->first + i], &one);
        else
            move_in(q, n->minus, &one);
        if (first)
            best = one;
        else
            nearer(q, &best, &one);
        first = false;
    }
    bool changed = differs(&best, s);
    for (int y = 0; y < BLOCK; y++) {
        v8i moved = best.key[y] != s->key[y];
        s->key[y] = best.key[y];
        s->owner[y] = v8_selecti(moved, best.owner[y], s->owner[y]);
    }
    return changed;
}

static bool move_in(struct query *q, uint32_t ref, struct rays_at *s)
{
    if (ref & LEAF_BIT)
        return leaf_in(q, ref & ~LEAF_BIT, s);
    if (misses_block(q, ref))
        return kill(s);
    struct query_node *n = &q->nodes[ref];
    return n->op == EXPR_UNION ? union_in(q, n, s) : intersection_in(q, n, s);
}

static bool move_out(struct query *q, uint32_t ref, struct rays_at *s)
{
    if (ref & LEAF_BIT)
        return leaf_out(q, ref & ~LEAF_BIT, highest(s->key), s);
    if (misses_block(q, ref))
        return false;
    struct query_node *n = &q->nodes[ref];
    return n->op == EXPR_UNION ? union_out(q, n, s) : intersection_out(q, n, s);
}

static float latest(const struct rays_at *s)
{
    v8f m = v8_set(-NEVER);
    for (int y = 0; y < BLOCK; y++)
        m = v8_max(m, s->key[y]);
    return v8_highest(m);
}

// A part that is one leaf: no moving about, its entry or nothing.
static void leaf_alone(struct query *q, uint32_t index, struct rays_at *out)
{
    const struct block_leaf *b = tile_crossings(q->t, &q->t->leaves[index]);
    int32_t id = (int32_t)(index << 1);
    if (!b)
        return;
    v8i close = v8_seti(b->mesh ? -1 : 0), nearer_some = v8_seti(0);
    if (!b->mesh) {
        const v8f *enter = (const v8f *)b->enter, *leave = (const v8f *)b->leave;
        v8f band = v8_set(b->band), near = v8_set(q->t->frame->epsilon);
        v8f start = v8_set(q->t->frame->start);
        for (int y = 0; y < BLOCK; y++) {
            v8f z = out->key[y];
            close |= ((leave[y] - enter[y] <= band) & (leave[y] > enter[y])) |
                     ((v8_abs(enter[y] - z) <= near) & (z < v8_set(NEVER))) | (enter[y] <= start);
            nearer_some |= enter[y] < z;
        }
    }
    if (v8_bits(close)) {
        struct rays_at s;
        for (int y = 0; y < BLOCK; y++) {
            s.key[y] = v8_set(q->t->frame->start);
            s.owner[y] = v8_seti(-1);
        }
        leaf_in(q, index, &s);
        nearer(q, out, &s);
        return;
    }
    if (!v8_bits(nearer_some))
        return;
    const v8f *enter = (const v8f *)b->enter;
    for (int y = 0; y < BLOCK; y++) {
        v8i ahead = enter[y] < out->key[y];
        out->key[y] = v8_min(enter[y], out->key[y]);
        out->owner[y] = v8_selecti(ahead, v8_seti(id), out->owner[y]);
    }
}

void query_block(struct query *q, struct rays_at *out)
{
    struct tile *t = q->t;
    v8f start = v8_set(t->frame->start);
    float high = NEVER;
    q->block++;
    q->found_count = 0;
    for (int y = 0; y < BLOCK; y++) {
        out->key[y] = v8_set(NEVER);
        out->owner[y] = v8_seti(-1);
    }
    for (uint32_t i = 0; i < q->part_count; i++) {
        const struct query_part *p = &q->parts[i];
        if (p->extent.near > high)
            break;
        if (p->root != NO_REF && misses_block(q, p->root))
            continue;
        t->limit = high + t->frame->epsilon;
        if (p->root != NO_REF && p->root & LEAF_BIT) {
            leaf_alone(q, p->root & ~LEAF_BIT, out);
            high = latest(out);
            continue;
        }
        struct rays_at s;
        for (int y = 0; y < BLOCK; y++) {
            s.key[y] = start;
            s.owner[y] = v8_seti(-1);
            q->limit[y] = out->key[y] + v8_set(t->frame->epsilon);
        }
        if (p->query)
            move_in(q, p->root, &s);
        else
            walk_first(t, p->first, p->count, &s);
        nearer(q, out, &s);
        high = latest(out);
    }
}
