// lines.h - lines and points in a picture, as OpenGL draws them without smoothing.
//
// Positions in a picture are those of rays.h: the centre of pixel (i, j) is (i, j), j downwards.
#pragma once
#include "render/rays.h"
#include "render/scheme.h"

struct canvas {
    int width, height;
    uint8_t *rgb; // rows from the top without padding
    float *depth; // depth - rays.reference; what is drawn is nearer than that and is kept there.
                  // NULL: everything shows
};

struct line_style {
    struct rgb colour;
    int width;     // pixels, across the line's main direction
    bool stippled; // three pixels off, three on
    bool half;     // half of what is there shows through; also what is as near is drawn over
};

// The line between two points of the world, as far as it lies between near and far.
void lines_draw(const struct canvas *c, const struct rays *rays, const struct line_style *style,
                struct vec3 from, struct vec3 to);
// The line between two places of the picture, whatever the depths there are.
void lines_draw_flat(const struct canvas *c, const struct line_style *style, struct vec2 from,
                     struct vec2 to);
