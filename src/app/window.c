// window.c - the window: shows a picture in a part of itself.
#include "app/window.h"

#include "base/mem.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>

struct window {
    GLFWwindow *handle;
    struct rgb background;
    GLuint program, vertices;
    GLint rectangle;
    GLuint texture;
    int width, height; // of the picture; 0: nothing to show
    int for_width, for_height;
    int before[4]; // place and size before the full screen
};

static const char vertex_source[] =
    "#version 330 core\n"
    "uniform vec4 rectangle;\n" // of the corners, in clip coordinates
    "out vec2 at;\n"
    "void main()\n"
    "{\n"
    "    at = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
    "    gl_Position = vec4(mix(rectangle.xy, rectangle.zw, at), 0, 1);\n"
    "}\n";

static const char fragment_source[] =
    "#version 330 core\n"
    "uniform sampler2D image;\n"
    "in vec2 at;\n"
    "out vec4 colour;\n"
    "void main()\n"
    "{\n"
    "    colour = vec4(texture(image, vec2(at.x, 1 - at.y)).rgb, 1);\n"
    "}\n";

static GLuint compile(GLenum kind, const char *source, struct error *err)
{
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    GLint ok;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[500];
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        error_set(err, "the OpenGL driver refuses a shader: %s", log);
    }
    return ok ? shader : 0;
}

static bool make_program(struct window *w, struct error *err)
{
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_source, err);
    GLuint fragment = vertex ? compile(GL_FRAGMENT_SHADER, fragment_source, err) : 0;
    if (!fragment)
        return false;
    w->program = glCreateProgram();
    glAttachShader(w->program, vertex);
    glAttachShader(w->program, fragment);
    glLinkProgram(w->program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    w->rectangle = glGetUniformLocation(w->program, "rectangle");
    glGenVertexArrays(1, &w->vertices);
    glGenTextures(1, &w->texture);
    return true;
}

// A window that is never shown is there for a device to draw with.
static void set_hints(bool shown)
{
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, shown ? 3 : 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, shown ? 3 : 5);
    glfwWindowHint(GLFW_VISIBLE, shown);
    if (!shown)
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "hcsg-view");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "hcsg-view");
}

static GLFWwindow *open_window(int width, int height, bool shown, struct error *err)
{
    const char *reason = NULL;
    GLFWwindow *handle = NULL;
    if (glfwInit()) {
        set_hints(shown);
        handle = glfwCreateWindow(width, height, "hcsg-view", NULL, NULL);
    }
    if (!handle) {
        glfwGetError(&reason);
        error_set(err, "cannot open a window: %s", reason ? reason : "no reason given");
    }
    return handle;
}

bool window_open_context(void *unused, struct error *err)
{
    (void)unused;
    GLFWwindow *handle = open_window(1, 1, false, err);
    if (handle)
        glfwMakeContextCurrent(handle);
    return handle;
}

void window_close_all(void)
{
    glfwTerminate();
}

struct window *window_new(int width, int height, struct rgb background, struct error *err)
{
    struct window *w = mem_zalloc(sizeof *w);
    w->background = background;
    w->handle = open_window(width, height, true, err);
    if (!w->handle) {
        window_delete(w);
        return NULL;
    }
    glfwMakeContextCurrent(w->handle);
    glfwSwapInterval(1);
    if (!make_program(w, err)) {
        window_delete(w);
        return NULL;
    }
    return w;
}

void window_delete(struct window *w)
{
    if (!w)
        return;
    if (w->handle)
        glfwDestroyWindow(w->handle);
    free(w);
}

struct GLFWwindow *window_handle(struct window *w)
{
    return w->handle;
}

void window_set_background(struct window *w, struct rgb background)
{
    w->background = background;
}

// The screen that most of the window is on.
static GLFWmonitor *screen_of(const int place[4], const GLFWvidmode **mode)
{
    int count;
    long best = -1;
    GLFWmonitor *const *monitors = glfwGetMonitors(&count), *found = NULL;
    for (int i = 0; i < count; i++) {
        int x, y;
        glfwGetMonitorPos(monitors[i], &x, &y);
        const GLFWvidmode *m = glfwGetVideoMode(monitors[i]);
        double width = fmin(place[0] + place[2], x + m->width) - fmax(place[0], x);
        double height = fmin(place[1] + place[3], y + m->height) - fmax(place[1], y);
        long common = (long)(fmax(width, 0) * fmax(height, 0));
        if (common > best) {
            best = common;
            found = monitors[i];
            *mode = m;
        }
    }
    return found;
}

void window_switch_full_screen(struct window *w)
{
    int *b = w->before;
    if (glfwGetWindowMonitor(w->handle)) {
        glfwSetWindowMonitor(w->handle, NULL, b[0], b[1], b[2], b[3], GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(w->handle, &b[0], &b[1]);
    glfwGetWindowSize(w->handle, &b[2], &b[3]);
    const GLFWvidmode *mode;
    GLFWmonitor *screen = screen_of(b, &mode);
    if (screen)
        glfwSetWindowMonitor(w->handle, screen, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void window_set_picture(struct window *w, const uint8_t *rgb, int width, int height, int for_width,
                        int for_height)
{
    GLint filter = height == for_height ? GL_NEAREST : GL_LINEAR;
    glBindTexture(GL_TEXTURE_2D, w->texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (w->width == width && w->height == height)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    else
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    w->width = width;
    w->height = height;
    w->for_width = for_width;
    w->for_height = for_height;
}

// In pixels of a framebuffer of this size, from its upper left.
static void paint(const struct window *w, const int size[2], double x, double y, double width,
                  double height)
{
    double sx = 2.0 / size[0], sy = 2.0 / size[1];
    glUniform4f(w->rectangle, (float)(x * sx - 1), (float)(1 - (y + height) * sy),
                (float)((x + width) * sx - 1), (float)(1 - y * sy));
    glBindTexture(GL_TEXTURE_2D, w->texture);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void window_paint(struct window *w, const struct view_area *area)
{
    int size[2];
    glfwGetFramebufferSize(w->handle, &size[0], &size[1]);
    if (size[0] < 1 || size[1] < 1)
        return;
    glViewport(0, 0, size[0], size[1]);
    glDisable(GL_SCISSOR_TEST);
    glClearColor((float)w->background.r / 255, (float)w->background.g / 255,
                 (float)w->background.b / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!w->width || area->width < 1 || area->height < 1)
        return;
    glUseProgram(w->program);
    glBindVertexArray(w->vertices);
    glDisable(GL_BLEND);
    glEnable(GL_SCISSOR_TEST);
    glScissor(area->x, size[1] - area->y - area->height, area->width, area->height);
    // Upwards the scale is exact; sideways a coarse picture has up to one of its pixels more.
    double height = w->for_height, width = (double)w->width * height / w->height;
    double x =
        w->width == w->for_width ? floor((area->width - width) / 2) : (area->width - width) / 2;
    paint(w, size, area->x + x, area->y + floor((area->height - height) / 2), width, height);
    glDisable(GL_SCISSOR_TEST);
}

void window_show(struct window *w)
{
    glfwSwapBuffers(w->handle);
}
