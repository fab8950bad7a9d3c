// bands.h - a picture cut into bands of rows and slabs of depth that fit the budget.
#pragma once
#include "render/gl/passes.h"
#include "render/gl/slabs.h"

// What is there to be taken.
enum gl_taken {
    GL_SLAB,  // what the rays of the band make of a slab: the next one follows
    GL_BAND,  // the whole depth of the band
    GL_ROWS,  // all columns of the band's rows
    GL_AGAIN, // nothing: the band had no room, and what was taken of it comes again in parts
};

struct gl_drawing {
    struct gl_context *context;
    struct gl_work *work;
    struct gl_scene *scene;
    struct gl_table *table;
    struct gl_array *array;
    struct gl_learner *learner;
    const struct body *body;
    const struct rays *rays;
    const struct render_settings *settings;
    struct render_stats *stats;
    struct frame_data frame; // band, rows, column and columns say what is taken
    bool spans;
    bool whole;      // a band is not cut in depth
    float near, far; // keys between which leaves lie
    struct gl_slabs slabs;
    bool (*take)(struct gl_drawing *g, enum gl_taken what); // false: *err says why not
    void *taker;                                            // for it
    struct error *err;
};

// Returns the rows that are done and taken. Fewer than all: *err says why.
int gl_bands_draw(struct gl_drawing *g);
