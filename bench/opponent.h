// opponent.h - OpenCSG on the same scene, in a child; and whole processes against openscad.
#pragma once
#include "result.h"

struct opponent_options {
    const char *program; // hcsg-bench-opencsg
    uint32_t size, threads;
    double limit;         // seconds of frames of one setting
    const char *pictures; // folder for a picture of the first view, or NULL
};

// Fills the field of one of the settings in *out, and those of all of them.
bool opponent_measure_setting(struct result *out, int setting, const char *csg,
                              const struct opponent_options *options, struct error *err);
bool opponent_measure(struct result *out, const char *csg, const struct opponent_options *options,
                      struct error *err);

// One program's runs on a file.
struct process_side {
    struct samples times; // ms
    size_t peak_bytes;    // most memory of any run
};
struct process_result {
    const char *file; // borrowed
    struct process_side ours, theirs;
    bool late; // openscad was stopped, at the time that stands there
};
// Draws `csg` several times with hcsg-render (at `render`), without a display, and with openscad,
// 512 x 512. What takes openscad a minute is not repeated.
bool process_measure(struct process_result *out, const char *csg, const char *render,
                     struct error *err);
void process_free(struct process_result *p); // leaves {0}
