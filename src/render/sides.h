// sides.h - the sides of all faces as lines, as OpenSCAD draws edges of shapes thrown together.
#pragma once
#include "render/facets.h"
#include "render/lines.h"

// Of all bodies, as far as the depths of the canvas let them show.
void sides_draw(const struct canvas *c, const struct model *m, const struct facets *facets,
                const struct rays *rays);
