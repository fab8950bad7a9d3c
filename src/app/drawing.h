// drawing.h - draws pictures on a thread of its own: always the newest that was asked for.
#pragma once
#include "app/loader.h"
#include "render/camera.h"
#include "render/device.h"
#include "render/scheme.h"

struct drawing_view { // what is drawn besides the model, as --view of hcsg-render
    bool axes, scales, crosshairs, edges;
};

struct drawing_job {
    struct loaded *loaded; // borrowed when asked; held by the shot
    struct camera camera;
    const struct scheme *scheme; // borrowed for good
    struct drawing_view view;
    int width, height;         // of the picture
    int for_width, for_height; // pixels of the window that it stands for
    int divisor;               // how many of them, across, one pixel of the picture stands for
    struct render_settings settings;
    double asked; // clock_seconds
};

struct shot { // {0} is a valid empty shot
    struct drawing_job job;
    uint8_t *rgb; // rows from the top without padding
    size_t capacity;
    double begun, done; // clock_seconds
    struct render_stats stats;
    uint64_t combinations; // known after it
};

void shot_free(struct shot *s); // leaves {0}

struct drawing;
// Takes the device over. `done` is called from the drawing thread after each shot.
struct drawing *drawing_start(struct device *device, void (*done)(void *context), void *context,
                              struct error *err);
// Replaces what was asked for before and is not begun yet. A finer picture that is being drawn is
// given up: then no shot comes of it.
void drawing_ask(struct drawing *d, const struct drawing_job *job);
// That of the device, from any thread.
bool drawing_failed(struct drawing *d, struct error *why);
// Exchanges *shot for the newest one; false when there is none since the last call.
bool drawing_take(struct drawing *d, struct shot *shot);
// Gives up the picture that is being drawn: no shot comes of it.
void drawing_cancel(struct drawing *d);
void drawing_stop(struct drawing *d);
