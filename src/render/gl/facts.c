// facts.c - what a driver can do, and whether that is enough.
#include "render/gl/facts.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <string.h>

// What is smaller than this on a driver with OpenGL 4.5 is not worth a second way.
enum {
    LEAST_STORAGE = 128 << 20, // bytes of a buffer
    LEAST_BLOCKS = 16,
    LEAST_INVOCATIONS = 1024,
    LEAST_SHARED = 32 << 10,
};

static void copy(char *out, size_t size, GLenum name)
{
    const char *text = (const char *)glGetString(name);
    snprintf(out, size, "%s", text ? text : "unknown");
}

static int number(GLenum name)
{
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

static void axes(int out[3], GLenum name)
{
    for (GLuint i = 0; i < 3; i++)
        glGetIntegeri_v(name, i, &out[i]);
}

static bool is_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strstr(renderer, names[i]))
            return true;
    return false;
}

void gl_facts_ask(struct gl_facts *f)
{
    copy(f->vendor, sizeof f->vendor, GL_VENDOR);
    copy(f->renderer, sizeof f->renderer, GL_RENDERER);
    copy(f->version, sizeof f->version, GL_VERSION);
    f->software = is_software(f->renderer);
    f->tells_loss = number(GL_RESET_NOTIFICATION_STRATEGY) == GL_LOSE_CONTEXT_ON_RESET;
    f->int64 = epoxy_has_gl_extension("GL_ARB_gpu_shader_int64");
    f->atomic64 = f->int64 && epoxy_has_gl_extension("GL_NV_shader_atomic_int64");
    if (epoxy_has_gl_extension("GL_KHR_shader_subgroup") &&
        number(GL_SUBGROUP_SUPPORTED_STAGES_KHR) & GL_COMPUTE_SHADER_BIT)
        f->subgroup = number(GL_SUBGROUP_SIZE_KHR);

    GLint64 size = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &size);
    f->storage_size = size > 0 ? (size_t)size : 0;
    f->storage_blocks = number(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
    f->storage_bindings = number(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
    f->storage_alignment = number(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
    axes(f->group_count, GL_MAX_COMPUTE_WORK_GROUP_COUNT);
    axes(f->group_size, GL_MAX_COMPUTE_WORK_GROUP_SIZE);
    f->group_invocations = number(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
    f->shared_size = (size_t)number(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
}

bool gl_facts_suffice(const struct gl_facts *f, struct error *err)
{
    if (f->storage_size < LEAST_STORAGE)
        error_set(err, "%s: a shader's buffer holds %zu bytes, %d are needed", f->renderer,
                  f->storage_size, LEAST_STORAGE);
    else if (f->storage_blocks < LEAST_BLOCKS)
        error_set(err, "%s: a shader can use %d buffers, %d are needed", f->renderer,
                  f->storage_blocks, LEAST_BLOCKS);
    else if (f->group_invocations < LEAST_INVOCATIONS || f->group_size[0] < LEAST_INVOCATIONS)
        error_set(err, "%s: a work group has %d invocations, %d are needed", f->renderer,
                  f->group_invocations, LEAST_INVOCATIONS);
    else if (f->shared_size < LEAST_SHARED)
        error_set(err, "%s: a work group shares %zu bytes, %d are needed", f->renderer,
                  f->shared_size, LEAST_SHARED);
    else
        return true;
    return false;
}
