// mem.h - allocation that cannot fail, growable arrays, and an arena for trees.
#pragma once
#include <stddef.h>
#include <stdint.h>

// Out of memory ends the program with one line on stderr: no caller could do better.
void *mem_alloc(size_t size);  // uninitialised
void *mem_zalloc(size_t size); // zeroed
void *mem_realloc(void *p, size_t size);
void *mem_aligned(size_t alignment, size_t size); // for SIMD; free() frees it
char *mem_strdup(const char *s);

#define array_count(a) (sizeof(a) / sizeof((a)[0]))

// array_reserve(&items, &capacity, needed): grows items geometrically to hold needed elements.
#define array_reserve(items, capacity, needed)                                                     \
    (*(items) = mem_array_grow(*(items), (capacity), (needed), sizeof(**(items))))
void *mem_array_grow(void *items, uint32_t *capacity, size_t needed, size_t item_size);

// Memory given out in order and freed all at once. {0} is a valid empty arena.
struct arena {
    struct arena_block *block; // the newest one
    size_t used, size;         // of the newest block
    size_t total;              // bytes taken from the system
};

void *arena_alloc(struct arena *a, size_t size); // uninitialised, aligned to 16 bytes
char *arena_text(struct arena *a, const char *text, size_t length); // copies and terminates
void arena_free(struct arena *a);                                   // leaves {0}
