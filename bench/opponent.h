// opponent.h - OpenCSG on the same scene, in a child; and whole processes against openscad.
#pragma once
#include "result.h"

struct opponent_options {
    const char *program; // hcsg-bench-opencsg
    uint32_t size, threads;
    double limit;         // seconds of frames of one setting
    const char *pictures; // folder for a picture of the first view, or NULL
};

// Fills the opponents' fields of *out.
bool opponent_measure(struct result *out, const char *csg, const struct opponent_options *options,
                      struct error *err);

struct process_result {
    const char *file;            // borrowed
    struct samples ours, theirs; // ms
};
// Draws `csg` several times with hcsg-render (at `render`) and with openscad, 512 x 512.
bool process_measure(struct process_result *out, const char *csg, const char *render,
                     struct error *err);
void process_free(struct process_result *p); // leaves {0}
