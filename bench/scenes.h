// scenes.h - the table scenes.txt.
#pragma once
#include "base/error.h"

struct scene {
    char name[64];
    double at_least, after; // OpenCSG's time over ours; 0: left out
};

struct scenes { // {0} is valid
    struct scene *items;
    uint32_t count, capacity;
};

bool scenes_read(struct scenes *out, const char *path, struct error *err);
void scenes_free(struct scenes *s); // leaves {0}
