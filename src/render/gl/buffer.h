// buffer.h - buffers for shaders, and an account of their bytes.
#pragma once
#include "base/error.h"

#include <stddef.h>

// What all buffers of one device hold. Nothing is made that would go above the budget.
struct gl_memory {
    size_t used, peak;
    size_t budget;  // SIZE_MAX: no bound
    size_t largest; // that a shader can use, of a single one; 0: no bound
};

// {0} is a valid empty buffer. All functions are for the inside of the context.
struct gl_buffer {
    unsigned id; // 0 while it is empty
    size_t size;
    struct gl_memory *memory;
};

// Make room for `size` bytes: `fit` for exactly these, `grow` for at least these. The contents are
// lost if the buffer has to be made anew: the old one goes first, so that both never count at once.
// False leaves it as it was if the budget forbids it, and empty if the driver has no memory. The
// label is what debuggers and errors call it.
bool gl_buffer_fit(struct gl_buffer *b, struct gl_memory *memory, const char *label, size_t size,
                   struct error *err);
bool gl_buffer_grow(struct gl_buffer *b, struct gl_memory *memory, const char *label, size_t size,
                    struct error *err);
// The same as `fit` with other flags of glNamedBufferStorage.
bool gl_buffer_make(struct gl_buffer *b, struct gl_memory *memory, const char *label, size_t size,
                    unsigned flags, struct error *err);
void gl_buffer_free(struct gl_buffer *b); // leaves {0}

// What shaders wrote before is only seen by these after
// glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT).
void gl_buffer_write(const struct gl_buffer *b, size_t offset, const void *data, size_t size);
// Fills with one 32-bit value; offset and size are multiples of 4.
void gl_buffer_fill(const struct gl_buffer *b, size_t offset, size_t size, uint32_t value);
// Copies between buffers; in one buffer the ranges must not overlap.
void gl_buffer_copy(const struct gl_buffer *from, size_t from_offset, const struct gl_buffer *to,
                    size_t to_offset, size_t size);

// Gives a compute shader's `binding` the whole buffer, or a part that starts at a multiple of
// gl_facts.storage_alignment.
void gl_buffer_bind(const struct gl_buffer *b, unsigned binding);
void gl_buffer_bind_part(const struct gl_buffer *b, unsigned binding, size_t offset, size_t size);
