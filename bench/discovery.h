// discovery.h - three ways to learn a scene's combinations with OpenGL, side by side.
#pragma once
#include "measure.h"

#include <stdio.h>

enum {
    WRONG_SHOWN = 5,    // frames whose wrong pixels are counted
    SCHEME_FRAMES = 60, // most of discovery over frames
    SCHEME_BATCH_SMALL = 128,
};

struct batch_then { // from three sides of so many pixels
    double ms;
    uint32_t combinations;
    uint64_t missing; // of the first picture behind it
};

// Of opaque pictures of the first view, each from an empty table but the known one. Times in ms.
struct discovery_result {
    const struct scene *scene;
    char device[300];
    double known;              // nothing to be learned
    struct render_waits waits; // of it
    // At once: the first picture is exact.
    double exact;
    uint64_t exact_combinations, rounds; // rounds: how often rays were walked again
    uint64_t exact_bytes;                // of the table, sent
    // Over frames, as in section 4.1 of the HCSG paper.
    struct samples frames;
    bool ended; // with nothing missing
    uint64_t frames_combinations, frames_bytes;
    uint32_t wrong[WRONG_SHOWN];    // pixels that are not those of the exact picture
    uint32_t last_wrong;            // of the last frame
    struct batch_then small, large; // section 4.2; large: the side of the picture
};

// False when there is no device, or it fails.
bool discovery_measure(struct discovery_result *out, const struct scene *scene, const char *csg,
                       const struct measure_options *options, struct error *err);
void discovery_free(struct discovery_result *r); // leaves {0}
void discovery_rows(FILE *tsv, const struct discovery_result *r);
// In Markdown.
void discovery_tables(FILE *out, const struct discovery_result *results, uint32_t count,
                      uint32_t size);
