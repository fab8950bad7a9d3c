// query.c - first surfaces by interval queries, a block of rays at a time.
#include "render/cpu/query_leaf.h"
#include "render/cpu/query_tie.h"
#include "render/cpu/walk.h"

static bool move_in(struct query *q, uint32_t ref, struct rays_at *s);
static bool move_out(struct query *q, uint32_t ref, struct rays_at *s);

static bool union_in(struct query *q, struct query_node *n, struct rays_at *s)
{
    query_find_kids(q, n);
    struct rays_at best, one;
    float high = NEVER;
    for (int y = 0; y < BLOCK; y++) {
        best.key[y] = v8_set(NEVER);
        best.owner[y] = v8_seti(-1);
    }
    for (uint32_t i = 0; i < n->found_count; i++) {
        uint32_t kid = q->found[n->found + i]; // deeper unions may move the array
        if (extent_of(q, kid).near > high + q->reach)
            continue;
        uint32_t ties = q->tie_count;
        one = *s;
        move_in(q, kid, &one);
        query_drop_ties(q, ties, &one);
        query_nearer(q, &best, &one);
        high = -NEVER; // rays that are done (never) need no answer
        for (int y = 0; y < BLOCK; y++) {
            v8i alive = s->key[y] < v8_set(NEVER);
            high = fmaxf(high, v8_highest(v8_select(alive, best.key[y], v8_set(-NEVER))));
        }
    }
    bool changed = rays_differ(&best, s);
    for (int y = 0; y < BLOCK; y++) { // a ray that did not move keeps its owner
        v8i moved = best.key[y] != s->key[y];
        s->key[y] = best.key[y];
        s->owner[y] = v8_selecti(moved | (s->owner[y] == v8_seti(-1)), best.owner[y], s->owner[y]);
    }
    return changed;
}

static bool union_out(struct query *q, struct query_node *n, struct rays_at *s)
{
    query_find_kids(q, n);
    bool changed = false, again = true;
    float reach = 1000 * q->t->frame->epsilon;
    while (again) {
        again = false;
        float high = rays_highest(s), low = rays_lowest(s);
        for (uint32_t i = 0; i < n->found_count; i++) {
            uint32_t ref = q->found[n->found + i];
            struct extent e = extent_of(q, ref);
            if (e.near > high + reach || e.far < low - reach)
                continue;
            bool moved =
                ref & LEAF_BIT ? query_leaf_out(q, ref & ~LEAF_BIT, high, s) : move_out(q, ref, s);
            if (moved) {
                again = changed = true;
                high = rays_highest(s);
                low = rays_lowest(s);
            }
        }
    }
    return changed;
}

static void set_aside(struct rays_at *s, const v8i *mover, v8i operand)
{
    for (int y = 0; y < BLOCK; y++)
        s->key[y] = v8_select(mover[y] == operand, v8_set(NEVER), s->key[y]);
}

static void bring_back(struct rays_at *s, const struct rays_at *before, const v8i *mover,
                       v8i operand)
{
    for (int y = 0; y < BLOCK; y++) {
        v8i aside = mover[y] == operand;
        s->key[y] = v8_select(aside, before->key[y], s->key[y]);
        s->owner[y] = v8_selecti(aside, before->owner[y], s->owner[y]);
    }
}

// Moves the rays to where operand i wants them. Those that it was the last to move stand where it
// put them: asked again it would find that they tie with it.
static bool move_others(struct query *q, const struct query_node *n, uint32_t i, bool again,
                        v8i *mover, struct rays_at *s)
{
    struct rays_at before = *s;
    v8i operand = v8_seti((int32_t)i);
    if (again)
        set_aside(s, mover, operand);
    bool moved = i < n->count ? move_in(q, q->kids[n->first + i], s) : move_out(q, n->minus, s);
    if (again)
        bring_back(s, &before, mover, operand);
    for (int y = 0; moved && y < BLOCK; y++)
        mover[y] = v8_selecti(s->key[y] != before.key[y], operand, mover[y]);
    return moved;
}

static bool intersection_in(struct query *q, const struct query_node *n, struct rays_at *s)
{
    bool changed = false, again = false;
    uint32_t parts = n->count + (n->minus != NO_REF), settled = 0;
    v8i mover[BLOCK];
    for (int y = 0; y < BLOCK; y++)
        mover[y] = v8_seti(-1);
    for (uint32_t i = 0; settled < parts; i = i + 1 < parts ? i + 1 : 0) {
        bool moved = move_others(q, n, i, again, mover, s);
        again |= i + 1 == parts;
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
        uint32_t ties = q->tie_count;
        one = *s;
        if (i < n->count)
            move_out(q, q->kids[n->first + i], &one);
        else
            move_in(q, n->minus, &one);
        query_drop_ties(q, ties, &one);
        if (first)
            best = one;
        else
            query_nearer(q, &best, &one);
        first = false;
    }
    bool changed = rays_differ(&best, s);
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
        return query_leaf_in(q, ref & ~LEAF_BIT, s);
    if (misses_block(q, ref))
        return rays_kill(s);
    struct query_node *n = &q->nodes[ref];
    return n->op == EXPR_UNION ? union_in(q, n, s) : intersection_in(q, n, s);
}

static bool move_out(struct query *q, uint32_t ref, struct rays_at *s)
{
    if (ref & LEAF_BIT)
        return query_leaf_out(q, ref & ~LEAF_BIT, rays_highest(s), s);
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
    q->reach = fmaxf(q->reach, b->band);
    v8i close = v8_seti(b->mesh ? -1 : 0), nearer_some = v8_seti(0);
    if (!b->mesh) {
        const v8f *enter = (const v8f *)b->enter, *leave = (const v8f *)b->leave;
        v8f band = v8_set(b->band), near = v8_set(q->reach);
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
        query_leaf_in(q, index, &s);
        query_nearer(q, out, &s);
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
    q->tie_count = 0;
    q->tied = q->crowded = 0;
    q->reach = t->frame->epsilon;
    for (int y = 0; y < BLOCK; y++) {
        out->key[y] = v8_set(NEVER);
        out->owner[y] = v8_seti(-1);
    }
    for (uint32_t i = 0; i < q->part_count; i++) {
        const struct query_part *p = &q->parts[i];
        if (p->extent.near > high + q->reach)
            break;
        if (p->root != NO_REF && misses_block(q, p->root))
            continue;
        t->limit = high + q->reach;
        if (p->root != NO_REF && p->root & LEAF_BIT) {
            leaf_alone(q, p->root & ~LEAF_BIT, out);
            high = latest(out);
            continue;
        }
        struct rays_at s;
        for (int y = 0; y < BLOCK; y++) {
            s.key[y] = start;
            s.owner[y] = v8_seti(-1);
            q->limit[y] = out->key[y] + v8_set(q->reach);
        }
        uint32_t ties = q->tie_count;
        if (p->query)
            move_in(q, p->root, &s);
        else
            walk_first(t, p->first, p->count, &s);
        query_drop_ties(q, ties, &s);
        query_nearer(q, out, &s);
        high = latest(out);
    }
    query_settle(q, out);
}
