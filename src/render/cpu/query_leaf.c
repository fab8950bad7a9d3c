// query_leaf.c - queries of one leaf, and which of two surfaces at one place shows.
#include "render/cpu/query_leaf.h"

#include "base/mem.h"

#include <string.h>

static float steep_of(struct query *q, int32_t owner, int ray, float key)
{
    float steep = 1; // of the plane where the ray begins
    if (owner >= 0)
        tile_face(q->t, &q->t->leaves[owner >> 1], ray, owner & 1, key, &steep);
    return steep;
}

// Is the interval between key `a` at the face of `owner_a` and key `b` at that of `owner_b` too
// thin to exist? Not where it is longer than `band`.
static bool is_thin(struct query *q, int ray, float a, int32_t owner_a, float b, int32_t owner_b,
                    float band)
{
    if (b - a > band)
        return false;
    if (a >= b)
        return true;
    float steep = fmaxf(steep_of(q, owner_a, ray, a), steep_of(q, owner_b, ray, b));
    return tile_thickness(q->t, a, b, steep) < q->t->frame->settings->epsilon;
}

static void note_tie(struct query *q, int ray, struct query_tie tie)
{
    enum { TIES_MOST = 1 << 14 };
    uint64_t bit = (uint64_t)1 << ray;
    q->tied |= bit;
    if (q->tie_count == TIES_MOST) {
        q->crowded |= bit;
        return;
    }
    tie.ray = ray;
    array_reserve(&q->ties, &q->tie_capacity, q->tie_count + 1);
    q->ties[q->tie_count++] = tie;
}

// Notes two crossings if they are at one place. Of those closer than `band` the filter decides.
static void note_pair(struct query *q, int ray, enum tie_kind kind, struct crossed a,
                      struct crossed b, float band)
{
    if (b.key < a.key || (b.key == a.key && b.owner < a.owner)) {
        struct crossed swap = a;
        a = b;
        b = swap;
    }
    if (a.owner >= 0 && b.owner >= 0 && b.key - a.key <= band &&
        is_thin(q, ray, a.key, a.owner, b.key, b.owner, band))
        note_tie(q, ray, (struct query_tie){.kind = kind, .first = a, .last = b});
}

// Whose surface is anywhere between two keys is more than a pair can tell.
static void note_crowd(struct query *q, int ray, float from, float to)
{
    note_tie(q, ray, (struct query_tie){.kind = TIE_CROWD, .first = {from, -1}, .last = {to, -1}});
}

void query_nearer(struct query *q, struct rays_at *s, const struct rays_at *other)
{
    v8f reach = v8_set(q->reach), never = v8_set(NEVER);
    for (int y = 0; y < BLOCK; y++) {
        v8f a = s->key[y], b = other->key[y];
        int near = v8_bits((v8_abs(a - b) <= reach) & (a < never) & (b < never));
        for (; near; near &= near - 1) {
            int x = __builtin_ctz((unsigned)near), ray = y * BLOCK + x;
            struct crossed one = {a[x], s->owner[y][x]}, two = {b[x], other->owner[y][x]};
            if (one.owner < 0 || two.owner < 0)
                continue;
            if (one.owner != two.owner)
                note_pair(
                    q, ray, TIE_EITHER, one, two,
                    fminf(q->t->leaves[one.owner >> 1].band, q->t->leaves[two.owner >> 1].band));
            else if (q->tied >> ray & 1) // what begins in one of them here may not matter
                note_tie(q, ray, (struct query_tie){.kind = TIE_EITHER, .first = one, .last = two});
        }
        s->key[y] = v8_min(b, a);
        s->owner[y] = v8_selecti(b < a, other->owner[y], s->owner[y]);
    }
}

// ---------------------------------------------------------------- one ray

// One ray moves to where it is next inside the leaf, with the filter.
static void ray_in(struct query *q, int ray, float band, int32_t id, struct crossed *at)
{
    float c = at->key, epsilon = q->t->frame->epsilon;
    for (uint32_t i = 0; i < q->lane_count; i++) {
        float e = q->lane[i].enter, x = q->lane[i].leave;
        if (!(x > c)) {
            if (c - x <= band && i + 1 < q->lane_count) // of a mesh that touches itself
                note_crowd(q, ray, x, c);
            continue;
        }
        if (is_thin(q, ray, e > c ? e : c, e > c ? id : at->owner, x, id | 1, band)) {
            if (e > c) // past its edge one may see where two leaves touch
                note_crowd(q, ray, x - epsilon, x + epsilon);
            else
                note_crowd(q, ray, c, x);
            continue;
        }
        if (id != at->owner)
            note_pair(q, ray, TIE_BOTH, *at, (struct crossed){e, id}, band);
        if (e > c)
            *at = (struct crossed){e, id};
        return;
    }
    at->key = NEVER;
}

// One ray moves to where it is next outside of the leaf.
static void ray_out(struct query *q, int ray, float band, int32_t id, struct crossed *at)
{
    for (uint32_t i = 0; i < q->lane_count; i++) {
        float e = q->lane[i].enter, x = q->lane[i].leave, c = at->key;
        if ((id | 1) != at->owner)
            note_pair(q, ray, TIE_BOTH, *at, (struct crossed){x, id | 1}, band);
        if (x > c && (e <= c || is_thin(q, ray, c, at->owner, e, id, band)))
            *at = (struct crossed){x, id | 1};
    }
}

// ---------------------------------------------------------------- a block of rays

static uint64_t block_bits(const v8i *mask) // bit i: ray i
{
    uint64_t bits = 0;
    for (int y = 0; y < BLOCK; y++)
        bits |= (uint64_t)(unsigned)v8_bits(mask[y]) << (y * BLOCK);
    return bits;
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
        struct crossed at = {from->key[y][x], from->owner[y][x]};
        q->lane = mesh ? q->copy + first[i] : &ends[i];
        q->lane_count = mesh ? first[i + 1] - first[i] : 1;
        if (at.key < NEVER)
            (out ? ray_out : ray_in)(q, i, band, id, &at);
        s->key[y][x] = at.key;
        s->owner[y][x] = at.owner;
    }
}

bool query_leaf_in(struct query *q, uint32_t index, struct rays_at *s)
{
    const struct block_leaf *b = tile_crossings(q->t, &q->t->leaves[index]);
    int32_t id = (int32_t)(index << 1);
    if (!b)
        return rays_kill(s);
    q->reach = fmaxf(q->reach, b->band);
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
    bool changed = rays_differ(&moved, s);
    *s = moved;
    return changed;
}

bool query_leaf_out(struct query *q, uint32_t index, float high, struct rays_at *s)
{
    const struct block_leaf *b = tile_crossings(q->t, &q->t->leaves[index]);
    int32_t id = (int32_t)(index << 1);
    if (!b || b->near - b->band > high)
        return false;
    q->reach = fmaxf(q->reach, b->band);
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
    bool changed = rays_differ(&moved, s);
    *s = moved;
    return changed;
}
