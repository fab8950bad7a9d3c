// sort.c - radix sort of numbered keys, a byte at a time from the lowest.
#include "base/sort.h"

enum { DIGITS = 256 };

void sort_items(struct sort_item *items, struct sort_item *spare, uint32_t n)
{
    struct sort_item *from = items, *to = spare;
    for (int shift = 0; shift < 64; shift += 8) {
        uint32_t place[DIGITS] = {0}, sum = 0;
        for (uint32_t i = 0; i < n; i++)
            place[from[i].key >> shift & (DIGITS - 1)]++;
        if (n && place[from[0].key >> shift & (DIGITS - 1)] == n)
            continue; // the same byte everywhere
        for (int d = 0; d < DIGITS; d++) {
            uint32_t count = place[d];
            place[d] = sum;
            sum += count;
        }
        for (uint32_t i = 0; i < n; i++)
            to[place[from[i].key >> shift & (DIGITS - 1)]++] = from[i];
        struct sort_item *swap = from;
        from = to;
        to = swap;
    }
    if (from != items && n)
        memcpy(items, from, n * sizeof *items);
}
