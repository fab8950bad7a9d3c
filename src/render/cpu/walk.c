// walk.c - the classification walk over the sorted crossings of each ray.
#include "render/cpu/walk.h"

#include "base/mem.h"
#include "render/cpu/crossing_list.h"
#include "render/cpu/query.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_FEW = 64 }; // more are sorted at once

struct walk_lists {
    struct tile_room room;
    struct crossing_list list;
    crossing *rest; // a list without some crossings
    uint32_t rest_capacity;
    bool *border; // per crossing of a cluster
    uint32_t border_capacity;
    uint32_t *turns; // crossings of a cluster that turn the state
    uint32_t turn_capacity;

    // evaluation of unknown combinations
    struct member *members;
    uint32_t member_count, member_capacity;
    const crossing *replayed; // the list whose first crossings, after the base, made the members
    uint32_t replayed_count;
    struct member *base; // combination at the start of the list being walked
    uint32_t base_count, base_capacity;

    // the array method
    int32_t *inside; // per leaf of the body
    bool *solid;     // per node of the expression

    struct span *spans;
    uint32_t span_count, span_capacity;
};

struct walk_lists *walk_new(struct tile_room room)
{
    struct walk_lists *w = mem_zalloc(sizeof *w);
    size_t items = room.memory / 4 / sizeof(crossing);
    w->list.size = (uint32_t)(items < 256 ? 256 : items > 1 << 20 ? 1 << 20 : items);
    w->list.items = mem_alloc(w->list.size * sizeof *w->list.items);
    w->list.spare = mem_alloc(w->list.size * sizeof *w->list.spare);
    w->inside = mem_zalloc((room.leaves + 1) * sizeof *w->inside);
    w->solid = mem_zalloc(room.nodes + 1);
    w->room = room;
    return w;
}

size_t walk_bytes(const struct walk_lists *w)
{
    return w->list.size * 2 * sizeof(crossing) + w->room.leaves * sizeof *w->inside +
           w->room.nodes + w->rest_capacity * sizeof(crossing) + w->border_capacity +
           w->turn_capacity * sizeof *w->turns +
           (w->member_capacity + w->base_capacity) * sizeof *w->members +
           w->span_capacity * sizeof *w->spans;
}

void walk_delete(struct walk_lists *w)
{
    if (!w)
        return;
    free(w->list.items);
    free(w->list.spare);
    free(w->rest);
    free(w->border);
    free(w->turns);
    free(w->members);
    free(w->base);
    free(w->inside);
    free(w->solid);
    free(w->spans);
    free(w);
}

// ---------------------------------------------------------------- is a combination solid?

// Counts a crossing into the members, which stay sorted by class: mostly few, so a plain search.
static void member_step(struct walk_lists *w, uint32_t class_id, bool in)
{
    struct member *members = w->members;
    uint32_t at = w->member_count;
    while (at > 0 && members[at - 1].class_id > class_id)
        at--;
    if (at == 0 || members[at - 1].class_id != class_id) {
        for (uint32_t i = w->member_count++; i > at; i--)
            members[i] = members[i - 1];
        members[at++] = (struct member){.class_id = class_id};
    }
    members[at - 1].count += in ? 1 : UINT32_MAX;
    if (!members[at - 1].count) {
        w->member_count--;
        for (uint32_t i = at - 1; i < w->member_count; i++)
            members[i] = members[i + 1];
    }
}

static int compare_members(const void *a, const void *b)
{
    uint32_t p = ((const struct member *)a)->class_id, q = ((const struct member *)b)->class_id;
    return p < q ? -1 : p > q;
}

// Sorts members that were appended one by one, and adds up those of one class.
static void members_settle(struct walk_lists *w)
{
    uint32_t kept = 0;
    qsort(w->members, w->member_count, sizeof *w->members, compare_members);
    for (uint32_t i = 0, next; i < w->member_count; i = next) {
        struct member sum = w->members[i];
        for (next = i + 1; next < w->member_count && w->members[next].class_id == sum.class_id;
             next++)
            sum.count += w->members[next].count;
        if (sum.count)
            w->members[kept++] = sum;
    }
    w->member_count = kept;
}

// Makes w->members the combination of the base and the crossings items[0 .. n). Goes on from where
// the last call stopped if that was in front of n in the same list.
static void replay(struct tile *t, const crossing *items, uint32_t n)
{
    struct walk_lists *w = t->lists;
    const uint32_t *class_of = t->frame->body->sharing.class_of_leaf;
    if (w->replayed != items || w->replayed_count > n) {
        array_reserve(&w->members, &w->member_capacity, w->base_count + 1);
        if (w->base_count)
            memcpy(w->members, w->base, w->base_count * sizeof *w->members);
        w->member_count = w->base_count;
        w->replayed = items;
        w->replayed_count = 0;
    }
    array_reserve(&w->members, &w->member_capacity, w->member_count + (n - w->replayed_count) + 1);
    bool many = n - w->replayed_count > STEPS_FEW;
    for (; w->replayed_count < n; w->replayed_count++) {
        uint32_t id = (uint32_t)items[w->replayed_count];
        uint32_t class_id = class_of[t->leaves[id >> 1].leaf];
        if (many)
            w->members[w->member_count++] = (struct member){class_id, id & 1 ? UINT32_MAX : 1};
        else
            member_step(w, class_id, !(id & 1));
    }
    if (many)
        members_settle(w);
}

static bool solid_hash(struct tile *t, uint64_t key, const crossing *items, uint32_t n)
{
    struct discovery *d = t->frame->body->table;
    int state = discovery_lookup(d, key);
    if (state == SET_UNKNOWN) {
        replay(t, items, n);
        state = discovery_resolve(d, key, t->lists->members, t->lists->member_count);
        t->misses++;
    }
    return state == SET_SOLID;
}

// Lefebvre 2013: a counter per primitive, the whole expression for each interval. For the bench.
static bool solid_array(struct tile *t)
{
    const struct expr *e = &t->frame->body->expr;
    bool *solid = t->lists->solid;
    for (uint32_t i = 0; i < e->node_count; i++) {
        const struct expr_node *n = &e->nodes[i];
        if (n->op == EXPR_LEAF) {
            solid[i] = t->lists->inside[n->leaf] > 0;
            continue;
        }
        bool any = n->op == EXPR_UNION, value = !any;
        for (uint32_t k = 0; k < n->count && value != any; k++)
            value = solid[e->kids[n->first + k]];
        solid[i] = value && !(n->minus != EXPR_NONE && solid[n->minus]);
    }
    return e->node_count && solid[e->root];
}

// ---------------------------------------------------------------- one ray

// A crossing in its place: what the walk needs to know of a face.
struct boundary {
    float key;
    uint32_t leaf; // of the body; SURFACE_NONE at the ends of the ray
    uint32_t face;
};

struct ray_walk {
    struct tile *t;
    int ray;
    const crossing *items;
    uint32_t count;
    bool first_only;
    bool array;
    // carried from list to list of one ray
    uint64_t key;
    bool solid;
    struct boundary entered;
    float first_key; // answers of first_only
    int32_t first_owner;
};

static float steep_at(struct ray_walk *r, crossing c)
{
    float steep;
    uint32_t id = (uint32_t)c;
    tile_face(r->t, &r->t->leaves[id >> 1], r->ray, id & 1, crossing_key(c), &steep);
    return steep;
}

// Is the interval between two crossings thick enough to exist?
static bool thick(struct ray_walk *r, crossing a, crossing b)
{
    struct tile *t = r->t;
    float from = crossing_key(a), to = crossing_key(b);
    if (from >= to)
        return false;
    float band_a = t->leaves[(uint32_t)a >> 1].band, band_b = t->leaves[(uint32_t)b >> 1].band;
    if (to - from > fminf(band_a, band_b))
        return true;
    return tile_thickness(t, from, to, fmaxf(steep_at(r, a), steep_at(r, b))) >=
           t->frame->settings->epsilon;
}

static struct boundary boundary_at(struct ray_walk *r, crossing c)
{
    float steep;
    uint32_t id = (uint32_t)c;
    struct tile_leaf *l = &r->t->leaves[id >> 1];
    float key = crossing_key(c);
    uint32_t face = tile_face(r->t, l, r->ray, id & 1, key, &steep);
    bool end = id & 1 && key >= r->t->frame->end;
    return (struct boundary){.key = key,
                             .leaf = end ? SURFACE_NONE : l->leaf,
                             .face = face == FACE_REGION ? SURFACE_CAP : face};
}

static float span_depth(const struct tile *t, float key)
{
    const struct frame *f = t->frame;
    if (!f->rays->orthographic)
        key = key / (1 - key * (float)(1 / f->t0));
    return key + (float)(f->t0 - f->rays->reference);
}

static void add_span(struct tile *t, struct boundary enter, struct boundary leave)
{
    struct walk_lists *w = t->lists;
    array_reserve(&w->spans, &w->span_capacity, w->span_count + 1);
    w->spans[w->span_count++] = (struct span){.enter = span_depth(t, enter.key),
                                              .leave = span_depth(t, leave.key),
                                              .enter_leaf = enter.leaf,
                                              .enter_face = enter.face,
                                              .leave_leaf = leave.leaf,
                                              .leave_face = leave.face};
}

static void step(struct ray_walk *r, crossing c, bool back)
{
    const struct body *b = r->t->frame->body;
    uint32_t id = (uint32_t)c, leaf = r->t->leaves[id >> 1].leaf;
    bool in = !(id & 1) != back;
    if (r->array) {
        r->t->lists->inside[leaf] += in ? 1 : -1;
        return;
    }
    uint64_t value = b->sharing.classes[b->sharing.class_of_leaf[leaf]].value;
    r->key += in ? value : (uint64_t)0 - value;
}

static bool is_solid(struct ray_walk *r, const crossing *items, uint32_t n)
{
    return r->array ? solid_array(r->t) : solid_hash(r->t, r->key, items, n);
}

// Would the state behind crossing items[to - 1] be solid without crossing c of the cluster [from,
// to), or (alone) with no other crossing of the cluster than c? A leaf that only crosses the border
// of its region is inside on both sides in truth.
static bool solid_if(struct ray_walk *r, uint32_t from, uint32_t to, uint32_t c, bool alone)
{
    struct walk_lists *w = r->t->lists;
    uint32_t n = from;
    array_reserve(&w->rest, &w->rest_capacity, to);
    crossing *rest = w->rest;
    memcpy(rest, r->items, from * sizeof *rest);
    for (uint32_t i = from; i < to; i++) {
        if (w->border[i - from] ? !(r->items[i] & 1) : (i == c) == alone)
            rest[n++] = r->items[i];
        else
            step(r, r->items[i], true);
    }
    w->replayed = NULL; // the room of `rest` held other crossings before
    bool solid = is_solid(r, rest, n);
    w->replayed = NULL;
    for (uint32_t i = from; i < to; i++)
        if (w->border[i - from] ? r->items[i] & 1 : (i == c) != alone)
            step(r, r->items[i], false);
    return solid;
}

// Is the place of a cluster solid when the border of every leaf belongs to it?
static bool solid_closed(struct ray_walk *r, uint32_t from, uint32_t to)
{
    struct walk_lists *w = r->t->lists;
    uint32_t n = from;
    array_reserve(&w->rest, &w->rest_capacity, to);
    memcpy(w->rest, r->items, from * sizeof *w->rest);
    for (uint32_t i = from; i < to; i++) {
        if (r->items[i] & 1)
            step(r, r->items[i], true);
        else
            w->rest[n++] = r->items[i];
    }
    w->replayed = NULL; // the room of `rest` held other crossings before
    bool solid = is_solid(r, w->rest, n);
    w->replayed = NULL;
    for (uint32_t i = from; i < to; i++)
        if (r->items[i] & 1)
            step(r, r->items[i], false);
    return solid;
}

// Does the leaf of crossing c also cross the other way in the cluster? It is too thin to show.
static bool is_paired(const struct ray_walk *r, uint32_t from, uint32_t to, uint32_t c)
{
    for (uint32_t i = from; i < to; i++)
        if (((uint32_t)r->items[i] ^ (uint32_t)r->items[c]) == 1)
            return true;
    return false;
}

// Notes which crossings of a cluster are no surfaces but the border of a region.
static void find_borders(struct ray_walk *r, uint32_t from, uint32_t to)
{
    struct walk_lists *w = r->t->lists;
    float steep;
    array_reserve(&w->border, &w->border_capacity, to - from);
    for (uint32_t i = from; i < to; i++) {
        uint32_t id = (uint32_t)r->items[i];
        w->border[i - from] = tile_face(r->t, &r->t->leaves[id >> 1], r->ray, id & 1,
                                        crossing_key(r->items[i]), &steep) == FACE_REGION;
    }
}

// Of the crossings [from, to) of a cluster that make the state `solid`, the one that does: taken
// one by one they may turn it several times, for there are thin intervals between. The thinnest go
// first, since some are only where two leaves touch. `to` when none turns it.
static uint32_t turning_point(struct ray_walk *r, uint32_t from, uint32_t to, bool solid)
{
    struct walk_lists *w = r->t->lists;
    uint32_t n = from, turns = 0;
    bool now = !solid;
    array_reserve(&w->rest, &w->rest_capacity, to);
    array_reserve(&w->turns, &w->turn_capacity, to - from);
    memcpy(w->rest, r->items, from * sizeof *w->rest);
    for (uint32_t i = from; i < to; i++) {
        if (w->border[i - from] && !(r->items[i] & 1))
            w->rest[n++] = r->items[i];
        else
            step(r, r->items[i], true);
    }
    w->replayed = NULL; // the room of `rest` held other crossings before
    for (uint32_t i = from; i < to; i++) {
        if (w->border[i - from])
            continue;
        step(r, r->items[i], false);
        w->rest[n++] = r->items[i];
        if (is_solid(r, w->rest, n) != now) {
            now = !now;
            w->turns[turns++] = i;
        }
    }
    w->replayed = NULL;
    for (uint32_t i = from; i < to; i++)
        if (w->border[i - from] && r->items[i] & 1)
            step(r, r->items[i], false);
    if (now != solid)
        return to;
    while (turns > 1) {
        uint32_t least = 0;
        float gap = FLT_MAX;
        for (uint32_t k = 0; k + 1 < turns; k++) {
            float d = crossing_key(r->items[w->turns[k + 1]]) - crossing_key(r->items[w->turns[k]]);
            if (d <= gap) {
                gap = d;
                least = k;
            }
        }
        turns -= 2;
        memmove(w->turns + least, w->turns + least + 2, (turns - least) * sizeof *w->turns);
    }
    return w->turns[0];
}

static struct face_at face_of(const struct ray_walk *r, crossing c)
{
    uint32_t id = (uint32_t)c;
    return (struct face_at){&r->t->leaves[id >> 1], id & 1, crossing_key(c)};
}

static uint32_t leaf_of(const struct ray_walk *r, crossing c)
{
    return r->t->leaves[(uint32_t)c >> 1].leaf;
}

// Whether crossing i shows rather than crossing `best`, where the place wants leaves of the given
// kind; 2 for any.
static bool goes_before(const struct ray_walk *r, crossing i, crossing best, int cut)
{
    const struct leaf *leaves = r->t->frame->body->leaves;
    uint32_t a = leaf_of(r, i), b = leaf_of(r, best);
    bool wanted = leaves[a].subtracted == cut, has = leaves[b].subtracted == cut;
    return cut == 2 || wanted == has ? a > b : wanted;
}

// Of the crossings at one place, the one whose surface shows there: of those in one plane with the
// one that turns the state, the latest of the file that matters, because the state would be another
// one without it, or with it alone. A leaf too thin to show gives way to any of these. Of geometry
// it is a cut face where the place is not solid with all borders.
static crossing owner_of(struct ray_walk *r, uint32_t from, uint32_t to, bool solid)
{
    if (to - from == 1)
        return r->items[from];
    find_borders(r, from, to);
    uint32_t turning = turning_point(r, from, to, solid);
    if (turning == to)
        return r->items[from];
    crossing turn = r->items[turning];
    uint32_t best = turning;
    bool weak = is_paired(r, from, to, turning);
    int cut = r->t->frame->body->borders ? !solid_closed(r, from, to) : 2;
    for (uint32_t i = from; i < to; i++) {
        if (i == turning || (!weak && !goes_before(r, r->items[i], r->items[best], cut)) ||
            r->t->lists->border[i - from] || is_paired(r, from, to, i))
            continue;
        if (crossing_key(r->items[i]) != crossing_key(turn) &&
            !tile_coplanar(r->t, r->ray, face_of(r, r->items[i]), face_of(r, turn)))
            continue;
        if (solid_if(r, from, to, i, false) == solid && solid_if(r, from, to, i, true) != solid)
            continue;
        best = i;
        weak = false;
    }
    return r->items[best];
}

// The state changed at the cluster of crossings [from, to). True: the walk is over.
static bool change(struct ray_walk *r, uint32_t from, uint32_t to, bool solid)
{
    crossing c = owner_of(r, from, to, solid);
    r->solid = solid;
    if (r->first_only) {
        r->first_key = crossing_key(c);
        r->first_owner = (int32_t)(uint32_t)c;
        return true;
    }
    if (solid)
        r->entered = boundary_at(r, c);
    else
        add_span(r->t, r->entered, boundary_at(r, c));
    return false;
}

// Walks a sorted list. Returns the number of crossings taken: with `more` to come, the last cluster
// is left for the next list. *over tells that the question is answered.
static uint32_t walk_list(struct ray_walk *r, bool more, bool *over)
{
    uint32_t cluster = 0, i = 0;
    *over = false;
    for (; i < r->count; i++) {
        if (i > cluster && thick(r, r->items[cluster], r->items[i])) {
            bool solid = is_solid(r, r->items, i);
            if (solid != r->solid && change(r, cluster, i, solid)) {
                *over = true;
                return i;
            }
            cluster = i;
        }
        step(r, r->items[i], false);
    }
    if (more)
        return cluster;
    if (r->count) {
        bool solid = is_solid(r, r->items, r->count);
        if (solid != r->solid && change(r, cluster, r->count, solid))
            *over = true;
    }
    return r->count;
}

static void ray_begin(struct ray_walk *r, struct tile *t, int ray, bool first_only)
{
    *r = (struct ray_walk){.t = t,
                           .ray = ray,
                           .first_only = first_only,
                           .array = t->frame->settings->walk == WALK_ARRAY,
                           .first_key = FLT_MAX,
                           .first_owner = -1};
    t->lists->base_count = 0;
    t->lists->replayed = NULL;
    if (r->array)
        memset(t->lists->inside, 0, t->frame->body->leaf_count * sizeof *t->lists->inside);
}

// A solid that reaches the end of the ray.
static void ray_end(struct ray_walk *r)
{
    if (r->solid && !r->first_only)
        add_span(r->t, r->entered, (struct boundary){r->t->frame->end, SURFACE_NONE, SURFACE_CAP});
}

// Makes the combination before items[taken] the base of the next list.
static void carry(struct ray_walk *r, uint32_t taken)
{
    struct walk_lists *w = r->t->lists;
    replay(r->t, r->items, taken);
    array_reserve(&w->base, &w->base_capacity, w->member_count + 1);
    memcpy(w->base, w->members, w->member_count * sizeof *w->base);
    w->base_count = w->member_count;
    w->replayed = NULL;
}

static void walk_in_passes(struct ray_walk *r, struct leaf_range leaves)
{
    struct walk_lists *w = r->t->lists;
    crossing floor = 0, ceiling;
    bool over;
    for (;;) {
        r->items = w->list.items;
        r->count = crossings_nearest(r->t, leaves, r->ray, floor, &w->list, &ceiling);
        bool more = ceiling != UINT64_MAX;
        uint64_t key = r->key;
        uint32_t taken = walk_list(r, more, &over);
        if (over || !more)
            break;
        if (!taken) // one cluster fills the whole list: take it as it is
            taken = r->count;
        r->key = key; // the crossings of the cut-off cluster come again
        for (uint32_t i = 0; i < taken; i++)
            step(r, w->list.items[i], false);
        if (r->array)
            for (uint32_t i = 0; i < r->count; i++)
                r->t->lists->inside[r->t->leaves[(uint32_t)w->list.items[i] >> 1].leaf] -=
                    (uint32_t)w->list.items[i] & 1 ? -1 : 1;
        carry(r, taken);
        floor = w->list.items[taken - 1];
    }
}

struct block_walk {
    bool first_only;
    struct rays_at *out; // first_only
};

static void walk_ray(struct tile *t, struct leaf_range leaves, int p, crossing *items,
                     uint32_t count, bool passes, const struct block_walk *bw)
{
    struct ray_walk r;
    bool over;
    ray_begin(&r, t, p, bw->first_only);
    if (passes) {
        walk_in_passes(&r, leaves);
    } else {
        r.items = crossings_sort(&t->lists->list, items, count);
        r.count = count;
        walk_list(&r, false, &over);
    }
    ray_end(&r);
    if (bw->first_only) {
        bw->out->key[p / BLOCK][p % BLOCK] = r.first_key;
        bw->out->owner[p / BLOCK][p % BLOCK] = r.first_owner;
    }
}

// Rays [from, to) of the block, whose lists fit into memory together unless it is one ray.
static void walk_rays(struct tile *t, struct leaf_range leaves, int from, int to,
                      const uint32_t *counts, const struct block_walk *bw, uint32_t *span_first)
{
    struct walk_lists *w = t->lists;
    uint32_t in[BLOCK_PIXELS], out[BLOCK_PIXELS], start = 0;
    bool passes = to - from == 1 && counts[from] > w->list.size;
    for (int p = from; p < to; p++) {
        in[p] = start;
        out[p] = start + counts[p] / 2;
        start += counts[p];
    }
    if (!passes)
        crossings_fill(t, leaves, from, to, w->list.items, in, out);
    for (int p = from; p < to; p++) {
        if (span_first)
            span_first[p - from] = w->span_count;
        walk_ray(t, leaves, p, w->list.items + (passes ? 0 : out[p] - counts[p]), counts[p], passes,
                 bw);
    }
    if (span_first)
        span_first[to - from] = w->span_count;
}

static uint64_t sum_of(const uint32_t *counts, int from, int to)
{
    uint64_t sum = 0;
    for (int p = from; p < to; p++)
        sum += counts[p];
    return sum;
}

void walk_first(struct tile *t, uint32_t first_leaf, uint32_t count, struct rays_at *out)
{
    uint32_t counts[BLOCK_PIXELS];
    struct leaf_range leaves = {first_leaf, count};
    struct block_walk bw = {.first_only = true, .out = out};
    uint64_t sum = crossings_count(t, leaves, counts);
    t->fragments += sum;
    int group = sum <= t->lists->list.size ? BLOCK_PIXELS : 1;
    for (int p = 0; p < BLOCK_PIXELS; p += group)
        walk_rays(t, leaves, p, p + group, counts, &bw, NULL);
}

void walk_one(struct tile *t, int ray, struct rays_at *out)
{
    uint32_t counts[BLOCK_PIXELS];
    struct leaf_range leaves = {0, t->leaf_count};
    struct block_walk bw = {.first_only = true, .out = out};
    crossings_count(t, leaves, counts);
    walk_rays(t, leaves, ray, ray + 1, counts, &bw, NULL);
}

void walk_block(struct tile *t,
                void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                void *context)
{
    struct walk_lists *w = t->lists;
    uint32_t counts[BLOCK_PIXELS], span_first[BLOCK_PIXELS + 1];
    struct leaf_range leaves = {0, t->leaf_count};
    struct block_walk bw = {0};
    int width = t->x1 - t->bx < BLOCK ? t->x1 - t->bx : BLOCK;
    int height = t->y1 - t->by < BLOCK ? t->y1 - t->by : BLOCK;
    uint64_t sum = crossings_count(t, leaves, counts);
    t->fragments += sum;
    if (!sum && t->frame->settings->sparse)
        return;

    bool whole = sum <= w->list.size && width == BLOCK && height == BLOCK;
    for (int y = 0; y < (whole ? 1 : height); y++) {
        bool row =
            !whole && width == BLOCK && sum_of(counts, y * BLOCK, (y + 1) * BLOCK) <= w->list.size;
        int group = whole ? BLOCK_PIXELS : row ? BLOCK : 1;
        for (int x = 0; x < (group > 1 ? 1 : width); x++) {
            w->span_count = 0;
            walk_rays(t, leaves, y * BLOCK + x, y * BLOCK + x + group, counts, &bw, span_first);
            int x0 = t->bx + x, y0 = t->by + y;
            struct span_block out = {.x0 = x0,
                                     .y0 = y0,
                                     .x1 = x0 + (group > 1 ? BLOCK : 1),
                                     .y1 = y0 + (whole ? BLOCK : 1),
                                     .first = span_first,
                                     .spans = w->spans};
            sink(context, t->worker, &out);
        }
    }
}
