// index.c - parameters by name.
#include "customizer/index.h"

#include <stdlib.h>
#include <string.h>

static int by_name(const void *a, const void *b, void *items)
{
    const struct parameter *p = items;
    return strcmp(p[*(const uint32_t *)a].name, p[*(const uint32_t *)b].name);
}

void index_make(struct name_index *out, const struct parameters *p)
{
    *out = (struct name_index){p->items, mem_alloc((p->count + 1) * sizeof *out->sorted), p->count};
    for (uint32_t i = 0; i < p->count; i++)
        out->sorted[i] = i;
    qsort_r(out->sorted, p->count, sizeof *out->sorted, by_name, p->items);
}

void index_free(struct name_index *n)
{
    free(n->sorted);
    *n = (struct name_index){0};
}

uint32_t index_find(const struct name_index *n, const char *name)
{
    uint32_t below = 0, above = n->count;
    while (below < above) {
        uint32_t middle = below + (above - below) / 2;
        int order = strcmp(n->items[n->sorted[middle]].name, name);
        if (order == 0)
            return n->sorted[middle];
        if (order < 0)
            below = middle + 1;
        else
            above = middle;
    }
    return n->count;
}
