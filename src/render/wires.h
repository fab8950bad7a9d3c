// wires.h - the edges and vertices of what a boolean leaves, as lines and points.
//
// They are found where they are seen: between two neighbouring rays one of which meets a plane that
// the other one does not. No mesh of the result is made.
#pragma once
#include "render/device.h"
#include "render/facets.h"
#include "render/lines.h"

// Of the first body of the model: hidden ones too, as far as the depths of the canvas let them
// show.
void wires_draw(const struct canvas *c, struct device *device, const struct model *m,
                const struct scheme *scheme, const struct facets *facets, const struct rays *rays,
                const struct render_settings *settings);
