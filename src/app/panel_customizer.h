// panel_customizer.h - the parameters of the .scad, to be changed.
#pragma once
#include "app/gui.h"
#include "app/panel_sets.h"
#include "customizer/parameters.h"

struct panel_customizer { // {0} is valid
    char search[100];
    struct panel_sets sets;
};

// Changes values in place; true when it did. The path is that of the .scad.
bool panel_customizer_draw(struct panel_customizer *c, struct parameters *p, const char *path,
                           const struct gui_box *box, bool *open);
