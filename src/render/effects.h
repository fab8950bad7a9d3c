// effects.h - what makes shapes readable: darkness in corners, and lines along edges.
#pragma once
#include "render/map.h"

// Bits of a set.
enum {
    EFFECT_OCCLUSION = 1, // corners and holes are darker, by how much of the sky they see
    EFFECT_OUTLINE = 2,   // dark lines where depth jumps and where faces meet at an angle
};

struct effects { // {0} is valid; buffers are kept from drawing to drawing
    struct map map;
    float (*normals)[3];
    float *light; // what is left of each pixel's colour, 0 to 1
    int width, height;
};

// Draws the map of the model and fills `light`. One of several pictures that will be averaged takes
// its share of directions: `sample` of `samples`.
void effects_draw(struct effects *e, struct device *device, const struct shader *shader,
                  const struct rays *rays, const struct render_settings *settings, uint32_t which,
                  uint32_t sample, uint32_t samples);
void effects_free(struct effects *e); // leaves {0}
