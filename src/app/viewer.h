// viewer.h - hcsg-view: one window that shows one file.
#pragma once
#include "app/settings.h"
#include "base/error.h"
#include "render/camera.h"
#include "render/choose.h"
#include "render/scheme.h"

#include <stddef.h>

struct viewer_options {
    const char *path;
    const char *openscad; // NULL: found by scad_start
    struct camera camera;
    bool fixed_camera; // camera as it is; else all of the first model is shown
    const struct scheme *scheme;
    double epsilon;                    // negative: chosen by the model
    const char *const *import_folders; // of struct model_options
    uint32_t import_folder_count;
    enum device_wish device;
    uint32_t threads;
    size_t memory; // of struct render_settings
    int width, height;
    struct settings settings;          // as they were remembered
    bool given_size, given_projection; // by the command line, not from there
    bool watch, stats;
};

// Returns when the window is closed. *ok is false when there was nothing to show and nothing to
// wait for; false with *err set when there is no window.
bool viewer_run(const struct viewer_options *options, bool *ok, struct error *err);
