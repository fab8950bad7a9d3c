// weld.c - points that are equal in coordinates become one.
#include "geom/weld.h"

#include <stdlib.h>
#include <string.h>

// Coordinates are read from single precision or short decimals: the low bits of their doubles are
// often all zero, so each step brings the high bits down. 32 bits are the hash; its low ones choose
// the slot, all of them stand in it.
static uint32_t hash_point(struct vec3 p)
{
    double key[3] = {p.x + 0.0, p.y + 0.0, p.z + 0.0}; // -0 becomes 0
    uint64_t bits[3], h = 0;
    memcpy(bits, key, sizeof bits);
    for (int i = 0; i < 3; i++) {
        h = (h ^ bits[i]) * 0x9e3779b97f4a7c15u;
        h ^= h >> 32;
    }
    return (uint32_t)(h * 0xbf58476d1ce4e5b9u >> 32);
}

static void grow(struct welder *w, size_t size)
{
    uint64_t *slots = mem_zalloc(size * sizeof *slots);
    for (size_t i = 0; i < w->size; i++) {
        if (!w->slots[i])
            continue;
        size_t at = w->slots[i] >> 32 & (size - 1);
        while (slots[at])
            at = (at + 1) & (size - 1);
        slots[at] = w->slots[i];
    }
    free(w->slots);
    w->slots = slots;
    w->size = size;
}

void welder_expect(struct welder *w, uint32_t count)
{
    size_t size = w->size ? w->size : 256;
    while (size < (size_t)count * 2)
        size *= 2;
    if (size > w->size)
        grow(w, size);
}

static uint32_t find(struct welder *w, uint32_t hash, struct vec3 p)
{
    size_t mask = w->size - 1, at = hash & mask;
    for (uint64_t slot; (slot = w->slots[at]); at = (at + 1) & mask) {
        if (slot >> 32 != hash)
            continue;
        struct vec3 q = w->points[(uint32_t)slot - 1];
        if (q.x == p.x && q.y == p.y && q.z == p.z)
            return (uint32_t)slot - 1;
    }
    w->points[w->count++] = p;
    w->slots[at] = (uint64_t)hash << 32 | w->count;
    return w->count - 1;
}

void welder_add(struct welder *w, const struct vec3 *points, uint32_t count, uint32_t *numbers)
{
    uint32_t hashes[WELD_BLOCK];
    welder_expect(w, w->count + count);
    array_reserve(&w->points, &w->room, (size_t)w->count + count);
    for (uint32_t i = 0; i < count; i++) {
        hashes[i] = hash_point(points[i]);
        __builtin_prefetch(&w->slots[hashes[i] & (w->size - 1)]);
    }
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = find(w, hashes[i], points[i]);
}

void welder_free(struct welder *w)
{
    free(w->points);
    free(w->slots);
    *w = (struct welder){0};
}

void mesh_weld(struct mesh *m)
{
    struct welder w = {0};
    uint32_t *number = mem_alloc((size_t)m->vertex_count * sizeof *number);
    for (uint32_t v = 0, n; v < m->vertex_count; v += n) {
        n = m->vertex_count - v < WELD_BLOCK ? m->vertex_count - v : WELD_BLOCK;
        welder_add(&w, m->vertices + v, n, number + v);
    }
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            m->triangles[t][i] = number[m->triangles[t][i]];
    free(number);
    free(m->vertices);
    m->vertices = w.points;
    m->vertex_count = w.count;
    w.points = NULL;
    welder_free(&w);
    mesh_drop_unused(m);
}
