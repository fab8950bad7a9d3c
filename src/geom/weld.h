// weld.h - points that are equal in coordinates become one.
#pragma once
#include "geom/mesh.h"

// Points numbered in the order in which they first came; equal ones share a number (0 equals -0).
// {0} is a valid empty one.
struct welder {
    struct vec3 *points;
    uint32_t count, room;
    uint64_t *slots; // open addressing: 32 bits of the hash, then the number + 1
    size_t size;     // of slots, a power of two
};

// Makes room for so many different points at once: growing costs time.
void welder_expect(struct welder *w, uint32_t count);
enum { WELD_BLOCK = 48 };
// Up to WELD_BLOCK points, whose places in memory are fetched together.
void welder_add(struct welder *w, const struct vec3 *points, uint32_t count, uint32_t *numbers);
void welder_free(struct welder *w); // leaves {0}
