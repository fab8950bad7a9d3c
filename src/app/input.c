// input.c - the mouse and the keys, turned into camera moves and commands.
#include "app/input.h"

#include "base/mem.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

const char input_help[] = "left drag           turn\n"
                          "shift + left drag   roll\n"
                          "right drag          move\n"
                          "middle drag         move along the view\n"
                          "shift + right drag  zoom\n"
                          "wheel, + -          zoom\n"
                          "4 5 6 7 8 9         top bottom left right front back\n"
                          "0                   diagonal\n"
                          "v, Ctrl+Shift+V     view all\n"
                          "r                   reset view\n"
                          "o                   orthographic on and off\n"
                          "c                   print the camera for --camera\n"
                          "p                   save the picture as PNG\n"
                          "m                   messages on and off\n"
                          "F5                  load again\n"
                          "h                   this help on and off\n"
                          "q, Ctrl+Q           quit";

static void look_along(struct input *in, double x, double y, double z)
{
    in->camera.rotation = (struct vec3){x, y, z};
    in->moved = true;
}

static void view_all(struct input *in)
{
    camera_autocenter(&in->camera, in->bounds);
    camera_viewall(&in->camera, in->bounds);
    in->moved = true;
}

void input_reset_view(struct input *in)
{
    bool orthographic = in->camera.orthographic;
    in->camera = CAMERA_DEFAULTS;
    in->camera.orthographic = orthographic;
    view_all(in);
}

static void zoom(struct input *in, GLFWwindow *window, double steps, double x, double y)
{
    int width, height;
    glfwGetFramebufferSize(window, &width, &height);
    if (width > 0 && height > 0)
        camera_zoom_at(&in->camera, steps, x, y, width, height);
    in->moved = true;
}

static void zoom_middle(struct input *in, GLFWwindow *window, double steps)
{
    int width, height;
    glfwGetFramebufferSize(window, &width, &height);
    zoom(in, window, steps, width / 2.0 - 0.5, height / 2.0 - 0.5);
}

static bool view_key(struct input *in, int key)
{
    static const struct {
        int key, pad;
        double x, y, z;
    } views[] = {
        {GLFW_KEY_4, GLFW_KEY_KP_4, 0, 0, 0},    {GLFW_KEY_5, GLFW_KEY_KP_5, 180, 0, 0},
        {GLFW_KEY_6, GLFW_KEY_KP_6, 90, 0, 270}, {GLFW_KEY_7, GLFW_KEY_KP_7, 90, 0, 90},
        {GLFW_KEY_8, GLFW_KEY_KP_8, 90, 0, 0},   {GLFW_KEY_9, GLFW_KEY_KP_9, 90, 0, 180},
        {GLFW_KEY_0, GLFW_KEY_KP_0, 55, 0, 25},
    };
    for (size_t i = 0; i < array_count(views); i++)
        if (key == views[i].key || key == views[i].pad) {
            look_along(in, views[i].x, views[i].y, views[i].z);
            return true;
        }
    return false;
}

static void on_key(GLFWwindow *window, int key, int code, int action, int modifiers)
{
    (void)code;
    struct input *in = glfwGetWindowUserPointer(window);
    bool control = modifiers & GLFW_MOD_CONTROL, shift = modifiers & GLFW_MOD_SHIFT;
    if (action == GLFW_RELEASE || view_key(in, key))
        return;
    if (key == GLFW_KEY_F5)
        in->commands |= COMMAND_RELOAD;
    if (control && key == GLFW_KEY_RIGHT_BRACKET)
        zoom_middle(in, window, 1);
    if (control && key == GLFW_KEY_LEFT_BRACKET)
        zoom_middle(in, window, -1);
    if (control && shift && key == GLFW_KEY_V)
        view_all(in);
    if (control && key == GLFW_KEY_Q)
        glfwSetWindowShouldClose(window, GLFW_TRUE);
}

// Letters come by what is printed on the key, not by where it stands.
static void on_character(GLFWwindow *window, unsigned character)
{
    static const struct {
        char letter;
        enum command command;
    } commands[] = {{'p', COMMAND_SAVE},
                    {'h', COMMAND_HELP},
                    {'?', COMMAND_HELP},
                    {'m', COMMAND_MESSAGES},
                    {'c', COMMAND_CAMERA}};
    struct input *in = glfwGetWindowUserPointer(window);
    for (size_t i = 0; i < array_count(commands); i++)
        if (character == (unsigned)commands[i].letter)
            in->commands |= commands[i].command;
    if (character == '+' || character == '-')
        zoom_middle(in, window, character == '+' ? 1 : -1);
    if (character == 'v')
        view_all(in);
    if (character == 'r')
        input_reset_view(in);
    if (character == 'o') {
        in->camera.orthographic = !in->camera.orthographic;
        in->moved = true;
    }
    if (character == 'q')
        glfwSetWindowShouldClose(window, GLFW_TRUE);
}

static void on_pointer(GLFWwindow *window, double x, double y)
{
    struct input *in = glfwGetWindowUserPointer(window);
    int width, height, frame_width, frame_height;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &frame_width, &frame_height);
    if (width < 1 || height < 1 || frame_height < 1)
        return;
    x *= (double)frame_width / width;
    y *= (double)frame_height / height;
    double dx = x - in->x, dy = y - in->y;
    in->x = x;
    in->y = y;
    bool shift = glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                 glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
    if (!in->buttons)
        return;
    // Zooming by dragging: OpenSCAD's speed, a tenth nearer or farther each 14 pixels.
    if (in->buttons & 1 << GLFW_MOUSE_BUTTON_LEFT)
        (shift ? camera_roll : camera_orbit)(&in->camera, dx, dy);
    else if (shift)
        zoom_middle(in, window, -dy / 14);
    else if (in->buttons & 1 << GLFW_MOUSE_BUTTON_RIGHT)
        camera_pan(&in->camera, dx, dy, frame_height);
    else
        camera_dolly(&in->camera, dy, frame_height);
    in->moved = true;
}

static void on_button(GLFWwindow *window, int button, int action, int modifiers)
{
    (void)modifiers;
    struct input *in = glfwGetWindowUserPointer(window);
    if (button > GLFW_MOUSE_BUTTON_MIDDLE)
        return;
    if (action == GLFW_PRESS)
        in->buttons |= 1 << button;
    else
        in->buttons &= ~(1 << button);
}

static void on_wheel(GLFWwindow *window, double dx, double dy)
{
    (void)dx;
    struct input *in = glfwGetWindowUserPointer(window);
    zoom(in, window, dy, in->x, in->y);
}

static void on_exposed(GLFWwindow *window)
{
    struct input *in = glfwGetWindowUserPointer(window);
    in->exposed = true;
}

static void on_iconified(GLFWwindow *window, int iconified)
{
    (void)iconified;
    on_exposed(window);
}

static void on_size(GLFWwindow *window, int width, int height)
{
    (void)width, (void)height;
    struct input *in = glfwGetWindowUserPointer(window);
    in->moved = true;
}

void input_attach(struct input *in, struct GLFWwindow *window)
{
    glfwSetWindowUserPointer(window, in);
    glfwSetKeyCallback(window, on_key);
    glfwSetCharCallback(window, on_character);
    glfwSetCursorPosCallback(window, on_pointer);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetScrollCallback(window, on_wheel);
    glfwSetWindowRefreshCallback(window, on_exposed);
    glfwSetWindowIconifyCallback(window, on_iconified);
    glfwSetFramebufferSizeCallback(window, on_size);
}
