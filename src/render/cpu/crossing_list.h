// crossing_list.h - the crossings of the rays of a block, each ray's in the order of depth.
#pragma once
#include "base/sort.h"
#include "render/cpu/tile.h"

#define crossings_count   ISA_PASTE(crossings_count, ISA)
#define crossings_fill    ISA_PASTE(crossings_fill, ISA)
#define crossings_sort    ISA_PASTE(crossings_sort, ISA)
#define crossings_nearest ISA_PASTE(crossings_nearest, ISA)

// A crossing: the key as an ordered number in the high half, tile leaf * 2 + leaving in the low
// half, so that sorting 64-bit numbers sorts crossings.
typedef uint64_t crossing;

struct crossing_list {
    crossing *items, *spare;
    uint32_t size; // room in both
};

struct leaf_range { // of tile.leaves
    uint32_t first, count;
    const uint32_t *among; // NULL, or `count` numbers instead
};

static inline crossing crossing_make(float key, uint32_t leaf, bool leaving)
{
    return (uint64_t)sort_number(key) << 32 | leaf << 1 | leaving;
}

static inline float crossing_key(crossing c)
{
    return sort_float((uint32_t)(c >> 32));
}

// Number of crossings of each ray of the block; returns their sum.
uint64_t crossings_count(struct tile *t, struct leaf_range leaves, uint32_t *counts);

// Writes the crossings of rays [from, to) to items: entries of ray p from in[p] on, exits from
// out[p] on.
void crossings_fill(struct tile *t, struct leaf_range leaves, int from, int to, crossing *items,
                    uint32_t *in, uint32_t *out);
// Sorts the entries items[0 .. n / 2) and the exits behind them and merges the two into
// list->spare.
const crossing *crossings_sort(struct crossing_list *list, crossing *items, uint32_t n);

// The nearest crossings of ray p beyond `floor`, sorted, as many as fit, into list->items; *ceiling
// is the last one taken, or all ones when nothing is left beyond. For rays with more crossings than
// memory.
uint32_t crossings_nearest(struct tile *t, struct leaf_range leaves, int p, crossing floor,
                           struct crossing_list *list, crossing *ceiling);
