// map_image.h - maps as pixels of files: depths, normals, and colours that stand for leaves.
#pragma once
#include "render/map.h"

// Depths from the eye plane in mm of what shows; nearest > farthest when nothing does.
struct depth_range {
    double nearest, farthest;
};
static inline bool depth_range_is_known(struct depth_range r)
{
    return r.nearest <= r.farthest;
}
struct depth_range map_depth_range(const struct map *m, const struct rays *rays);

// What each pixel becomes; `out` holds map_pixels(), of rgb three bytes each.
// Depths in mm from the eye plane; INFINITY where nothing is.
void map_depths(const struct map *m, const struct rays *rays, float *out);
// 65535 is the nearest depth of the range, 1 the farthest, 0 nothing, and between them
//   depth = farthest - (value - 1) / 65534 * (farthest - nearest).
void map_greys(const struct map *m, const struct rays *rays, struct depth_range range,
               uint16_t *out);
// Normals of map_normals: -1 becomes 0, 1 becomes 255; black where nothing is.
void map_normal_colours(const float (*normals)[3], size_t pixels, uint8_t *rgb);
// A colour of its own for each leaf, the same in every view; black where nothing is.
void map_ids(const struct map *m, const struct model *model, uint8_t *rgb);
// The leaves that show, body after body in the order of the file, a line each: "#rrggbb
// file:line:column" and, when it is marked #, "highlight". The caller frees it.
char *map_legend(const struct map *m, const struct model *model);
