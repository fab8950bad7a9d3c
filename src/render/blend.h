// blend.h - surfaces mixed with what a picture shows already.
#pragma once
#include "render/picture.h"

// One body being drawn, or one layer of it, as the workers see it.
struct drawing {
    struct picture *picture;
    const struct shader *shader;
    const struct body_shading *shading;
    uint32_t body;
    struct light light;
    const struct rays *rays;
    const struct layer *layer;     // NULL: the whole body
    const uint32_t *twin_of;       // per leaf of the body; NULL: picture->owners are not kept
    struct surface_image *surface; // that the device fills
    bool record;                   // into picture->surface
    bool first;                    // nothing was drawn before it
    float tolerance;               // depths within it are equal
};

// What a face of a leaf of the body shows in a pixel: its light, and its edges if they are wanted.
struct rgba blend_colour(const struct drawing *d, struct shade_cache *cache, size_t pixel,
                         uint32_t leaf, uint32_t face);

// Shows the surface that the device found in a pixel unless another one lies in front of it, and
// hides what lies behind it.
void blend_surface(const struct drawing *d, struct shade_cache *cache, size_t pixel);
// Shows the faces in all pixels whose owner stands in the layer, wherever in the picture; those
// that the device found in front have become owners before.
void blend_repeated(const struct drawing *d);

// Sinks of device_spans, with a struct drawing as their context.
// What stands alone: its back faces, then its front faces, each in the order of their numbers, or
// all in that order.
void blend_both_sides(void *context, uint32_t worker, const struct span_block *block);
// A body: its surfaces from the back, whatever their order in the file. Of an object that is cut or
// intersected only the nearest one shows, of one that stands alone also its far side.
void blend_sorted(void *context, uint32_t worker, const struct span_block *block);
