// tree_cache.h - the trees of the mesh solids drawn lately.
#pragma once
#include "render/cpu/mesh_tree.h"

struct tree_cache {             // {0} is a valid empty cache
    struct tree_entry *entries; // open addressing by the solid's address
    uint32_t count, capacity;   // capacity 0 or a power of 2
    uint32_t time;              // counts tree_cache_tick
};

// The tree of a solid, made when it is not there yet. Valid until the next tree_cache_tick.
const struct mesh_tree *tree_cache_get(struct tree_cache *c, const struct solid *s);
// Once a drawing: drops the trees that nobody has asked for in many drawings.
void tree_cache_tick(struct tree_cache *c);
void tree_cache_free(struct tree_cache *c); // leaves {0}
