// walk.h - the classification walk: crossings of a ray in order of depth, one key of the
// combination.
//
// Algorithms 1 and 3 of Zanni, Claux, Lefebvre 2018. Each crossing adds or takes the value of its
// leaf's class; the hash table says whether the sum is solid; an unknown sum is evaluated at the
// spot and remembered, so no picture is ever wrong. Intervals thinner than epsilon across their
// faces do not count.
#pragma once
#include "render/cpu/tile.h"

struct rays_at;
struct walk_lists;

#define walk_first  ISA_PASTE(walk_first, ISA)
#define walk_some   ISA_PASTE(walk_some, ISA)
#define walk_new    ISA_PASTE(walk_new, ISA)
#define walk_bytes  ISA_PASTE(walk_bytes, ISA)
#define walk_delete ISA_PASTE(walk_delete, ISA)
#define walk_block  ISA_PASTE(walk_block, ISA)

struct walk_lists *walk_new(struct tile_room room);
size_t walk_bytes(const struct walk_lists *w);
void walk_delete(struct walk_lists *w);

// First solid key of every ray of the block, with only the given leaves of the tile.
void walk_first(struct tile *t, uint32_t first_leaf, uint32_t count, struct rays_at *out);

// The same for some rays, a bit each, and all leaves of the tile.
void walk_some(struct tile *t, uint64_t rays, struct rays_at *out);

// All solid intervals of the rays of the block that lie in the picture, given to the sink.
void walk_block(struct tile *t,
                void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                void *context);
