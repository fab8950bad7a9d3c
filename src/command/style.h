// style.h - how pictures are taken, beyond what OpenSCAD knows.
#pragma once
#include "command/options.h"
#include "render/shot.h"
#include "render/views.h"

struct style {
    struct shot_style shot;
    bool fits;
    double margin;
    bool margin_is_share;   // of the picture's shorter side; else it is in pixels
    struct view_list views; // none: one picture from where the camera is
    const char *reference;  // a PNG to compare with, or NULL
    int levels;             // differences of channels up to it do not count
    double share;           // of the pixels that may differ
};

bool style_parse(struct style *out, const struct given *given, struct error *err);
// The margin in pixels of a picture.
double style_margin(const struct style *s, int width, int height);
