// settings.h - what hcsg-view remembers from window to window.
#pragma once
#include "app/drawing.h"

struct settings {
    int width, height; // of the window
    bool orthographic;
    bool status;     // the status line shows
    bool customizer; // its panel is open
    char scheme[64]; // name of the colour scheme
    struct drawing_view view;
};
#define SETTINGS_DEFAULTS                                                                          \
    ((struct settings){.width = 1024, .height = 768, .status = true, .scheme = "Cornfield"})

// From $XDG_CONFIG_HOME/hcsg/view.json or ~/.config/hcsg/view.json. False with *err when the file
// is there and broken. What it does not hold, or wrongly, has its default in any case.
bool settings_read(struct settings *out, struct error *err);
// Keeps what else the file holds.
bool settings_write(const struct settings *s, struct error *err);
bool settings_equal(const struct settings *a, const struct settings *b);
