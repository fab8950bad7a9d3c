// query_leaf.h - queries of one leaf: a block of rays moves into it or out of it.
#pragma once
#include "render/cpu/query_tree.h"

#define query_leaf_in  ISA_PASTE(query_leaf_in, ISA)
#define query_leaf_out ISA_PASTE(query_leaf_out, ISA)
#define query_nearer   ISA_PASTE(query_nearer, ISA)

// Moves each ray to where it is next inside a leaf of the tile, or next outside of it. False when
// none moved. Nothing is done for a leaf that begins beyond `high`, where no ray is.
bool query_leaf_in(struct query *q, uint32_t index, struct rays_at *s);
bool query_leaf_out(struct query *q, uint32_t index, float high, struct rays_at *s);

// s = the nearer of s and other, ray by ray.
void query_nearer(struct query *q, struct rays_at *s, const struct rays_at *other);

// Of the rays that still have something ahead.
static inline float rays_highest(const struct rays_at *s)
{
    v8f m = v8_set(-NEVER);
    for (int y = 0; y < BLOCK; y++)
        m = v8_max(m, v8_select(s->key[y] < v8_set(NEVER), s->key[y], v8_set(-NEVER)));
    return v8_highest(m);
}

static inline float rays_lowest(const struct rays_at *s)
{
    v8f m = v8_set(NEVER);
    for (int y = 0; y < BLOCK; y++)
        m = v8_min(m, s->key[y]);
    return v8_lowest(m);
}

// Leaves nothing ahead of any ray; false when that was so already.
static inline bool rays_kill(struct rays_at *s)
{
    bool changed = rays_lowest(s) < NEVER;
    for (int y = 0; y < BLOCK; y++)
        s->key[y] = v8_set(NEVER);
    return changed;
}

static inline bool rays_differ(const struct rays_at *a, const struct rays_at *b)
{
    v8i d = v8_seti(0);
    for (int y = 0; y < BLOCK; y++)
        d |= a->key[y] != b->key[y];
    return v8_bits(d);
}
