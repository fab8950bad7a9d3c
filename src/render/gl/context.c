// context.c - an OpenGL 4.5 context: EGL's ways to one without a window, or one of the program's.
#include "render/gl/context.h"

#include "base/mem.h"
#include "render/gl/current.h"
#include "render/gl/facts.h"

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <assert.h>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

struct gl_context {
    struct gl_current self, before; // `before`: what was current when it was entered
    struct gl_log log;
    struct gl_facts facts;
    bool adopted; // another one made it, and ends it
    bool entered, lost;
};

// Why each way was no good, joined to one line.
struct reasons {
    char text[900];
    size_t length;
};

static void because(struct reasons *r, const char *where, const char *why)
{
    size_t room = sizeof r->text - r->length;
    int n = snprintf(r->text + r->length, room, "%s%s: %s", r->length ? "; " : "", where, why);
    r->length += n < 0 ? 0 : (size_t)n < room ? (size_t)n : room - 1;
}

// epoxy ends the process when it needs a library that is not there.
static bool libraries_there(struct error *err)
{
    static const char *const names[][2] = {{"libEGL.so.1"}, {"libOpenGL.so.0", "libGL.so.1"}};
    for (size_t i = 0; i < array_count(names); i++) { // what is found stays open for epoxy
        bool found =
            dlopen(names[i][0], RTLD_LAZY) || (names[i][1] && dlopen(names[i][1], RTLD_LAZY));
        if (!found) {
            error_set(err, "no OpenGL: %s cannot be loaded", names[i][0]);
            return false;
        }
    }
    return true;
}

static void GLAPIENTRY debug_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                     GLsizei length, const GLchar *text, const void *user)
{
    (void)source, (void)type, (void)id, (void)severity, (void)length;
    const struct gl_log *log = user;
    struct error line; // makes one line of what may be several
    error_set(&line, "OpenGL: %s", text);
    log->say(log->context, line.text);
}

static void listen(const struct gl_log *log)
{
    static const GLenum quiet[] = {GL_DEBUG_SEVERITY_LOW, GL_DEBUG_SEVERITY_NOTIFICATION};
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    for (size_t i = 0; i < array_count(quiet); i++)
        glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, quiet[i], 0, NULL, GL_FALSE);
    // What compilers say is told by who compiles, with the file and the line.
    glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, NULL,
                          GL_FALSE);
    glDebugMessageCallback(debug_message, log);
}

// Being told of resets is welcome but no condition.
static EGLContext create(EGLDisplay display, bool debug, bool told)
{
    const EGLint attributes[][2] = {
        {EGL_CONTEXT_MAJOR_VERSION, 4},
        {EGL_CONTEXT_MINOR_VERSION, 5},
        {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT},
        {EGL_CONTEXT_OPENGL_DEBUG, debug},
        {told ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE,
         EGL_LOSE_CONTEXT_ON_RESET},
        {EGL_NONE, EGL_NONE},
    };
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes[0]);
}

// Inside of the context.
static void settle(struct gl_context *c, const char *found)
{
    gl_facts_ask(&c->facts);
    snprintf(c->facts.found, sizeof c->facts.found, "%s", found);
    if (c->log.say)
        listen(&c->log);
}

// Displays are shared by all of the process, so that none is ever terminated here: another user of
// the same one, a window for instance, would lose its context.
static bool try_display(struct gl_context *c, EGLDisplay display, const char *name,
                        struct reasons *reasons)
{
    EGLint major = 0, minor = 0;
    if (!display || !eglInitialize(display, &major, &minor))
        return because(reasons, name, "no driver"), false;
    if (major * 10 + minor < 15)
        return because(reasons, name, "EGL is older than 1.5"), false;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context") ||
        !epoxy_has_egl_extension(display, "EGL_KHR_no_config_context"))
        return because(reasons, name, "no contexts without a surface"), false;
    if (!eglBindAPI(EGL_OPENGL_API))
        return because(reasons, name, "no desktop OpenGL"), false;

    EGLContext context = EGL_NO_CONTEXT;
    if (epoxy_has_egl_extension(display, "EGL_EXT_create_context_robustness"))
        context = create(display, c->log.say, true);
    if (!context)
        context = create(display, c->log.say, false);
    if (!context)
        return because(reasons, name, "no OpenGL 4.5 core"), false;

    c->self = (struct gl_current){.display = display, .context = context, .api = EGL_OPENGL_API};
    struct error err;
    if (!gl_context_enter(c, &err)) {
        eglDestroyContext(display, context);
        return because(reasons, name, err.text), false;
    }
    settle(c, name);
    gl_context_leave(c);
    return true;
}

enum { DEVICES_MOST = 32 };

static bool devices_told(void)
{
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
           epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
           epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query");
}

static bool is_software(EGLDeviceEXT device)
{
    const char *extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return extensions && strstr(extensions, "EGL_MESA_device_software");
}

bool gl_hardware_there(struct error *err)
{
    struct error missing;
    EGLDeviceEXT devices[DEVICES_MOST];
    EGLint count = 0;
    if (!libraries_there(&missing) || !devices_told() ||
        !eglQueryDevicesEXT(DEVICES_MOST, devices, &count))
        return true; // nobody knows before a context is made
    for (EGLint i = 0; i < count; i++)
        if (!is_software(devices[i]))
            return true;
    error_set(err, "there is no graphics processor with a driver");
    return false;
}

static bool try_devices(struct gl_context *c, struct reasons *reasons)
{
    if (!devices_told())
        return because(reasons, "devices", "not known to EGL"), false;
    EGLDeviceEXT devices[DEVICES_MOST];
    EGLint count = 0;
    if (!eglQueryDevicesEXT(DEVICES_MOST, devices, &count) || !count)
        return because(reasons, "devices", "none"), false;
    for (int software = 0; software < 2; software++)
        for (EGLint i = 0; i < count; i++) {
            if (software != is_software(devices[i]))
                continue;
            char name[32];
            snprintf(name, sizeof name, "device %d", i);
            EGLDisplay display =
                eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
            if (try_display(c, display, name, reasons))
                return true;
        }
    return false;
}

static bool try_all(struct gl_context *c, struct reasons *reasons)
{
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
        if (try_devices(c, reasons))
            return true;
        if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
            try_display(c,
                        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                 (void *)EGL_DEFAULT_DISPLAY, NULL),
                        "surfaceless", reasons))
            return true;
    }
    return try_display(c, eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display", reasons);
}

struct gl_context *gl_context_new(const struct gl_log *log, struct error *err)
{
    if (!libraries_there(err))
        return NULL;
    struct gl_context *c = mem_zalloc(sizeof *c);
    if (log)
        c->log = *log;
    struct gl_current before = gl_current_get();
    struct reasons reasons = {0};
    bool made = try_all(c, &reasons);
    gl_current_set(&before); // the API at least was bound to another one
    if (made)
        return c;
    error_set(err, "no OpenGL: %s", reasons.text);
    free(c);
    return NULL;
}

struct gl_context *gl_context_adopt(bool (*open)(void *context, struct error *err), void *context,
                                    const struct gl_log *log, struct error *err)
{
    struct gl_current before = gl_current_get();
    gl_current_set(&(struct gl_current){0}); // GLX and EGL bear no other beside them
    if (!open(context, err)) {
        gl_current_set(&before);
        return NULL;
    }
    struct gl_context *c = mem_zalloc(sizeof *c);
    c->adopted = true;
    c->self = gl_current_get();
    if (log)
        c->log = *log;
    bool enough = epoxy_is_desktop_gl() && epoxy_gl_version() >= 45;
    if (enough)
        settle(c, "window");
    else
        error_set(err, "no OpenGL 4.5 core");
    gl_current_set(&before);
    if (enough)
        return c;
    free(c);
    return NULL;
}

void gl_context_delete(struct gl_context *c)
{
    if (!c)
        return;
    assert(!c->entered);
    struct error err;
    if (!c->adopted) {
        eglDestroyContext(c->self.display, c->self.context);
    } else if (c->log.say && gl_context_enter(c, &err)) {
        glDebugMessageCallback(NULL, NULL);
        gl_context_leave(c);
    }
    free(c);
}

const struct gl_facts *gl_context_facts(const struct gl_context *c)
{
    return &c->facts;
}

bool gl_context_enter(struct gl_context *c, struct error *err)
{
    assert(!c->entered);
    c->before = gl_current_get();
    c->entered = gl_current_set(&c->self);
    if (c->entered)
        return true;
    error_set(err, "the OpenGL context cannot be made current");
    gl_current_set(&c->before);
    return false;
}

void gl_context_leave(struct gl_context *c)
{
    assert(c->entered);
    gl_current_set(&c->before);
    c->entered = false;
}

bool gl_context_failed(struct gl_context *c, struct error *err)
{
    assert(c->entered);
    if (c->lost || glGetGraphicsResetStatus() != GL_NO_ERROR) {
        c->lost = true;
        error_set(err, "%s: the driver was reset", c->facts.renderer);
        return true;
    }
    GLenum first = glGetError();
    if (first == GL_NO_ERROR)
        return false;
    bool memory = first == GL_OUT_OF_MEMORY;
    // A lost context may answer with errors for ever.
    for (int i = 0; i < 16; i++) {
        GLenum next = glGetError();
        if (next == GL_NO_ERROR)
            break;
        memory |= next == GL_OUT_OF_MEMORY;
    }
    if (memory)
        error_set(err, "%s: out of memory", c->facts.renderer);
    else
        error_set(err, "%s: OpenGL error 0x%x", c->facts.renderer, first);
    return true;
}
