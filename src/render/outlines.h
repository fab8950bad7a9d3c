// outlines.h - the borders of a model that is a flat shape.
#pragma once
#include "render/lines.h"
#include "render/shade.h"

// Draws them over the picture, as OpenSCAD does: whatever their depth. Nothing for solids.
void outlines_draw(const struct canvas *c, const struct shader *shader, const struct rays *rays);
