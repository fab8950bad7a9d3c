// current.c - which context is current on this thread, of EGL or GLX, so that it can be put back.
#include "render/gl/current.h"

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <dlfcn.h>
#include <epoxy/egl.h>

// The few functions of GLX, if something of this process uses it. Taken by name, because its
// headers want those of X11.
struct glx {
    void *(*context)(void);
    void *(*display)(void);
    unsigned long (*draw)(void);
    unsigned long (*read)(void);
    int (*make)(void *display, unsigned long draw, unsigned long read, void *context);
};

static bool glx_find(struct glx *x)
{
    void *library = dlopen("libGLX.so.0", RTLD_LAZY | RTLD_NOLOAD);
    if (!library) // a driver from before there were several in one process
        library = dlopen("libGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
    if (!library)
        return false;
    *x = (struct glx){
        .context = (void *(*)(void))dlsym(library, "glXGetCurrentContext"),
        .display = (void *(*)(void))dlsym(library, "glXGetCurrentDisplay"),
        .draw = (unsigned long (*)(void))dlsym(library, "glXGetCurrentDrawable"),
        .read = (unsigned long (*)(void))dlsym(library, "glXGetCurrentReadDrawable"),
        .make = (int (*)(void *, unsigned long, unsigned long, void *))dlsym(
            library, "glXMakeContextCurrent"),
    };
    dlclose(library); // one of two handles: it stays loaded
    return x->context && x->display && x->draw && x->read && x->make;
}

// A window's context of GLX does without.
static bool egl_is_used(void)
{
    void *library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
    if (library)
        dlclose(library);
    return library;
}

struct gl_current gl_current_get(void)
{
    struct gl_current now = {0};
    if (egl_is_used()) {
        now.context = eglGetCurrentContext();
        now.api = eglQueryAPI();
    }
    if (now.context) {
        now.display = eglGetCurrentDisplay();
        now.draw = eglGetCurrentSurface(EGL_DRAW);
        now.read = eglGetCurrentSurface(EGL_READ);
    }
    struct glx x;
    if (glx_find(&x) && (now.x_context = x.context())) {
        now.x_display = x.display();
        now.x_draw = x.draw();
        now.x_read = x.read();
    }
    return now;
}

// EGL refuses while GLX has a context on this thread, and the other way round: what is not wanted
// goes first.
bool gl_current_set(const struct gl_current *wanted)
{
    struct gl_current now = gl_current_get();
    struct glx x;
    if (now.x_context && !wanted->x_context && glx_find(&x))
        x.make(now.x_display, 0, 0, NULL);
    if (now.context && !wanted->context)
        eglMakeCurrent(now.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (wanted->api)
        eglBindAPI(wanted->api);
    if (wanted->context)
        return eglMakeCurrent(wanted->display, wanted->draw, wanted->read, wanted->context);
    if (wanted->x_context)
        return glx_find(&x) &&
               x.make(wanted->x_display, wanted->x_draw, wanted->x_read, wanted->x_context);
    return true;
}
