// window.c - the window: shows a picture, and text over it.
#include "app/window.h"

#include "app/text.h"
#include "base/mem.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_PIXELS = 14, MARGIN = 8 };

struct layer {
    GLuint texture;
    int width, height; // 0: nothing to show
};

struct window {
    GLFWwindow *handle;
    struct rgb background;
    GLuint program, vertices;
    GLint rectangle, mode;
    struct layer picture, texts[WINDOW_TEXTS];
    char *written[WINDOW_TEXTS]; // what the text layers show
    int written_width;           // of the window when they were made
    struct text_font *font;
    bool fontless; // the system has none
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
    "uniform int mode;\n" // 0: a picture, 1: the ground of text, 2: text as coverage
    "in vec2 at;\n"
    "out vec4 colour;\n"
    "void main()\n"
    "{\n"
    "    vec4 texel = texture(image, vec2(at.x, 1 - at.y));\n"
    "    colour = mode == 0   ? vec4(texel.rgb, 1)\n"
    "             : mode == 1 ? vec4(0, 0, 0, 0.7)\n"
    "                         : vec4(1, 1, 1, texel.r);\n"
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
    w->mode = glGetUniformLocation(w->program, "mode");
    glGenVertexArrays(1, &w->vertices);
    glGenTextures(1, &w->picture.texture);
    for (int i = 0; i < WINDOW_TEXTS; i++)
        glGenTextures(1, &w->texts[i].texture);
    return true;
}

static void set_hints(void)
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "hcsg-view");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "hcsg-view");
}

struct window *window_new(int width, int height, struct rgb background, struct error *err)
{
    struct window *w = mem_zalloc(sizeof *w);
    const char *reason = NULL;
    w->background = background;
    if (glfwInit()) {
        set_hints();
        w->handle = glfwCreateWindow(width, height, "hcsg-view", NULL, NULL);
    }
    if (!w->handle) {
        glfwGetError(&reason);
        error_set(err, "cannot open a window: %s", reason ? reason : "no reason given");
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
    text_font_delete(w->font);
    for (int i = 0; i < WINDOW_TEXTS; i++)
        free(w->written[i]);
    if (w->handle)
        glfwDestroyWindow(w->handle);
    glfwTerminate();
    free(w);
}

struct GLFWwindow *window_handle(struct window *w)
{
    return w->handle;
}

static void fill(struct layer *layer, GLint inner, GLenum format, const uint8_t *data, int width,
                 int height, GLint filter)
{
    glBindTexture(GL_TEXTURE_2D, layer->texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (layer->width == width && layer->height == height)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format, GL_UNSIGNED_BYTE, data);
    else
        glTexImage2D(GL_TEXTURE_2D, 0, inner, width, height, 0, format, GL_UNSIGNED_BYTE, data);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    layer->width = width;
    layer->height = height;
}

void window_set_picture(struct window *w, const uint8_t *rgb, int width, int height, bool smooth)
{
    fill(&w->picture, GL_RGB8, GL_RGB, rgb, width, height, smooth ? GL_LINEAR : GL_NEAREST);
}

// Looking for fonts takes time that the first picture should not wait for.
static struct text_font *font_of(struct window *w)
{
    if (!w->font && !w->fontless) {
        float scale, unused;
        glfwGetWindowContentScale(w->handle, &scale, &unused);
        w->font = text_font_new((int)(TEXT_PIXELS * (scale > 1 ? scale : 1) + 0.5f));
        w->fontless = !w->font;
    }
    return w->font;
}

static void write_text(struct window *w, enum window_text which, int width)
{
    struct text_image image = {0};
    if (w->written[which] && *w->written[which] && font_of(w))
        text_draw(w->font, w->written[which], width - 4 * MARGIN, &image);
    if (image.width && image.height)
        fill(&w->texts[which], GL_R8, GL_RED, image.coverage, image.width, image.height,
             GL_NEAREST);
    else
        w->texts[which].width = w->texts[which].height = 0;
    text_image_free(&image);
}

void window_set_text(struct window *w, enum window_text which, const char *utf8)
{
    if (w->written[which] && strcmp(w->written[which], utf8) == 0)
        return;
    free(w->written[which]);
    w->written[which] = mem_strdup(utf8);
    write_text(w, which, w->written_width);
}

// A rectangle in pixels from the upper left of the window.
static void paint(const struct window *w, const struct layer *layer, int mode, const int size[2],
                  int x0, int y0, int x1, int y1)
{
    float sx = 2.0f / (float)size[0], sy = 2.0f / (float)size[1];
    glUniform4f(w->rectangle, (float)x0 * sx - 1, 1 - (float)y1 * sy, (float)x1 * sx - 1,
                1 - (float)y0 * sy);
    glUniform1i(w->mode, mode);
    glBindTexture(GL_TEXTURE_2D, layer->texture);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

static void paint_text(const struct window *w, enum window_text which, const int size[2])
{
    const struct layer *t = &w->texts[which];
    if (!t->width)
        return;
    int x = 2 * MARGIN, y = which == WINDOW_TOP ? 2 * MARGIN : size[1] - 2 * MARGIN - t->height;
    static const struct layer none = {0};
    paint(w, &none, 1, size, x - MARGIN, y - MARGIN, x + t->width + MARGIN, y + t->height + MARGIN);
    paint(w, t, 2, size, x, y, x + t->width, y + t->height);
}

void window_paint(struct window *w)
{
    int size[2];
    glfwGetFramebufferSize(w->handle, &size[0], &size[1]);
    if (size[0] < 1 || size[1] < 1)
        return;
    if (size[0] != w->written_width) {
        w->written_width = size[0];
        for (enum window_text i = 0; i < WINDOW_TEXTS; i++)
            write_text(w, i, size[0]);
    }
    glViewport(0, 0, size[0], size[1]);
    glClearColor((float)w->background.r / 255, (float)w->background.g / 255,
                 (float)w->background.b / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glUseProgram(w->program);
    glBindVertexArray(w->vertices);
    glDisable(GL_BLEND);
    if (w->picture.width)
        paint(w, &w->picture, 0, size, 0, 0, size[0], size[1]);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    int needed = w->texts[WINDOW_TOP].height + w->texts[WINDOW_BOTTOM].height + 6 * MARGIN;
    paint_text(w, WINDOW_TOP, size);
    if (!w->texts[WINDOW_TOP].width || needed <= size[1])
        paint_text(w, WINDOW_BOTTOM, size);
    glfwSwapBuffers(w->handle);
}
