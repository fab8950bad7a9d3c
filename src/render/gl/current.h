// current.h - which context is current on this thread, of EGL or GLX, so that it can be put back.
#pragma once
#include <stdbool.h>

// {0}: none
struct gl_current {
    void *display, *draw, *read, *context; // of EGL
    unsigned api;
    void *x_display, *x_context; // of GLX, which a window may have come with
    unsigned long x_draw, x_read;
};

struct gl_current gl_current_get(void);
bool gl_current_set(const struct gl_current *wanted);
