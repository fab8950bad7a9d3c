// result.h - what was measured on one scene.
#pragma once
#include "hcsg/discovery.h"
#include "render/device.h"
#include "sample.h"
#include "scenes.h"

#include <stdbool.h>
#include <stddef.h>

enum { MEMORY_BUDGET = 256 }; // MB of a frame beside model and picture

// OpenCSG's settings that are tried.
enum { OPENCSG_BOXES = 1, OPENCSG_SETTINGS = 4 }; // boxes: mostly the fastest
struct setting {
    const char *name, *algorithm;
    bool boxes;
};
extern const struct setting opencsg_settings[OPENCSG_SETTINGS];

struct opencsg_result {
    struct samples frames; // ms
    bool late;             // not one frame within the limit
};

// Combinations found from an empty table by three sides of so many pixels.
enum { BATCH_SMALL = 128, BATCH_LARGE = 1024, BATCHES = 2 };
struct batch {
    double ms;
    uint32_t combinations;
};

struct gl_kind {             // of frames
    struct samples frames;   // ms
    struct render_stats sum; // of all
};

// What the gl device takes. Times in ms.
struct gl_result {
    bool measured;
    char device[300]; // what draws, or why none does
    double cold;      // the very first frame
    struct gl_kind opaque, spans;
    struct gl_kind array_opaque, array_spans; // by the paper's array
    struct batch batch[BATCHES];
    size_t peak_bytes, model_bytes; // of a frame beyond the body; of the body
};

struct edits_result {                  // of numbers that are edited
    struct samples tree, model, whole; // of each: a tree with it, its model, all up to the picture
    struct samples steady;             // the same picture again
    struct samples over_steady;        // whole over steady
};

enum { WALK_BY_HASH, WALK_BY_ARRAY, WALKS };

// Times in ms.
struct result {
    const struct scene *scene;
    uint32_t leaves, classes, triangles, threads;
    uint32_t size; // side of the picture
    struct samples parse, build;
    double cold;            // the very first frame
    struct samples picture; // a turn, from ray to RGB, table kept from view to view
    struct samples setup, draw;
    struct samples spans; // all intervals, nothing shaded
    // The same from an empty table, over the time of the same view drawn again straight after,
    // less 1.
    struct samples picture_extra, spans_extra;
    struct samples walk_picture[WALKS], walk_spans[WALKS]; // by the paper's hash, by its array
    double fragments, span_fragments;                      // mean of a frame
    double nanoseconds, span_nanoseconds; // per fragment and core, of drawing alone
    double intervals;                     // mean of a frame
    double covered;                       // share of the pixels that show something
    double misses; // combinations evaluated for all intervals from an empty table
    struct discovery_stats table;
    struct batch batch[BATCHES];
    struct edits_result edits;
    struct gl_result gl;
    size_t peak_bytes; // of all frames
    struct opencsg_result opencsg[OPENCSG_SETTINGS];
    uint32_t products, literals;
    char renderer[128]; // of OpenGL
};

void result_free(struct result *r); // leaves {0}

// The setting with the smallest median; -1 when none has a frame.
int result_best_opencsg(const struct result *r);
