// query_leaf.c - queries of one leaf, and the nearer of two answers.
#include "render/cpu/query_leaf.h"

#include "base/mem.h"
#include "render/cpu/query_tie.h"

#include <string.h>

void query_nearer(struct query *q, struct rays_at *s, const struct rays_at *other)
{
    v8f reach = v8_set(q->reach), never = v8_set(NEVER);
    for (int y = 0; y < BLOCK; y++) {
        v8f a = s->key[y], b = other->key[y];
        int near = v8_bits((v8_abs(a - b) <= reach) & (a < never) & (b < never));
        for (; near; near &= near - 1) {
            int x = __builtin_ctz((unsigned)near), ray = y * BLOCK + x;
            struct crossed one = {a[x], s->owner[y][x]}, two = {b[x], other->owner[y][x]};
            // of one owner: what begins there in one of them may not matter
            if (one.owner != two.owner || q->tied >> ray & 1)
                query_note_pair(q, ray, TIE_EITHER, one, two);
        }
        s->key[y] = v8_min(b, a);
        s->owner[y] = v8_selecti(b < a, other->owner[y], s->owner[y]);
    }
}

// ---------------------------------------------------------------- one ray

// One ray moves to where it is next inside the leaf, with the filter.
static void ray_in(struct query *q, int ray, int32_t id, struct crossed *at)
{
    for (uint32_t i = 0; i < q->lane_count; i++) {
        struct crossed enter = {q->lane[i].enter, id}, leave = {q->lane[i].leave, id | 1};
        bool ahead = enter.key > at->key;
        if (!(leave.key > at->key)) { // what the ray has crossed may matter, but not here
            query_note_crowd(q, ray, leave, *at);
            continue;
        }
        if (query_is_thin(q, ray, ahead ? enter : *at, leave)) {
            // past the edge of the leaf one may see where two others touch
            query_note_crowd(q, ray, ahead ? enter : *at, leave);
            continue;
        }
        if (id != at->owner)
            query_note_pair(q, ray, TIE_BOTH, *at, enter);
        if (ahead)
            *at = enter;
        return;
    }
    at->key = NEVER;
}

// One ray moves to where it is next outside of the leaf.
static void ray_out(struct query *q, int ray, int32_t id, struct crossed *at)
{
    for (uint32_t i = 0; i < q->lane_count; i++) {
        struct crossed enter = {q->lane[i].enter, id}, leave = {q->lane[i].leave, id | 1};
        query_note_crowd(q, ray, enter, leave); // too thin to exist, it does not show
        if (leave.owner != at->owner)
            query_note_pair(q, ray, TIE_BOTH, *at, leave);
        if (leave.key > at->key && (enter.key <= at->key || query_is_thin(q, ray, *at, enter))) {
            query_note_crowd(q, ray, enter, *at); // what it has crossed may matter, but not here
            *at = leave;
        }
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
            (out ? ray_out : ray_in)(q, i, id, &at);
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
            near[y] = ((x - m <= band) & (x + band >= c)) |
                      ((v8_abs(e - c) <= band) & other & (c < never));
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
