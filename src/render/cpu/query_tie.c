// query_tie.c - crossings that rays meet at one place while queries move them: whose surface is it?
#include "render/cpu/query_tie.h"

#include "base/mem.h"
#include "render/cpu/walk.h"

static float steep_of(struct query *q, int ray, struct crossed c)
{
    float steep = 1; // of the plane where the ray begins
    if (c.owner >= 0)
        tile_face(q->t, &q->t->leaves[c.owner >> 1], ray, c.owner & 1, c.key, &steep);
    return steep;
}

static float band_of(const struct query *q, struct crossed c)
{
    return c.owner < 0 ? FLT_MAX : q->t->leaves[c.owner >> 1].band;
}

bool query_is_thin(struct query *q, int ray, struct crossed a, struct crossed b)
{
    if (b.key - a.key > fminf(band_of(q, a), band_of(q, b)))
        return false;
    if (a.key >= b.key)
        return true;
    float steep = fmaxf(steep_of(q, ray, a), steep_of(q, ray, b));
    return tile_thickness(q->t, a.key, b.key, steep) < q->t->frame->settings->epsilon;
}

static bool at_one_place(struct query *q, int ray, struct crossed a, struct crossed b)
{
    return a.key <= b.key ? query_is_thin(q, ray, a, b) : query_is_thin(q, ray, b, a);
}

static void note(struct query *q, int ray, enum tie_kind kind, struct crossed a, struct crossed b)
{
    enum { TIES_MOST = 1 << 14 };
    uint64_t bit = (uint64_t)1 << ray;
    bool swap = b.key < a.key || (b.key == a.key && b.owner < a.owner);
    q->tied |= bit;
    if (q->tie_count == TIES_MOST) {
        q->crowded |= bit;
        return;
    }
    array_reserve(&q->ties, &q->tie_capacity, q->tie_count + 1);
    q->ties[q->tie_count++] =
        (struct query_tie){.ray = ray, .kind = kind, .first = swap ? b : a, .last = swap ? a : b};
}

void query_note_pair(struct query *q, int ray, enum tie_kind kind, struct crossed a,
                     struct crossed b)
{
    if (a.owner >= 0 && b.owner >= 0 && at_one_place(q, ray, a, b))
        note(q, ray, kind, a, b);
}

void query_note_crowd(struct query *q, int ray, struct crossed a, struct crossed b)
{
    if (at_one_place(q, ray, a, b))
        note(q, ray, TIE_CROWD, a, b);
}

static struct crossed crossed_at(const struct rays_at *s, int ray)
{
    return (struct crossed){s->key[ray / BLOCK][ray % BLOCK], s->owner[ray / BLOCK][ray % BLOCK]};
}

// May a tie be where its ray came to?
static bool is_near(const struct query *q, const struct query_tie *tie, struct crossed at)
{
    float band = at.owner < 0 ? 0 : band_of(q, at);
    return at.key >= tie->first.key - band && at.key <= tie->last.key + band;
}

static bool is_there(struct query *q, const struct query_tie *tie, struct crossed at)
{
    return is_near(q, tie, at) &&
           (at_one_place(q, tie->ray, tie->first, at) || at_one_place(q, tie->ray, tie->last, at));
}

void query_drop_ties(struct query *q, uint32_t first, const struct rays_at *s)
{
    uint32_t n = first;
    for (uint32_t i = first; i < q->tie_count; i++) {
        const struct query_tie *tie = &q->ties[i];
        if (tie->kind == TIE_CROWD || is_near(q, tie, crossed_at(s, tie->ray)))
            q->ties[n++] = *tie;
    }
    q->tie_count = n;
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

// Where more crossings meet than pairs can tell of, the ray is walked. So are rays that begin
// inside.
void query_settle(struct query *q, struct rays_at *out)
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
        struct crossed at = crossed_at(out, tie->ray);
        uint64_t bit = (uint64_t)1 << tie->ray;
        if (!is_there(q, tie, at))
            continue;
        if (!is_simple(q, tie, at) || (paired & bit && !fit_together(tie, pair[tie->ray])))
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
