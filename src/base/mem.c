// mem.c - allocation that cannot fail, growable arrays, and an arena for trees.
#include "base/mem.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *checked(void *p, size_t size)
{
    if (!p && size) {
        fprintf(stderr, "hcsg: out of memory (%zu bytes)\n", size);
        abort();
    }
    return p;
}

void *mem_alloc(size_t size)
{
    return checked(malloc(size), size);
}

void *mem_zalloc(size_t size)
{
    return checked(calloc(1, size), size);
}

void *mem_realloc(void *p, size_t size)
{
    return checked(realloc(p, size ? size : 1), size);
}

void *mem_aligned(size_t alignment, size_t size)
{
    size_t rounded = (size + alignment - 1) / alignment * alignment;
    return checked(aligned_alloc(alignment, rounded ? rounded : alignment), size);
}

char *mem_strdup(const char *s)
{
    size_t size = strlen(s) + 1;
    return memcpy(mem_alloc(size), s, size);
}

void *mem_array_grow(void *items, uint32_t *capacity, size_t needed, size_t item_size)
{
    if (needed <= *capacity)
        return items;
    size_t size = *capacity ? *capacity : 8;
    while (size < needed)
        size += size / 2;
    if (size > UINT32_MAX)
        checked(NULL, size * item_size);
    *capacity = (uint32_t)size;
    return mem_realloc(items, size * item_size);
}

struct arena_block {
    struct arena_block *older;
    size_t size;
    _Alignas(16) unsigned char data[];
};

enum { ARENA_FIRST = 4096, ARENA_LARGEST = 1 << 20 };

void *arena_alloc(struct arena *a, size_t size)
{
    size = (size + 15) & ~(size_t)15;
    if (a->size - a->used < size) {
        size_t next = a->size ? a->size * 2 : ARENA_FIRST;
        if (next > ARENA_LARGEST)
            next = ARENA_LARGEST;
        if (next < size)
            next = size;
        struct arena_block *b = mem_alloc(sizeof *b + next);
        b->older = a->block;
        b->size = next;
        a->block = b;
        a->size = next;
        a->used = 0;
        a->total += sizeof *b + next;
    }
    void *p = a->block->data + a->used;
    a->used += size;
    return p;
}

char *arena_text(struct arena *a, const char *text, size_t length)
{
    char *copy = arena_alloc(a, length + 1);
    memcpy(copy, text, length);
    copy[length] = 0;
    return copy;
}

void arena_free(struct arena *a)
{
    for (struct arena_block *b = a->block, *older; b; b = older) {
        older = b->older;
        free(b);
    }
    *a = (struct arena){0};
}
