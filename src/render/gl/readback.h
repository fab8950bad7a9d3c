// readback.h - parts of buffers that come back to the processor while the graphics processor goes
// on.
#pragma once
#include "render/device.h"
#include "render/gl/buffer.h"
#include "render/gl/timer.h"

// Copies go through memory of their own: drivers move a buffer that is read directly to where
// shaders reach it slowly. {0} is valid; inside of the context.
struct gl_readback {
    struct gl_buffer buffer;
    const void *data;          // of the buffer
    void *fence;               // while it is under way
    struct gl_timers *timers;  // that tell the time of copies; NULL: none
    struct render_waits waits; // so far
};

// `size` bytes of a buffer from `offset` on, which are to come to `to`.
struct gl_part {
    const struct gl_buffer *from;
    size_t offset, size;
    void *to;
};

// Asks for what the commands so far leave in parts of buffers, one after the other. What was asked
// for before is given up.
bool gl_readback_start(struct gl_readback *r, struct gl_memory *memory, const char *label,
                       const struct gl_part *parts, uint32_t count, struct error *err);
// Brings the parts to where they are to come, with as few waits as `most` bytes at a time allow.
bool gl_readback_take(struct gl_readback *r, struct gl_memory *memory, const char *label,
                      const struct gl_part *parts, uint32_t count, size_t most, struct error *err);
bool gl_readback_ready(const struct gl_readback *r);
// The bytes, valid until the next start; waits for them. NULL if the context is lost.
const void *gl_readback_wait(struct gl_readback *r, struct error *err);
void gl_readback_free(struct gl_readback *r); // leaves {0}
