// program.h - compiled compute shaders by name and defines.
#pragma once
#include "render/gl/context.h"

#include <stdint.h>

#define GL_SHADER_FOLDER "HCSG_SHADERS" // of the environment

struct gl_programs {
    struct gl_compiled *items;
    uint32_t count, capacity;
    const char *folder; // shaders are read from there, and again when they change; NULL: built in
    struct gl_log log;  // told when a changed shader has an error: the former one stays in use
};

// The folder is that of GL_SHADER_FOLDER, for development. `log` may be NULL.
void gl_programs_init(struct gl_programs *p, const struct gl_log *log);
void gl_programs_free(struct gl_programs *p); // inside of the context; leaves {0}

// The program of shaders/`name`.comp.glsl with `defines` ("NAME=VALUE OTHER=VALUE" or ""), 0 when
// it cannot be compiled. To be asked for each time it is used: what it was before may be replaced.
unsigned gl_program(struct gl_programs *p, const char *name, const char *defines,
                    struct error *err);
