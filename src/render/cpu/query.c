// query.c - first surfaces by interval queries, a block of rays at a time.
#include "render/cpu/query_leaf.h"
#include "render/cpu/walk.h"

static bool move_in(struct query *q, uint32_t ref, struct rays_at *s);
static bool move_out(struct query *q, uint32_t ref, struct rays_at *s);

static bool holds(const struct query_tie *tie, float key)
{
    return key >= tie->first.key && key <= tie->last.key;
}

// Forgets the pairs from number `first` on that are not where the rays came to. Crowds stay: a leaf
// too thin to exist is no answer, but counts for what touches it.
static void drop_ties(struct query *q, uint32_t first, const struct rays_at *s)
{
    uint32_t n = first;
    for (uint32_t i = first; i < q->tie_count; i++) {
        const struct query_tie *tie = &q->ties[i];
        if (tie->kind == TIE_CROWD || holds(tie, s->key[tie->ray / BLOCK][tie->ray % BLOCK]))
            q->ties[n++] = *tie;
    }
    q->tie_count = n;
}

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
        drop_ties(q, ties, &one);
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

// Sets the rays aside that operand `i` was the last to move: they are where it wants them.
static void set_aside(struct rays_at *s, const v8i *mover, uint32_t i)
{
    for (int y = 0; y < BLOCK; y++)
        s->key[y] = v8_select(mover[y] == v8_seti((int32_t)i), v8_set(NEVER), s->key[y]);
}

static void bring_back(struct rays_at *s, const struct rays_at *before, v8i *mover, uint32_t i)
{
    v8i own = v8_seti((int32_t)i);
    for (int y = 0; y < BLOCK; y++) {
        v8i aside = mover[y] == own;
        s->key[y] = v8_select(aside, before->key[y], s->key[y]);
        s->owner[y] = v8_selecti(aside, before->owner[y], s->owner[y]);
        mover[y] = v8_selecti(s->key[y] != before->key[y], own, mover[y]);
    }
}

static bool intersection_in(struct query *q, const struct query_node *n, struct rays_at *s)
{
    bool changed = false;
    uint32_t parts = n->count + (n->minus != NO_REF), settled = 0;
    v8i mover[BLOCK];
    for (int y = 0; y < BLOCK; y++)
        mover[y] = v8_seti(-1);
    for (uint32_t i = 0; settled < parts; i = i + 1 < parts ? i + 1 : 0) {
        struct rays_at before = *s;
        set_aside(s, mover, i);
        bool moved = i < n->count ? move_in(q, q->kids[n->first + i], s) : move_out(q, n->minus, s);
        bring_back(s, &before, mover, i);
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
        drop_ties(q, ties, &one);
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

// Do two pairs of a ray say no more than that its owner is the latest of them?
static bool fit_together(const struct query_tie *a, const struct query_tie *b)
{
    bool same = a->first.owner == b->first.owner && a->last.owner == b->last.owner;
    bool level = a->first.key == a->last.key && b->first.key == b->last.key;
    return a->kind == b->kind && (same || level);
}

static uint32_t latest_of(const struct query *q, const struct query_tie *tie)
{
    uint32_t a = q->t->leaves[tie->first.owner >> 1].leaf;
    uint32_t b = q->t->leaves[tie->last.owner >> 1].leaf;
    return a > b ? a : b;
}

// The crossing of a pair that makes the surface.
static struct crossed turn_of(const struct query_tie *tie)
{
    return tie->kind == TIE_EITHER ? tie->first : tie->last;
}

// The other one shows instead if it lies in one plane with it and is of a later leaf.
static struct crossed shown_of(const struct query *q, const struct query_tie *tie)
{
    struct tile *t = q->t;
    struct crossed turn = turn_of(tie), other = tie->kind == TIE_EITHER ? tie->last : tie->first;
    struct tile_leaf *turning = &t->leaves[turn.owner >> 1], *leaf = &t->leaves[other.owner >> 1];
    if (leaf->leaf < turning->leaf)
        return turn;
    bool coplanar = turn.key == other.key ||
                    tile_coplanar(t, tie->ray, (struct face_at){leaf, other.owner & 1, other.key},
                                  (struct face_at){turning, turn.owner & 1, turn.key});
    return coplanar ? other : turn;
}

// Is a pair all there is to know of a ray that came to `at`?
static bool is_simple(const struct query *q, const struct query_tie *tie, struct crossed at)
{
    struct crossed turn = turn_of(tie);
    bool equal = tie->first.key == tie->last.key &&
                 (at.owner == tie->first.owner || at.owner == tie->last.owner);
    return tie->kind != TIE_CROWD && !q->t->frame->body->borders && at.key == turn.key &&
           (equal || at.owner == turn.owner);
}

// Finds the owners where crossings are at one place. Where these are more than two the ray is
// walked.
static void settle_ties(struct query *q, struct rays_at *out)
{
    struct tile *t = q->t;
    const struct query_tie *pair[BLOCK_PIXELS];
    uint64_t paired = 0, walked = q->crowded;
    float last = t->frame->start;
    for (int y = 0; y < BLOCK; y++)
        walked |= (uint64_t)(unsigned)v8_bits((out->key[y] < v8_set(NEVER)) &
                                              (out->owner[y] == v8_seti(-1)))
                  << (y * BLOCK);
    for (uint32_t i = 0; i < q->tie_count; i++) {
        const struct query_tie *tie = &q->ties[i];
        int y = tie->ray / BLOCK, x = tie->ray % BLOCK;
        uint64_t bit = (uint64_t)1 << tie->ray;
        if (!holds(tie, out->key[y][x]))
            continue;
        if (!is_simple(q, tie, (struct crossed){out->key[y][x], out->owner[y][x]}) ||
            (paired & bit && !fit_together(tie, pair[tie->ray])))
            walked |= bit;
        else if (!(paired & bit) || latest_of(q, tie) > latest_of(q, pair[tie->ray]))
            pair[tie->ray] = tie;
        if (!(walked & bit))
            paired |= bit;
        last = fmaxf(last, tie->last.key);
    }
    for (uint64_t rays = paired & ~walked; rays; rays &= rays - 1) {
        int i = __builtin_ctzll(rays);
        struct crossed shown = shown_of(q, pair[i]);
        out->key[i / BLOCK][i % BLOCK] = shown.key;
        out->owner[i / BLOCK][i % BLOCK] = shown.owner;
    }
    if (!walked)
        return;
    t->limit = q->crowded ? NEVER : last + q->reach;
    walk_some(t, walked, out);
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
        drop_ties(q, ties, &s);
        query_nearer(q, out, &s);
        high = latest(out);
    }
    settle_ties(q, out);
}
