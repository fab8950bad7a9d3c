// readback.c - parts of buffers that come back to the processor while the graphics processor goes
// on.
#include "render/gl/readback.h"

#include "base/clock.h"

#include <assert.h>
#include <epoxy/gl.h>
#include <string.h>

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
                       const struct gl_part *parts, uint32_t count, struct error *err)
{
    size_t size = 0, at = 0;
    drop_fence(r);
    for (uint32_t i = 0; i < count; i++)
        size += parts[i].size;
    if (!make_room(r, memory, label, size, err))
        return false;
    if (r->timers)
        gl_timer_begin(r->timers, label);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); // what shaders have written
    for (uint32_t i = 0; i < count; at += parts[i++].size)
        gl_buffer_copy(parts[i].from, parts[i].offset, &r->buffer, at, parts[i].size);
    if (r->timers)
        gl_timer_end(r->timers); // in front of the fence: whoever has the bytes has the time
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
    double begun = clock_seconds();
    do
        state = glClientWaitSync(r->fence, GL_SYNC_FLUSH_COMMANDS_BIT, second);
    while (state == GL_TIMEOUT_EXPIRED && glGetGraphicsResetStatus() == GL_NO_ERROR);
    drop_fence(r);
    double seconds = clock_seconds() - begun;
    render_waits_add(&r->waits, &(struct render_waits){1, seconds, seconds});
    bool signaled = state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
    if (signaled && glGetGraphicsResetStatus() == GL_NO_ERROR) // which signals all, done or not
        return r->data;
    error_set(err, "the driver was reset");
    return NULL;
}

enum { TOGETHER = 8 }; // parts that come at a time

bool gl_readback_take(struct gl_readback *r, struct gl_memory *memory, const char *label,
                      const struct gl_part *parts, uint32_t count, size_t most, struct error *err)
{
    size_t done = 0; // of the first part
    while (count > 0) {
        struct gl_part now[TOGETHER];
        size_t room = most;
        uint32_t n = 0;
        for (; n < TOGETHER && count > 0 && room > 0; n++) {
            size_t left = parts->size - done, size = left < room ? left : room;
            now[n] =
                (struct gl_part){parts->from, parts->offset + done, size, (char *)parts->to + done};
            room -= size;
            done = size < left ? done + size : 0;
            parts += !done;
            count -= !done;
        }
        if (!gl_readback_start(r, memory, label, now, n, err))
            return false;
        const char *bytes = gl_readback_wait(r, err);
        if (!bytes)
            return false;
        for (uint32_t i = 0; i < n; bytes += now[i++].size)
            memcpy(now[i].to, bytes, now[i].size);
    }
    return true;
}

void gl_readback_free(struct gl_readback *r)
{
    drop_fence(r);
    gl_buffer_free(&r->buffer);
    *r = (struct gl_readback){0};
}
