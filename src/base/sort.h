// sort.h - radix sort of numbered keys, for lists of many thousands that are sorted every frame.
#pragma once
#include <stdint.h>
#include <string.h>

struct sort_item {
    uint64_t key;
    uint32_t index;
};

// Sorts by key; equal keys keep their order. `spare` is room for n items.
void sort_items(struct sort_item *items, struct sort_item *spare, uint32_t n);

// A number that orders as the float does (not a NaN), and back.
static inline uint32_t sort_number(float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

static inline float sort_float(uint32_t number)
{
    uint32_t bits = number & 0x80000000u ? number & 0x7fffffffu : ~number;
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}
