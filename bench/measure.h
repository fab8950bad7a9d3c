// measure.h - our own times on one scene.
#pragma once
#include "render/choose.h"
#include "result.h"

struct measure_options {
    uint32_t threads, size;
    uint32_t frames;      // of each kind, at most
    double limit;         // seconds for each kind of frame, passed by the last frame at most
    const char *pictures; // folder for a picture of the first view, or NULL
    bool unshared;        // each primitive has a value of its own
    enum device_wish gl;  // DEVICE_CPU: not to be measured; DEVICE_GL: in software too
};

// Fills all but the opponents' fields of *out (freed by the caller also on failure).
bool measure_scene(struct result *out, const char *csg, const struct measure_options *options,
                   struct error *err);
