// readback.c - parts of buffers that come back to the processor while the graphics processor goes
// on.
#include "render/gl/readback.h"

#include <assert.h>
#include <epoxy/gl.h>

static void drop_fence(struct gl_readback *r)
{
    if (r->fence)
        glDeleteSync(r->fence);
    r->fence = NULL;
}

static bool make_room(struct gl_readback *r, struct gl_memory *memory, const char *label,
                      size_t size, struct error *err)
{
    if (size <= r->buffer.size)
        return true;
    const GLbitfield map = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    r->data = NULL;
    if (!gl_buffer_make(&r->buffer, memory, label, size, map | GL_CLIENT_STORAGE_BIT, err))
        return false;
    r->data = glMapNamedBufferRange(r->buffer.id, 0, (GLsizeiptr)size, map);
    if (r->data)
        return true;
    gl_buffer_free(&r->buffer);
    error_set(err, "%s: no memory for %zu bytes to be read", label, size);
    return false;
}

bool gl_readback_start(struct gl_readback *r, struct gl_memory *memory, const char *label,
                       const struct gl_buffer *from, size_t offset, size_t size, struct error *err)
{
    drop_fence(r);
    if (!make_room(r, memory, label, size, err))
        return false;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); // what shaders have written
    gl_buffer_copy(from, offset, &r->buffer, 0, size);
    r->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush(); // or it might stay in a queue
    return true;
}

bool gl_readback_ready(const struct gl_readback *r)
{
    assert(r->fence);
    GLenum state = glClientWaitSync(r->fence, 0, 0);
    return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

const void *gl_readback_wait(struct gl_readback *r, struct error *err)
{
    const GLuint64 second = 1000000000;
    assert(r->fence);
    GLenum state;
    do
        state = glClientWaitSync(r->fence, GL_SYNC_FLUSH_COMMANDS_BIT, second);
    while (state == GL_TIMEOUT_EXPIRED && glGetGraphicsResetStatus() == GL_NO_ERROR);
    drop_fence(r);
    if (state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED)
        return r->data;
    error_set(err, "the driver was reset");
    return NULL;
}

void gl_readback_free(struct gl_readback *r)
{
    drop_fence(r);
    gl_buffer_free(&r->buffer);
    *r = (struct gl_readback){0};
}
