// crossing_list.c - the crossings of the rays of a block, each ray's in the order of depth.
#include "render/cpu/crossing_list.h"

#include <string.h>

static void sort(crossing *items, crossing *spare, uint32_t n)
{
    enum { RUN = 24 };
    for (uint32_t from = 0; from < n; from += RUN) {
        uint32_t to = from + RUN < n ? from + RUN : n;
        for (uint32_t i = from + 1; i < to; i++) {
            crossing c = items[i];
            uint32_t j = i;
            for (; j > from && items[j - 1] > c; j--)
                items[j] = items[j - 1];
            items[j] = c;
        }
    }
    for (uint32_t run = RUN; run < n; run *= 2) {
        for (uint32_t from = 0; from < n; from += 2 * run) {
            uint32_t middle = from + run < n ? from + run : n;
            uint32_t to = from + 2 * run < n ? from + 2 * run : n;
            if (middle >= to || items[middle - 1] <= items[middle])
                continue;
            uint32_t i = 0, size = middle - from, j = middle, out = from;
            memcpy(spare, items + from, size * sizeof *spare);
            while (i < size)
                items[out++] = j < to && items[j] < spare[i] ? items[j++] : spare[i++];
        }
    }
}

static uint32_t leaf_number(struct leaf_range leaves, uint32_t i)
{
    return leaves.among ? leaves.among[i] : leaves.first + i;
}

static inline uint32_t crossings_of(const struct block_leaf *b, int p)
{
    return b->mesh ? 2 * (b->first[p + 1] - b->first[p]) : 2 * (b->enter[p] < b->leave[p]);
}

uint64_t crossings_count(struct tile *t, struct leaf_range leaves, uint32_t *counts)
{
    _Atomic uint64_t *per_leaf = t->frame->settings->crossings;
    uint64_t sum = 0;
    memset(counts, 0, BLOCK_PIXELS * sizeof *counts);
    for (uint32_t i = 0; i < leaves.count; i++) {
        struct tile_leaf *l = &t->leaves[leaf_number(leaves, i)];
        const struct block_leaf *b = tile_crossings(t, l);
        if (!b)
            continue;
        for (int p = 0; p < BLOCK_PIXELS; p++)
            counts[p] += crossings_of(b, p);
        for (int p = 0; p < BLOCK_PIXELS && per_leaf; p++)
            atomic_fetch_add_explicit(&per_leaf[l->leaf], crossings_of(b, p), memory_order_relaxed);
    }
    for (int p = 0; p < BLOCK_PIXELS; p++)
        sum += counts[p];
    return sum;
}

// Leaves come front to back, so entries and exits are each nearly in order.
void crossings_fill(struct tile *t, struct leaf_range leaves, int from, int to, crossing *items,
                    uint32_t *in, uint32_t *out)
{
    for (uint32_t i = 0; i < leaves.count; i++) {
        uint32_t l = leaf_number(leaves, i);
        const struct block_leaf *b = tile_crossings(t, &t->leaves[l]);
        if (!b)
            continue;
        for (int p = from; p < to; p++) {
            if (!b->mesh) {
                if (!(b->enter[p] < b->leave[p]))
                    continue;
                items[in[p]++] = crossing_make(b->enter[p], l, false);
                items[out[p]++] = crossing_make(b->leave[p], l, true);
                continue;
            }
            for (uint32_t k = b->first[p]; k < b->first[p + 1]; k++) {
                const struct mesh_interval *m = &t->mesh.intervals[b->interval + k];
                items[in[p]++] = crossing_make(m->enter, l, false);
                items[out[p]++] = crossing_make(m->leave, l, true);
            }
        }
    }
}

const crossing *crossings_sort(struct crossing_list *list, crossing *items, uint32_t n)
{
    crossing *spare = list->spare;
    uint32_t half = n / 2, i = 0, j = half, k = 0;
    sort(items, spare, half);
    sort(items + half, spare, half);
    while (i < half)
        spare[k++] = j < n && items[j] < items[i] ? items[j++] : items[i++];
    memcpy(spare + k, items + j, (n - j) * sizeof *spare);
    return spare;
}

static void keep_nearest(struct crossing_list *w, uint32_t *n, crossing *ceiling)
{
    sort(w->items, w->spare, *n);
    *n = w->size / 2;
    *ceiling = w->items[*n - 1];
}

static void offer(struct crossing_list *w, uint32_t *n, crossing c, crossing floor,
                  crossing *ceiling)
{
    if (c <= floor || c > *ceiling)
        return;
    if (*n == w->size)
        keep_nearest(w, n, ceiling);
    if (c <= *ceiling)
        w->items[(*n)++] = c;
}

uint32_t crossings_nearest(struct tile *t, struct leaf_range leaves, int p, crossing floor,
                           struct crossing_list *list, crossing *ceiling)
{
    uint32_t n = 0;
    *ceiling = UINT64_MAX;
    for (uint32_t i = 0; i < leaves.count; i++) {
        uint32_t l = leaf_number(leaves, i);
        const struct block_leaf *b = tile_crossings(t, &t->leaves[l]);
        if (!b)
            continue;
        if (!b->mesh) {
            if (b->enter[p] < b->leave[p]) {
                offer(list, &n, crossing_make(b->enter[p], l, false), floor, ceiling);
                offer(list, &n, crossing_make(b->leave[p], l, true), floor, ceiling);
            }
            continue;
        }
        for (uint32_t k = b->first[p]; k < b->first[p + 1]; k++) {
            const struct mesh_interval *m = &t->mesh.intervals[b->interval + k];
            offer(list, &n, crossing_make(m->enter, l, false), floor, ceiling);
            offer(list, &n, crossing_make(m->leave, l, true), floor, ceiling);
        }
    }
    sort(list->items, list->spare, n);
    return n;
}
