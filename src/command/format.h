// format.h - what can be written, by the names that are also the extensions of such files.
#pragma once
#include "model/export.h"

enum output_kind {
    OUTPUT_PICTURE,
    // What pixels show, as numbers:
    OUTPUT_DEPTHMAP,
    OUTPUT_DEPTHS,
    OUTPUT_NORMALS,
    OUTPUT_IDS,
    OUTPUT_GEOMETRY,
    OUTPUT_PARAMETERS, // of the .scad, not of what it makes
};

struct output_format {
    const char *name;
    enum output_kind kind;
    enum export_format geometry; // of OUTPUT_GEOMETRY
};

// NULL when there is none of this name; upper and lower case are the same.
const struct output_format *output_format_find(const char *name);
// "png, stl or off"
void output_format_names(char *text, size_t size);
