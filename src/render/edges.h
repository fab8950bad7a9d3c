// edges.h - how much of a pixel an edge covers, as OpenSCAD's preview draws them: a line that fades
// away along every edge of what it draws, inside the triangle that the edge belongs to.
#pragma once
#include "render/facets.h"
#include "render/rays.h"

// For a pixel that shows a face of a leaf: 1 on an edge, 0 beside its line.
double edges_cover(const struct facets *d, const struct leaf *leaf, uint32_t face,
                   const struct rays *rays, int x, int y);
