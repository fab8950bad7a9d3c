// read_svg.h - flat shapes from SVG pictures.
#pragma once
#include "base/error.h"
#include "geom/outline.h"
#include "geom/primitives.h"

#include <stddef.h>

struct svg_options {
    double dpi; // of sizes without unit; OpenSCAD's default is 72
    bool center;
    const char *id, *layer; // the parts wanted; NULL or "": all
    bool newer;             // rules of OpenSCAD after 2021.01: `detail`, `id` and `layer` count
    struct detail detail;
};

bool read_svg(const char *path, const char *data, size_t size, const struct svg_options *options,
              struct outline *out, struct messages *messages, struct error *err);
