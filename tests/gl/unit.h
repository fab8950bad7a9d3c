// unit.h - cmocka, and an OpenGL context to be in during a test.
#pragma once
#include "render/gl/context.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// What the driver said is a failure of the test that made it say so.
static inline void unit_say(void *context, const char *line)
{
    print_message("%s\n", line);
    ++*(int *)context;
}

static int unit_said;

// Ends the program with 77 where there is no OpenGL 4.5.
static inline struct gl_context *unit_context(void)
{
    struct error err;
    struct gl_context *c = gl_context_new(&(struct gl_log){unit_say, &unit_said}, &err);
    if (c)
        return c;
    printf("skipped: %s\n", err.text);
    exit(77);
}
