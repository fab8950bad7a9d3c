// program.c - compiled compute shaders by name and defines.
#include "render/gl/program.h"

#include "base/mem.h"
#include "render/gl/source.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

struct gl_compiled {
    char *name, *defines;
    struct gl_source source;
    uint64_t stamp;
    GLuint program;
};

void gl_programs_init(struct gl_programs *p, const struct gl_log *log)
{
    *p = (struct gl_programs){.folder = getenv(GL_SHADER_FOLDER)};
    if (log)
        p->log = *log;
}

void gl_programs_free(struct gl_programs *p)
{
    for (uint32_t i = 0; i < p->count; i++) {
        glDeleteProgram(p->items[i].program);
        gl_source_free(&p->items[i].source);
        free(p->items[i].name);
        free(p->items[i].defines);
    }
    free(p->items);
    *p = (struct gl_programs){0};
}

static bool compile(GLuint shader, const struct gl_source *source, struct error *err)
{
    GLint good = 0;
    char log[4096] = "";
    glShaderSource(shader, 1, (const GLchar *const[]){source->text}, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good)
        return true;
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    gl_source_error(source, log, err);
    return false;
}

static bool link(GLuint program, GLuint shader, const struct gl_source *source, struct error *err)
{
    GLint good = 0;
    char log[4096] = "";
    glAttachShader(program, shader);
    glLinkProgram(program);
    glDetachShader(program, shader);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good)
        return true;
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    gl_source_error(source, log, err);
    return false;
}

static GLuint build(const struct gl_source *source, const char *defines, struct error *err)
{
    GLuint shader = glCreateShader(GL_COMPUTE_SHADER), program = glCreateProgram();
    bool done = compile(shader, source, err) && link(program, shader, source, err);
    glDeleteShader(shader);
    if (!done) {
        glDeleteProgram(program);
        return 0;
    }
    char label[200];
    snprintf(label, sizeof label, "%s %s", source->files[0], defines);
    glObjectLabel(GL_PROGRAM, program, -1, label);
    return program;
}

// A shader that is wrong leaves the program as it was. It is not tried again before a file changes.
static bool renew(struct gl_programs *p, struct gl_compiled *c, struct error *err)
{
    char file[128];
    snprintf(file, sizeof file, "%s.comp.glsl", c->name);
    struct gl_source source;
    bool read = gl_source_read(&source, p->folder, file, c->defines, err);
    if (read) {
        gl_source_free(&c->source);
        c->source = source;
    }
    if (p->folder)
        c->stamp = gl_source_stamp(&c->source, p->folder);
    GLuint program = read ? build(&c->source, c->defines, err) : 0;
    if (!program)
        return false;
    glDeleteProgram(c->program);
    c->program = program;
    return true;
}

static struct gl_compiled *find(struct gl_programs *p, const char *name, const char *defines)
{
    for (uint32_t i = 0; i < p->count; i++)
        if (!strcmp(p->items[i].name, name) && !strcmp(p->items[i].defines, defines))
            return &p->items[i];
    array_reserve(&p->items, &p->capacity, p->count + 1);
    p->items[p->count] = (struct gl_compiled){mem_strdup(name), mem_strdup(defines), {0}, 0, 0};
    return &p->items[p->count++];
}

unsigned gl_program(struct gl_programs *p, const char *name, const char *defines, struct error *err)
{
    struct gl_compiled *c = find(p, name, defines);
    if (!c->program) {
        renew(p, c, err);
    } else if (p->folder && gl_source_stamp(&c->source, p->folder) != c->stamp) {
        struct error why;
        if (!renew(p, c, &why) && p->log.say)
            p->log.say(p->log.context, why.text);
    }
    return c->program;
}
