// store.c - solids by content: equal shapes exist once, and live on from reload to reload.
#include "model/store.h"

#include "base/mem.h"

#include <stdlib.h>

struct entry {
    struct solid solid; // first: a solid's address is its entry's
    uint32_t holders;
    uint32_t generation; // of the last count that saw it
};

// Open addressing over entries by the solid's hash; NULL is free.
struct solid_store {
    struct entry **slots;
    size_t slot_count, used; // slot_count is a power of two, at most half of it used
    uint32_t models;
    bool wanted; // by its maker
    uint32_t generation, counted;
};

struct solid_store *solid_store_new(void)
{
    struct solid_store *s = mem_zalloc(sizeof *s);
    s->slot_count = 64;
    s->slots = mem_zalloc(s->slot_count * sizeof *s->slots);
    s->wanted = true;
    return s;
}

static void free_unused(struct solid_store *s)
{
    if (s->wanted || s->models)
        return;
    for (size_t i = 0; i < s->slot_count; i++)
        if (s->slots[i]) {
            solid_free(&s->slots[i]->solid);
            free(s->slots[i]);
        }
    free(s->slots);
    free(s);
}

void solid_store_delete(struct solid_store *s)
{
    if (!s)
        return;
    s->wanted = false;
    free_unused(s);
}

void store_join(struct solid_store *s)
{
    s->models++;
}

void store_leave(struct solid_store *s)
{
    if (--s->models)
        store_sweep(s);
    free_unused(s);
}

static struct entry **find_slot(const struct solid_store *s, uint64_t key)
{
    size_t at = key & (s->slot_count - 1);
    while (s->slots[at] && s->slots[at]->solid.hash != key)
        at = (at + 1) & (s->slot_count - 1);
    return &s->slots[at];
}

// Moves the entries to a table of the given size; frees those without holders if asked.
static void rebuild(struct solid_store *s, size_t slot_count, bool held_only)
{
    struct entry **old = s->slots;
    size_t old_count = s->slot_count;
    s->slots = mem_zalloc(slot_count * sizeof *s->slots);
    s->slot_count = slot_count;
    s->used = 0;
    for (size_t i = 0; i < old_count; i++) {
        struct entry *e = old[i];
        if (!e)
            continue;
        if (held_only && !e->holders) {
            solid_free(&e->solid);
            free(e);
            continue;
        }
        *find_slot(s, e->solid.hash) = e;
        s->used++;
    }
    free(old);
}

const struct solid *store_find(const struct solid_store *s, uint64_t key)
{
    struct entry *e = *find_slot(s, key);
    return e ? &e->solid : NULL;
}

const struct solid *store_add(struct solid_store *s, uint64_t key, struct mesh *m, bool convex)
{
    if ((s->used + 1) * 2 > s->slot_count)
        rebuild(s, s->slot_count * 2, false);
    struct entry *e = mem_zalloc(sizeof *e);
    solid_from_mesh(&e->solid, m, convex, key);
    *find_slot(s, key) = e;
    s->used++;
    return &e->solid;
}

void store_count_from(struct solid_store *s)
{
    s->generation++;
    s->counted = 0;
}

uint32_t store_counted(const struct solid_store *s)
{
    return s->counted;
}

void store_hold(struct solid_store *s, const struct solid *solid)
{
    struct entry *e = (struct entry *)solid;
    e->holders++;
    if (e->generation != s->generation) {
        e->generation = s->generation;
        s->counted++;
    }
}

void store_release(const struct solid *solid)
{
    ((struct entry *)solid)->holders--;
}

void store_sweep(struct solid_store *s)
{
    rebuild(s, s->slot_count, true);
}
