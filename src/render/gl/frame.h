// frame.h - the numbers of a picture that all passes share.
#pragma once
#include "render/device.h"
#include "shaders/shared.h"

// The whole picture as one band and slab.
void gl_frame_init(struct frame_data *f, const struct body *body, const struct rays *rays,
                   const struct render_settings *settings);

// The keys between which the leaves lie; false when nothing of them shows.
bool gl_frame_range(const struct frame_data *f, const struct rays *rays, const struct body *body,
                    float *near, float *far);
