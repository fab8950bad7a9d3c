// frame.h - what is worked out once per frame: the depth key, where each leaf shows, in what order.
//
// Inside the device a depth is its *key*: render/depth_key.h.
#pragma once
#include "render/cpu/mesh_tree.h"
#include "render/device.h"

enum {
    TILE = 64, // pixels: leaves are gathered and their planes culled per tile
    BLOCK = 8, // pixels: crossings are made for a block at a time
    BLOCK_PIXELS = BLOCK * BLOCK,
};

// A leaf as it shows in this picture.
struct frame_leaf {
    uint32_t leaf;                // number in the body
    uint32_t part;                // index in frame.parts
    float x0, y0, x1, y1;         // closed pixel rectangle that holds every ray through it
    float near, far;              // keys that bound it
    const struct mesh_tree *tree; // of its mesh; NULL for convex solids
};

// A child of the root union: the first surface of a union is the nearest of its children's.
struct frame_part {
    uint32_t node;         // of the expression
    uint32_t first, count; // its leaves in frame.leaves
    float near;            // lowest key of its leaves
    bool query;            // shallow enough for the interval queries of query.h
};

struct frame {
    const struct body *body;
    const struct rays *rays;
    const struct render_settings *settings;
    double t0;
    float start, end; // keys of rays.near and rays.far
    float epsilon;    // key distance of the filter at t0, across a face seen head-on
    struct vec3 axis; // unit, into the picture
    bool clip;        // cut convex leaves to their regions of interest: it saves walks combinations

    struct frame_leaf *leaves; // parts front to back, leaves of a part front to back
    uint32_t leaf_count;
    struct frame_part *parts;
    uint32_t part_count;
    uint32_t planes_most; // faces of the largest convex solid, padded

    int tiles_x, tiles_y;
    int fields_x, fields_y, field; // coarse squares of field x field pixels, a multiple of TILE
    uint32_t *field_first;         // per field: range in field_leaf
    uint32_t *field_leaf;          // indices into leaves, ascending
    size_t bytes;
};

void frame_init(struct frame *f, const struct body *body, const struct rays *rays,
                const struct render_settings *settings);
void frame_free(struct frame *f);

double frame_depth(const struct frame *f, double key); // t of a key
double frame_key(const struct frame *f, double depth);
