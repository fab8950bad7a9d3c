// cost.h - what leaves cost: the crossings of rays with their faces.
#pragma once
#include "render/device.h"

// Adds to crossings[leaf] the number of crossings of the rays with each leaf of the body, hidden
// ones too: what a picture of all intervals has to list. Counted on the processor, in about the
// time of such a picture.
void cost_count(const struct body *body, const struct rays *rays,
                const struct render_settings *settings, uint64_t *crossings);
