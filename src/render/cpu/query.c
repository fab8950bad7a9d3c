// query.c - first surfaces by interval queries, a block of rays at a time.
#include "render/cpu/query_tree.h"

#include "base/mem.h"
#include "render/cpu/walk.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

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

static struct face_at face_of(const struct query *q, int32_t owner, float key)
{
    return (struct face_at){&q->t->leaves[owner >> 1], owner & 1, key};
}

// Of geometry, which of two faces in one plane shows depends on all that meet there: such rays are
// walked in the end.
static void note_mixed(struct query *q, int ray, int32_t a, float key_a, int32_t b, float key_b)
{
    const struct body *body = q->t->frame->body;
    if (!body->borders || a < 0 || b < 0)
        return;
    const struct leaf *one = &body->leaves[q->t->leaves[a >> 1].leaf];
    if (one->subtracted != body->leaves[q->t->leaves[b >> 1].leaf].subtracted &&
        (key_a == key_b || tile_coplanar(q->t, ray, face_of(q, a, key_a), face_of(q, b, key_b))))
        q->mixed |= (uint64_t)1 << ray;
}

// Of two surfaces within epsilon the expression shows that of `owner`. Is it the other one that is
// seen, because both lie in one plane and it is the later one? Faces of different planes that meet
// there do not hide each other: else the side of a solid would show in its neighbour's flat face.
static bool covers(const struct query *q, int ray, int32_t other, float other_key, int32_t owner,
                   float key)
{
    if (!later(q, other, owner))
        return false;
    return owner < 0 || other_key == key ||
           tile_coplanar(q->t, ray, face_of(q, other, other_key), face_of(q, owner, key));
}

static void note_sliver(struct query *q, int ray, float end)
{
    if (!q->slivers)
        for (int i = 0; i < BLOCK_PIXELS; i++)
            q->sliver[i] = NEVER;
    q->slivers = true;
    q->sliver[ray] = fminf(q->sliver[ray], end);
}

// One ray moves to where it is next inside the leaf, with the filter.
static void ray_in(struct query *q, int ray, float band, int32_t id, float *key, int32_t *owner)
{
    float c = *key;
    for (uint32_t i = 0; i < q->lane_count; i++) {
        float e = q->lane[i].enter, x = q->lane[i].leave;
        if (!(x > c))
            continue;
        if (thin(q, ray, e > c ? e : c, e > c ? id : *owner, x, id | 1, band)) {
            if (e > c)
                note_sliver(q, ray, x);
            continue;
        }
        if (fabsf(e - c) <= band)
            note_mixed(q, ray, id, e, *owner, c);
        if (e > c) {
            if (!(e - c <= band && *owner >= 0 && covers(q, ray, *owner, c, id, e) &&
                  thin(q, ray, c, *owner, e, id, band)))
                *owner = id;
            *key = e;
        } else if (c - e <= band && *owner >= 0 && covers(q, ray, id, e, *owner, c) &&
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
        if (fabsf(x - c) <= band)
            note_mixed(q, ray, id | 1, x, *owner, c);
        if (x > c && (e <= c || thin(q, ray, c, *owner, e, id, band))) {
            bool same = x - c <= band && *owner >= 0 && covers(q, ray, *owner, c, id | 1, x) &&
                        thin(q, ray, c, *owner, x, id | 1, band);
            *key = x;
            *owner = same ? *owner : (id | 1);
        } else if (x <= c && c - x <= band && *owner >= 0 && (*owner & 1) &&
                   covers(q, ray, id | 1, x, *owner, c) &&
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

// s = the nearer of s and other, ray by ray; of two in one place one may cover the other.
static void nearer(struct query *q, struct rays_at *s, const struct rays_at *other)
{
    v8f epsilon = v8_set(q->t->frame->epsilon);
    for (int y = 0; y < BLOCK; y++) {
        v8f a = s->key[y], b = other->key[y];
        v8i b_first = b < a;
        int tie = v8_bits((v8_abs(a - b) <= epsilon) & (b < v8_set(NEVER)));
        v8i owner = v8_selecti(b_first, other->owner[y], s->owner[y]);
        for (; tie; tie &= tie - 1) {
            int x = __builtin_ctz((unsigned)tie);
            int32_t front = owner[x], back = b_first[x] ? s->owner[y][x] : other->owner[y][x];
            note_mixed(q, y * BLOCK + x, front, fminf(a[x], b[x]), back, fmaxf(a[x], b[x]));
            if (covers(q, y * BLOCK + x, back, fmaxf(a[x], b[x]), front, fminf(a[x], b[x])))
                owner[x] = back;
        }
        s->key[y] = v8_min(b, a);
        s->owner[y] = owner;
    }
}

// ---------------------------------------------------------------- inner nodes

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
    query_find_kids(q, n);
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

// Where a leaf too thin to exist ends at the first surface, that surface may be no face at all but
// where two leaves touch, seen past the edge of the first one: rays there are walked.
static void walk_slivers(struct query *q, struct rays_at *out)
{
    struct tile *t = q->t;
    float epsilon = t->frame->epsilon;
    for (int i = 0; i < BLOCK_PIXELS; i++) {
        float key = out->key[i / BLOCK][i % BLOCK];
        int32_t owner = out->owner[i / BLOCK][i % BLOCK];
        if (!(fabsf(key - q->sliver[i]) <= epsilon) || key >= NEVER || owner < 0)
            continue;
        struct rays_at walked;
        t->limit = key + epsilon;
        walk_one(t, i, &walked);
        float walked_key = walked.key[i / BLOCK][i % BLOCK];
        int32_t walked_owner = walked.owner[i / BLOCK][i % BLOCK];
        if (walked_owner < 0 || walked_key >= key ||
            !thin(q, i, walked_key, walked_owner, key, owner, NEVER))
            continue;
        out->key[i / BLOCK][i % BLOCK] = walked_key;
        out->owner[i / BLOCK][i % BLOCK] = walked_owner;
    }
}

static void walk_mixed(struct query *q, struct rays_at *out)
{
    struct tile *t = q->t;
    for (uint64_t rays = q->mixed; rays; rays &= rays - 1) {
        int i = __builtin_ctzll(rays), y = i / BLOCK, x = i % BLOCK;
        float key = out->key[y][x];
        struct rays_at walked;
        if (key >= NEVER || out->owner[y][x] < 0)
            continue;
        t->limit = key + t->frame->epsilon;
        walk_one(t, i, &walked);
        if (walked.owner[y][x] >= 0 && fabsf(walked.key[y][x] - key) <= t->frame->epsilon)
            out->owner[y][x] = walked.owner[y][x];
    }
}

void query_block(struct query *q, struct rays_at *out)
{
    struct tile *t = q->t;
    v8f start = v8_set(t->frame->start);
    float high = NEVER;
    q->block++;
    q->found_count = 0;
    q->slivers = false;
    q->mixed = 0;
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
    if (q->slivers)
        walk_slivers(q, out);
    if (q->mixed)
        walk_mixed(q, out);
}
