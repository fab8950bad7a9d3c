// panel_sets.h - the file of parameter sets beside the .scad: choose one, save, delete.
#pragma once
#include "base/error.h"
#include "customizer/sets.h"

struct panel_sets { // {0} is valid
    char *path;     // of the file; NULL: not looked for yet
    uint64_t stamp; // of the file as it was read
    struct parameter_sets sets;
    char name[100];   // of the set that was chosen, or is to be saved
    struct error odd; // what went wrong the last time, or ""
};
void panel_sets_free(struct panel_sets *s); // leaves {0}

// Three rows of the customizer. True when values were changed.
bool panel_sets_draw(struct panel_sets *s, struct parameters *p, const char *scad);
