// scheme.h - OpenSCAD's colour schemes.
#pragma once
#include "base/error.h"

struct rgb {
    uint8_t r, g, b;
};

struct scheme {
    const char *name;
    struct rgb background, background_bottom; // the same in all but those with a gradient
    struct rgb axes, crosshair;
    struct rgb front, back; // what leaves without a colour show: material, and where it is cut
    struct rgb mesh_front, mesh_back, flat; // the same of evaluated geometry, and of 2D shapes
    struct rgb edge_front, edge_back, edge_flat;
};

// In OpenSCAD's order; the first is the default. *count receives their number.
const struct scheme *scheme_list(uint32_t *count);
// NULL with *err naming all schemes when there is none of this name.
const struct scheme *scheme_find(const char *name, struct error *err);
