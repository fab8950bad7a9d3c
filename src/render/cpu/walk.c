// walk.c - the classification walk over the sorted crossings of each ray.
#include "render/cpu/walk.h"

#include "base/mem.h"
#include "render/cpu/cluster.h"
#include "render/cpu/query.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

struct walk_lists {
    struct tile_room room;
    struct crossing_list list;
    struct combination combination;
    struct cluster_room cluster;
    uint32_t *present; // leaves of the tile that are in the block
    uint32_t present_capacity;
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
    combination_init(&w->combination, room);
    w->room = room;
    return w;
}

size_t walk_bytes(const struct walk_lists *w)
{
    return w->list.size * 2 * sizeof(crossing) + combination_bytes(&w->combination, w->room) +
           cluster_room_bytes(&w->cluster) + w->present_capacity * sizeof *w->present +
           w->span_capacity * sizeof *w->spans;
}

void walk_delete(struct walk_lists *w)
{
    if (!w)
        return;
    free(w->list.items);
    free(w->list.spare);
    combination_free(&w->combination);
    cluster_room_free(&w->cluster);
    free(w->present);
    free(w->spans);
    free(w);
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
    struct combination *combination; // around the current interval
    int ray;
    const crossing *items;
    uint32_t count;
    bool first_only;
    // carried from list to list of one ray
    bool solid;
    struct boundary entered;
    float first_key; // answers of first_only
    int32_t first_owner;
};

// Where showing ends, everything that is left ends.
static bool is_end(const struct ray_walk *r, crossing c)
{
    return c & 1 && crossing_key(c) >= r->t->frame->end;
}

static float steep_at(struct ray_walk *r, crossing c)
{
    float steep;
    uint32_t id = (uint32_t)c;
    if (is_end(r, c))
        return 1;
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

// Does a cluster begin at crossing i, behind the one that begins at `cluster`? All crossings at one
// depth belong to one cluster: the steepest face there decides.
static bool begins(struct ray_walk *r, uint32_t cluster, uint32_t i)
{
    float key = crossing_key(r->items[i]);
    if (i == cluster || key <= crossing_key(r->items[i - 1]))
        return false;
    for (; i < r->count && crossing_key(r->items[i]) == key; i++)
        if (thick(r, r->items[cluster], r->items[i]))
            return true;
    return false;
}

static struct boundary boundary_at(struct ray_walk *r, crossing c)
{
    float steep;
    uint32_t id = (uint32_t)c;
    struct tile_leaf *l = &r->t->leaves[id >> 1];
    float key = crossing_key(c);
    uint32_t face = tile_face(r->t, l, r->ray, id & 1, key, &steep);
    return (struct boundary){
        .key = key, .leaf = l->leaf, .face = face == FACE_REGION ? SURFACE_CAP : face};
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

// The state changed at the cluster of crossings [from, to). True: the walk is over.
static bool change(struct ray_walk *r, uint32_t from, uint32_t to, bool solid)
{
    struct cluster cluster = {.ray = r->ray,
                              .items = r->items,
                              .from = from,
                              .to = to,
                              .behind = r->combination,
                              .room = &r->t->lists->cluster};
    crossing c = cluster_owner(&cluster, solid);
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
    for (; i < r->count && !is_end(r, r->items[i]); i++) {
        if (begins(r, cluster, i)) {
            bool solid = combination_is_solid(r->combination, r->items, i);
            if (solid != r->solid && change(r, cluster, i, solid)) {
                *over = true;
                return i;
            }
            cluster = i;
        }
        combination_step(r->combination, r->items[i], false);
    }
    bool end = i < r->count;
    if (more && !end)
        return cluster;
    *over = end;
    if (i) {
        bool solid = combination_is_solid(r->combination, r->items, i);
        if (solid && end && !thick(r, r->items[cluster], r->items[i]))
            solid = r->solid; // nothing begins there any more
        if (solid != r->solid && change(r, cluster, i, solid))
            *over = true;
    }
    return r->count;
}

static void ray_begin(struct ray_walk *r, struct tile *t, int ray, bool first_only)
{
    *r = (struct ray_walk){.t = t,
                           .combination = &t->lists->combination,
                           .ray = ray,
                           .first_only = first_only,
                           .first_key = FLT_MAX,
                           .first_owner = -1};
    combination_begin(r->combination, t);
}

// A solid that reaches the end of the ray.
static void ray_end(struct ray_walk *r)
{
    if (r->solid && !r->first_only)
        add_span(r->t, r->entered, (struct boundary){r->t->frame->end, SURFACE_NONE, SURFACE_CAP});
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
        uint32_t taken = walk_list(r, more, &over);
        if (over || !more)
            break;
        if (!taken) // one cluster fills the whole list: take it as it is
            taken = r->count;
        for (uint32_t i = taken; i < r->count; i++) // the cut-off cluster comes again
            combination_step(r->combination, r->items[i], true);
        combination_carry(r->combination, r->items, taken);
        floor = r->items[taken - 1];
    }
}

static void walk_ray(struct tile *t, struct leaf_range leaves, int p, crossing *items,
                     uint32_t count, bool passes, struct rays_at *first)
{
    struct ray_walk r;
    bool over;
    ray_begin(&r, t, p, first != NULL);
    if (passes) {
        walk_in_passes(&r, leaves);
    } else {
        r.items = crossings_sort(&t->lists->list, items, count);
        r.count = count;
        walk_list(&r, false, &over);
    }
    ray_end(&r);
    if (first) {
        first->key[p / BLOCK][p % BLOCK] = r.first_key;
        first->owner[p / BLOCK][p % BLOCK] = r.first_owner;
    }
}

// Rays [from, to) of the block, whose lists fit into memory together unless it is one ray.
static void walk_rays(struct tile *t, struct leaf_range leaves, int from, int to,
                      const uint32_t *counts, struct rays_at *first, uint32_t *span_first)
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
                 first);
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
    struct leaf_range leaves = {.first = first_leaf, .count = count};
    uint64_t sum = crossings_count(t, leaves, counts);
    t->fragments += sum;
    int group = sum <= t->lists->list.size ? BLOCK_PIXELS : 1;
    for (int p = 0; p < BLOCK_PIXELS; p += group)
        walk_rays(t, leaves, p, p + group, counts, out, NULL);
}

void walk_some(struct tile *t, uint64_t rays, struct rays_at *out)
{
    struct walk_lists *w = t->lists;
    uint32_t counts[BLOCK_PIXELS];
    array_reserve(&w->present, &w->present_capacity, t->leaf_count);
    struct leaf_range leaves = {.among = w->present};
    for (uint32_t i = 0; i < t->leaf_count; i++)
        if (tile_crossings(t, &t->leaves[i]))
            w->present[leaves.count++] = i;
    crossings_count(t, leaves, counts);
    for (; rays; rays &= rays - 1) {
        int ray = __builtin_ctzll(rays);
        walk_rays(t, leaves, ray, ray + 1, counts, out, NULL);
    }
}

void walk_block(struct tile *t,
                void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                void *context)
{
    struct walk_lists *w = t->lists;
    uint32_t counts[BLOCK_PIXELS], span_first[BLOCK_PIXELS + 1];
    struct leaf_range leaves = {.count = t->leaf_count};
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
            walk_rays(t, leaves, y * BLOCK + x, y * BLOCK + x + group, counts, NULL, span_first);
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
