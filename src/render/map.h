// map.h - what each pixel shows, as numbers: depth, normal and leaf of its nearest surface.
//
// All bodies count that the picture shows, or those that are part of the model: without what is
// marked %, and without the tools that a # shows. A see-through object is where it is.
#pragma once
#include "render/device.h"
#include "render/shade.h"

struct map {         // {0} is valid; buffers are kept from drawing to drawing
    bool model_only; // of the bodies those that are part of the model
    struct surface_image surface;
    uint32_t *body;               // of the leaf
    struct surface_image scratch; // of one body, when there are several
};

void map_draw(struct map *m, struct device *device, const struct model *model,
              const struct rays *rays, const struct render_settings *settings,
              struct render_stats *stats);
void map_free(struct map *m); // leaves {0}

static inline size_t map_pixels(const struct map *m)
{
    return (size_t)m->surface.width * (size_t)m->surface.height;
}
static inline bool map_is_empty_at(const struct map *m, size_t pixel)
{
    return m->surface.leaf[pixel] == SURFACE_NONE;
}

// Unit normals as the viewer sees them: x to the right, y upwards, z towards the viewer, turned so
// that they look at him. Zero where nothing is. `out` holds map_pixels().
void map_normals(const struct map *m, const struct shader *shader, const struct rays *rays,
                 uint32_t threads, float (*out)[3]);
