// animation.h - one frame of an animation as a request of its own.
#pragma once
#include "command/request.h"

// With the number of the frame in the names of files, as OpenSCAD puts it: "x00002.png". Without an
// animation frame 0 is the request itself.
void animation_frame(struct request *out, const struct request *r, uint32_t number);
void animation_frame_free(struct request *frame); // what animation_frame made
