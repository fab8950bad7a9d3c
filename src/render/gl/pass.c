// pass.c - what passes are made of: shaders taken for a band and slab, and what they need.
#include "render/gl/pass.h"

#include <epoxy/gl.h>

size_t gl_pass_pixels(const struct frame_data *f)
{
    return (size_t)f->columns * (size_t)f->rows;
}

size_t gl_pass_reserve(size_t needed, size_t most)
{
    size_t more = needed + needed / 4;
    return more < most ? more : needed > most ? needed : most;
}

bool gl_pass_read(struct gl_work *w, const struct gl_buffer *from, void *out, size_t size,
                  struct error *err)
{
    return gl_work_read(w, &(struct gl_part){from, 0, size, out}, 1, err);
}

static bool use(struct gl_work *w, const char *name, const char *defines, struct error *err)
{
    unsigned program = gl_program(w->programs, name, defines, err);
    if (program)
        glUseProgram(program);
    return program;
}

static void dispatch(size_t groups)
{
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint x = (GLuint)(groups < GROUPS_WIDE ? groups : GROUPS_WIDE);
    glDispatchCompute(x, (GLuint)((groups + GROUPS_WIDE - 1) / GROUPS_WIDE), 1);
}

bool gl_pass_take(struct gl_work *w, const char *name, const char *defines, size_t groups,
                  struct error *err)
{
    bool fine = use(w, name, defines, err);
    if (fine)
        dispatch(groups);
    return fine;
}

bool gl_pass_take_counted(struct gl_work *w, const char *name, const char *defines,
                          struct error *err)
{
    if (!use(w, name, defines, err))
        return false;

    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, w->counters.id);
    glDispatchComputeIndirect(offsetof(struct counters, groups));
    return true;
}

void gl_pass_bind(const struct gl_work *w, const struct gl_scene *scene)
{
    gl_buffer_bind(&w->frame, BIND_FRAME);
    gl_buffer_bind(&scene->leaves, BIND_LEAVES);
    gl_buffer_bind(&w->counters, BIND_COUNTERS);
}

void gl_pass_bind_lists(const struct gl_work *w)
{
    if (w->linked)
        gl_buffer_bind(&w->links, BIND_LINKS);
    else
        gl_buffer_bind(&w->offsets, BIND_OFFSETS);
    gl_buffer_bind(&w->fragments, BIND_FRAGMENTS);
}
