// polygon_gaps.h - triangles over a polygon's own corners where its sides seem to cross.
#pragma once
#include "base/vec.h"
#include <stdint.h>

// Leaves out the triangles with vertices from `first_new` on, turns the others as the polygon's
// sides run, and fills what is open. `triangles` has room for 4 * *count + corner_count.
void polygon_fill_gaps(const struct vec3 *vertices, const uint32_t *corners, uint32_t corner_count,
                       uint32_t first_new, uint32_t (*triangles)[3], uint32_t *count);
