// buffer.c - buffers for shaders, and an account of their bytes.
#include "render/gl/buffer.h"

#include <assert.h>
#include <epoxy/gl.h>

void gl_buffer_free(struct gl_buffer *b)
{
    if (b->id) {
        glDeleteBuffers(1, &b->id);
        b->memory->used -= b->size;
    }
    *b = (struct gl_buffer){0};
}

bool gl_buffer_make(struct gl_buffer *b, struct gl_memory *memory, const char *label, size_t size,
                    unsigned flags, struct error *err)
{
    if (size == b->size)
        return true;
    assert(!b->memory || b->memory == memory);
    if (memory->largest && size > memory->largest) {
        error_set(err, "%s: %zu bytes, of which shaders can use no more than %zu", label, size,
                  memory->largest);
        return false;
    }
    size_t others = memory->used - b->size;
    if (size > memory->budget || others > memory->budget - size) {
        error_set(err, "%s: %zu bytes beside %zu others are more than the budget of %zu", label,
                  size, others, memory->budget);
        return false;
    }
    gl_buffer_free(b);
    if (!size)
        return true;

    GLenum fault = glGetError();
    if (fault != GL_NO_ERROR) {
        if (fault == GL_OUT_OF_MEMORY)
            error_set(err, "out of memory before %s", label);
        else
            error_set(err, "before %s: OpenGL error 0x%x", label, fault);
        return false;
    }
    GLuint id;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, (GLsizeiptr)size, NULL, flags);
    fault = glGetError();
    if (fault != GL_NO_ERROR) {
        glDeleteBuffers(1, &id);
        error_set(err, "%s: no memory for %zu bytes (OpenGL error 0x%x)", label, size, fault);
        return false;
    }
    glObjectLabel(GL_BUFFER, id, -1, label);
    *b = (struct gl_buffer){.id = id, .size = size, .memory = memory};
    memory->used += size;
    if (memory->used > memory->peak)
        memory->peak = memory->used;
    return true;
}

bool gl_buffer_fit(struct gl_buffer *b, struct gl_memory *memory, const char *label, size_t size,
                   struct error *err)
{
    return gl_buffer_make(b, memory, label, size, GL_DYNAMIC_STORAGE_BIT, err);
}

bool gl_buffer_grow(struct gl_buffer *b, struct gl_memory *memory, const char *label, size_t size,
                    struct error *err)
{
    return size <= b->size || gl_buffer_fit(b, memory, label, size, err);
}

static void assert_inside(const struct gl_buffer *b, size_t offset, size_t size)
{
    assert(offset <= b->size && size <= b->size - offset);
}

void gl_buffer_write(const struct gl_buffer *b, size_t offset, const void *data, size_t size)
{
    assert_inside(b, offset, size);
    if (size)
        glNamedBufferSubData(b->id, (GLintptr)offset, (GLsizeiptr)size, data);
}

void gl_buffer_fill(const struct gl_buffer *b, size_t offset, size_t size, uint32_t value)
{
    assert_inside(b, offset, size);
    assert(offset % 4 == 0 && size % 4 == 0);
    if (size)
        glClearNamedBufferSubData(b->id, GL_R32UI, (GLintptr)offset, (GLsizeiptr)size,
                                  GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void gl_buffer_copy(const struct gl_buffer *from, size_t from_offset, const struct gl_buffer *to,
                    size_t to_offset, size_t size)
{
    assert_inside(from, from_offset, size);
    assert_inside(to, to_offset, size);
    if (size)
        glCopyNamedBufferSubData(from->id, to->id, (GLintptr)from_offset, (GLintptr)to_offset,
                                 (GLsizeiptr)size);
}

void gl_buffer_bind(const struct gl_buffer *b, unsigned binding)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, b->id);
}

void gl_buffer_bind_part(const struct gl_buffer *b, unsigned binding, size_t offset, size_t size)
{
    assert_inside(b, offset, size);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, b->id, (GLintptr)offset, (GLsizeiptr)size);
}
