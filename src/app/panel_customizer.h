// panel_customizer.h - the parameters of the .scad, to be changed.
#pragma once
#include "app/gui.h"
#include "customizer/parameters.h"

struct panel_customizer { // {0} is valid
    char search[100];
};

// Changes values in place; true when it did.
bool panel_customizer_draw(struct panel_customizer *c, struct parameters *p,
                           const struct gui_box *box, bool *open);
