// store.c - solids by content: equal shapes exist once, and live on from reload to reload.
#include "model/store.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"
#include "geom/border.h"
#include "geom/extrude.h"

#include <pthread.h>
#include <stdlib.h>

enum { KEY_MESH = 0x6d657368, KEY_PLATE = 0x706c6174 };

enum border { BORDER_UNKNOWN, BORDER_NONE, BORDER_LEFT };

struct entry {
    struct solid solid;        // first: a solid's address is its entry's
    struct geometry *geometry; // NULL: a solid; else that and no solid, but for the hash
    uint64_t stamp;            // of the files that the geometry was made from
    uint32_t holders;
    uint32_t generation; // of the last count that saw it
    uint8_t border;      // enum border, of the solid's mesh
    struct entry *older; // of the retired ones
};

// Open addressing over entries by the solid's hash; NULL is free.
struct solid_store {
    pthread_mutex_t lock; // of the slots
    struct entry **slots;
    struct entry *retired;   // geometries that newer ones have replaced
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
    pthread_mutex_init(&s->lock, NULL);
    return s;
}

static void entry_delete(struct entry *e)
{
    if (e->geometry)
        geometry_free(e->geometry);
    free(e->geometry);
    solid_free(&e->solid);
    free(e);
}

static void hold_solids(const struct geometry *g, int by)
{
    if (g->plate)
        ((struct entry *)g->plate)->holders += (uint32_t)by;
    for (uint32_t i = 0; i < g->scene.leaf_count; i++)
        ((struct entry *)g->scene.leaves[i].solid)->holders += (uint32_t)by;
}

static void free_retired(struct solid_store *s, bool release)
{
    for (struct entry *e; (e = s->retired);) {
        s->retired = e->older;
        if (release)
            hold_solids(e->geometry, -1);
        entry_delete(e);
    }
}

static void free_unused(struct solid_store *s)
{
    if (s->wanted || s->models)
        return;
    for (size_t i = 0; i < s->slot_count; i++)
        if (s->slots[i])
            entry_delete(s->slots[i]);
    free_retired(s, false);
    free(s->slots);
    pthread_mutex_destroy(&s->lock);
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
            entry_delete(e);
            continue;
        }
        *find_slot(s, e->solid.hash) = e;
        s->used++;
    }
    free(old);
}

static struct entry *find(struct solid_store *s, uint64_t key)
{
    pthread_mutex_lock(&s->lock);
    struct entry *e = *find_slot(s, key);
    pthread_mutex_unlock(&s->lock);
    return e;
}

// Puts an entry in under its hash, unless the same is there already; returns the one that is there
// then. A geometry made from other states of its files gives way.
static struct entry *add(struct solid_store *s, struct entry *e)
{
    pthread_mutex_lock(&s->lock);
    if ((s->used + 1) * 2 > s->slot_count)
        rebuild(s, s->slot_count * 2, false);
    struct entry **slot = find_slot(s, e->solid.hash), *stays = *slot;
    if (stays && e->geometry && stays->stamp != e->stamp) {
        struct geometry *old = stays->geometry;
        stays->geometry = e->geometry;
        stays->stamp = e->stamp;
        stays->generation = e->generation;
        hold_solids(stays->geometry, 1);
        e->geometry = old; // another thread may be reading it
        e->older = s->retired;
        s->retired = e;
        e = stays;
    } else if (!stays) {
        *slot = stays = e;
        s->used++;
        if (e->geometry)
            hold_solids(e->geometry, 1);
    }
    pthread_mutex_unlock(&s->lock);
    if (stays != e)
        entry_delete(e);
    return stays;
}

const struct solid *store_find(struct solid_store *s, uint64_t key)
{
    struct entry *e = find(s, key);
    return e ? &e->solid : NULL;
}

const struct solid *store_add(struct solid_store *s, uint64_t key, struct mesh *m, bool convex,
                              enum solid_cut cut)
{
    struct entry *e = mem_zalloc(sizeof *e);
    solid_from_mesh(&e->solid, m, convex, key);
    e->solid.cut = cut;
    return &add(s, e)->solid;
}

const struct solid *store_mesh(struct solid_store *s, struct mesh *m, bool convex)
{
    uint64_t key =
        hash_bytes(KEY_MESH + convex, m->vertices, m->vertex_count * sizeof *m->vertices);
    key = hash_bytes(key, m->triangles, m->triangle_count * sizeof *m->triangles);
    const struct solid *solid = store_find(s, key);
    if (!solid)
        return store_add(s, key, m, convex, CUT_TRIANGLES);
    mesh_free(m);
    return solid;
}

bool store_is_closed(struct solid_store *s, const struct solid *solid)
{
    struct entry *e = (struct entry *)solid;
    pthread_mutex_lock(&s->lock);
    uint8_t border = e->border;
    pthread_mutex_unlock(&s->lock);
    if (border == BORDER_UNKNOWN) {
        border = !solid->convex && mesh_has_border(&solid->mesh) ? BORDER_LEFT : BORDER_NONE;
        pthread_mutex_lock(&s->lock);
        e->border = border;
        pthread_mutex_unlock(&s->lock);
    }
    return border == BORDER_NONE;
}

const struct solid *store_plate(struct solid_store *s, const struct outline *o)
{
    uint64_t key = hash_mix(outline_hash(o) + KEY_PLATE);
    const struct solid *solid = store_find(s, key);
    if (solid || !o->path_count)
        return solid;
    struct entry *e = mem_zalloc(sizeof *e);
    struct mesh m;
    bool convex;
    extrude_slab(&m, o, -0.5, 0.5, &convex);
    solid_from_mesh(&e->solid, &m, convex, key);
    e->solid.cut = CUT_SIDES;
    outline_copy(&e->solid.outline, o);
    return &add(s, e)->solid;
}

// ---------------------------------------------------------------- geometries

static uint64_t stamp_of(const struct geometry *g, uint32_t line)
{
    uint64_t stamp = g->messages.count ? line : 0;
    for (uint32_t i = 0; i < g->import_count; i++)
        stamp = stamp * 3 + file_stamp(g->imports[i]);
    return stamp;
}

const struct geometry *store_geometry(struct solid_store *s, uint64_t key, uint32_t line)
{
    pthread_mutex_lock(&s->lock);
    struct entry *e = *find_slot(s, key);
    const struct geometry *g = e ? e->geometry : NULL;
    if (g && e->stamp != stamp_of(g, line))
        g = NULL;
    if (g)
        e->generation = s->generation;
    pthread_mutex_unlock(&s->lock);
    return g;
}

const struct geometry *store_add_geometry(struct solid_store *s, uint64_t key, struct geometry *g)
{
    struct entry *e = mem_zalloc(sizeof *e);
    e->solid.hash = key;
    e->geometry = mem_alloc(sizeof *g);
    e->holders = 1;
    e->generation = s->generation;
    e->stamp = stamp_of(g, g->line);
    *e->geometry = *g;
    *g = (struct geometry){0};
    return add(s, e)->geometry;
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

void store_forget(struct solid_store *s)
{
    free_retired(s, true);
    for (size_t i = 0; i < s->slot_count; i++) {
        struct entry *e = s->slots[i];
        if (!e || !e->geometry || !e->holders || e->generation == s->generation)
            continue;
        hold_solids(e->geometry, -1);
        e->holders = 0;
    }
}

void store_sweep(struct solid_store *s)
{
    rebuild(s, s->slot_count, true);
}
