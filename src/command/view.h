// view.h - what --view adds to a picture.
#pragma once
#include <stdbool.h>

struct view_options {
    bool axes, crosshairs, edges, scales, wireframe;
};

// Names between commas; as by OpenSCAD, unknown ones only make a message on stderr. NULL: none.
struct view_options view_parse(const char *text);
