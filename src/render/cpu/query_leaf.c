// query_leaf.c - queries of one leaf, and which of two surfaces at one place shows.
#include "render/cpu/query_leaf.h"

#include "base/mem.h"

#include <string.h>

// ---------------------------------------------------------------- surfaces at one place

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

bool query_is_thin(struct query *q, int ray, float a, int32_t owner_a, float b, int32_t owner_b,
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

void query_nearer(struct query *q, struct rays_at *s, const struct rays_at *other)
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

// ---------------------------------------------------------------- one ray

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
        if (query_is_thin(q, ray, e > c ? e : c, e > c ? id : *owner, x, id | 1, band)) {
            if (e > c)
                note_sliver(q, ray, x);
            continue;
        }
        if (fabsf(e - c) <= band)
            note_mixed(q, ray, id, e, *owner, c);
        if (e > c) {
            if (!(e - c <= band && *owner >= 0 && covers(q, ray, *owner, c, id, e) &&
                  query_is_thin(q, ray, c, *owner, e, id, band)))
                *owner = id;
            *key = e;
        } else if (c - e <= band && *owner >= 0 && covers(q, ray, id, e, *owner, c) &&
                   query_is_thin(q, ray, e, id, c, *owner, band)) {
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
        if (x > c && (e <= c || query_is_thin(q, ray, c, *owner, e, id, band))) {
            bool same = x - c <= band && *owner >= 0 && covers(q, ray, *owner, c, id | 1, x) &&
                        query_is_thin(q, ray, c, *owner, x, id | 1, band);
            *key = x;
            *owner = same ? *owner : (id | 1);
        } else if (x <= c && c - x <= band && *owner >= 0 && (*owner & 1) &&
                   covers(q, ray, id | 1, x, *owner, c) &&
                   query_is_thin(q, ray, x, id | 1, c, *owner, band)) {
            *owner = id | 1;
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

bool query_leaf_in(struct query *q, uint32_t index, struct rays_at *s)
{
    const struct block_leaf *b = tile_crossings(q->t, &q->t->leaves[index]);
    int32_t id = (int32_t)(index << 1);
    if (!b)
        return rays_kill(s);
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
