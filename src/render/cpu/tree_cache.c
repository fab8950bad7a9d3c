// tree_cache.c - the trees of the mesh solids drawn lately.
#include "render/cpu/tree_cache.h"

#include "base/hash.h"
#include "base/mem.h"

#include <stdlib.h>

// A picture takes a drawing for each of its bodies, so a tree rests for some drawings between two
// uses.
enum { DRAWINGS_KEPT = 300, SWEEP = 64, FIRST_CAPACITY = 16 };

struct tree_entry {
    const struct solid *solid; // NULL: free. Its memory may be gone: only compared, with the hash
    uint64_t hash;             // of the content, so that another solid at the address is seen
    uint32_t used;             // time of the newest use
    struct mesh_tree *tree;
};

static struct tree_entry *find(const struct tree_cache *c, const struct solid *s)
{
    uint32_t at = (uint32_t)hash_mix((uint64_t)(uintptr_t)s);
    for (;; at++) {
        struct tree_entry *e = &c->entries[at & (c->capacity - 1)];
        if (!e->solid || (e->solid == s && e->hash == s->hash))
            return e;
    }
}

static void drop(struct tree_entry *e)
{
    if (e->tree)
        mesh_tree_free(e->tree);
    free(e->tree);
    *e = (struct tree_entry){0};
}

// Moves the entries used not longer than `oldest` drawings ago into a table of the given size;
// drops the others.
static void rebuild(struct tree_cache *c, uint32_t capacity, uint32_t oldest)
{
    struct tree_cache old = *c;
    c->entries = mem_zalloc(capacity * sizeof *c->entries);
    c->capacity = capacity;
    c->count = 0;
    for (uint32_t i = 0; i < old.capacity; i++) {
        struct tree_entry *e = &old.entries[i];
        if (!e->solid)
            continue;
        if (c->time - e->used > oldest) {
            drop(e);
            continue;
        }
        uint32_t at = (uint32_t)hash_mix((uint64_t)(uintptr_t)e->solid);
        while (c->entries[at & (capacity - 1)].solid)
            at++;
        c->entries[at & (capacity - 1)] = *e;
        c->count++;
    }
    free(old.entries);
}

const struct mesh_tree *tree_cache_get(struct tree_cache *c, const struct solid *s)
{
    if (2 * (c->count + 1) > c->capacity)
        rebuild(c, c->capacity ? 2 * c->capacity : FIRST_CAPACITY, UINT32_MAX);
    struct tree_entry *e = find(c, s);
    if (!e->solid) {
        *e = (struct tree_entry){.solid = s, .hash = s->hash, .tree = mem_alloc(sizeof *e->tree)};
        mesh_tree_build(e->tree, &s->mesh);
        c->count++;
    }
    e->used = c->time;
    return e->tree;
}

void tree_cache_tick(struct tree_cache *c)
{
    if (++c->time % SWEEP == 0 && c->count)
        rebuild(c, c->capacity, DRAWINGS_KEPT);
}

void tree_cache_free(struct tree_cache *c)
{
    for (uint32_t i = 0; i < c->capacity; i++)
        drop(&c->entries[i]);
    free(c->entries);
    *c = (struct tree_cache){0};
}
