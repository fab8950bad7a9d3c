// picture.h - the picture of a model: its bodies drawn by a device, shaded and laid over each
// other.
#pragma once
#include "render/device.h"
#include "render/layers.h"
#include "render/overlay.h"

// Whose face shows in a pixel, for layers that repeat leaves.
struct owner {
    uint32_t twin; // see layers.h; TWIN_NONE: nobody asks
    uint32_t face; // of its solid
    bool back;     // seen from inside
};

struct picture { // {0} is valid; buffers are kept from drawing to drawing
    int width, height;
    uint8_t *rgb;                 // rows from the top without padding
    struct surface_image surface; // nearest surface of the main body, for picking
    float *depth; // surface.depth: of the nearest surface of all bodies, or INFINITY
    struct surface_image scratch;
    const struct overlay *overlay; // is drawn with the bodies; borrowed, NULL: none
    const struct facets *wires;    // the main body's edges are drawn as lines; borrowed, NULL: not
    const struct facets *sides;    // sides of all faces are drawn as lines; borrowed, NULL: not
    bool bare;                     // without faces
    struct owner *owners;          // NULL until a layer repeats leaves
};

// `settings->epsilon` is also the depth within which a highlight counts as lying on the model.
void picture_draw(struct picture *p, struct device *device, const struct shader *shader,
                  const struct rays *rays, const struct render_settings *settings,
                  struct render_stats *stats);
void picture_free(struct picture *p); // leaves {0}
