// index.h - parameters by name.
#pragma once
#include "customizer/parameters.h"

struct name_index {
    const struct parameter *items; // borrowed
    uint32_t *sorted;
    uint32_t count;
};

void index_make(struct name_index *out, const struct parameters *p);
void index_free(struct name_index *n); // leaves {0}
// The number of parameters when there is none of this name.
uint32_t index_find(const struct name_index *n, const char *name);
