// input.c - the mouse and the keys, turned into camera moves and actions.
#include "app/input.h"

#include "app/gui.h"
#include "base/mem.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { TURN_PIXELS = 10 }; // that an arrow key stands for

static const struct vec3 views[] = {
    // from the top, bottom, left, right, front, back; diagonal
    {0, 0, 0}, {180, 0, 0}, {90, 0, 270}, {90, 0, 90}, {90, 0, 0}, {90, 0, 180}, {55, 0, 25},
};

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

static void zoom(struct input *in, double steps, double x, double y)
{
    if (in->area.width > 0 && in->area.height > 0)
        camera_zoom_at(&in->camera, steps, x, y, in->area.width, in->area.height);
    in->moved = true;
}

static void zoom_middle(struct input *in, double steps)
{
    zoom(in, steps, in->area.width / 2.0 - 0.5, in->area.height / 2.0 - 0.5);
}

static void move_camera(struct input *in, enum action action)
{
    in->moved = true;
    if (action >= ACTION_TOP && action <= ACTION_DIAGONAL)
        in->camera.rotation = views[action - ACTION_TOP];
    else if (action == ACTION_VIEW_ALL)
        view_all(in);
    else if (action == ACTION_RESET)
        input_reset_view(in);
    else if (action == ACTION_CENTRE)
        camera_autocenter(&in->camera, in->bounds);
    else if (action == ACTION_ORTHOGRAPHIC)
        in->camera.orthographic = !in->camera.orthographic;
    else if (action == ACTION_ZOOM_IN || action == ACTION_ZOOM_OUT)
        zoom_middle(in, action == ACTION_ZOOM_IN ? 1 : -1);
    else if (action == ACTION_TURN_LEFT || action == ACTION_TURN_RIGHT)
        camera_orbit(&in->camera, action == ACTION_TURN_LEFT ? -TURN_PIXELS : TURN_PIXELS, 0);
    else
        camera_orbit(&in->camera, 0, action == ACTION_TURN_UP ? -TURN_PIXELS : TURN_PIXELS);
}

static bool obey(struct input *in, const char *name)
{
    enum action action = keys_find(name);
    if (action == ACTION_NONE)
        return false;
    if (action <= ACTION_LAST_OF_CAMERA)
        move_camera(in, action);
    else if (in->action_count < array_count(in->actions))
        in->actions[in->action_count++] = action;
    return true;
}

// As keys.c calls it, "" for keys that come as characters. Digits count by where they stand, since
// they need Shift on some keyboards; so do letters with Ctrl where the layout has no Latin ones.
static void name_key(char *name, size_t size, int key, int code, int modifiers)
{
    static const struct {
        int key;
        const char *name;
    } named[] = {{GLFW_KEY_LEFT, "Left"},
                 {GLFW_KEY_RIGHT, "Right"},
                 {GLFW_KEY_UP, "Up"},
                 {GLFW_KEY_DOWN, "Down"},
                 {GLFW_KEY_ESCAPE, "Escape"}};
    bool control = modifiers & GLFW_MOD_CONTROL, alt = modifiers & GLFW_MOD_ALT;
    char own[8] = "";
    for (size_t i = 0; i < array_count(named); i++)
        if (named[i].key == key)
            snprintf(own, sizeof own, "%s", named[i].name);
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25)
        snprintf(own, sizeof own, "F%d", key - GLFW_KEY_F1 + 1);
    bool digit = true;
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)
        own[0] = (char)key;
    else if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)
        own[0] = (char)('0' + key - GLFW_KEY_KP_0);
    else
        digit = false;
    if (!*own && (control || alt) && key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) {
        const char *printed = glfwGetKeyName(key, code);
        bool latin = printed && printed[0] > 0 && !printed[1];
        own[0] = (char)(latin ? toupper((unsigned char)printed[0]) : key);
    }
    bool shift = modifiers & GLFW_MOD_SHIFT && (control || alt || !digit);
    snprintf(name, size, "%s%s%s%s", *own && control ? "Ctrl+" : "", *own && alt ? "Alt+" : "",
             *own && shift ? "Shift+" : "", own);
}

static void on_key(GLFWwindow *window, int key, int code, int action, int modifiers)
{
    struct input *in = glfwGetWindowUserPointer(window);
    char name[32];
    in->repaints =
        gui_is_typed_into() || gui_is_steered() || key == GLFW_KEY_TAB ? GUI_SETTLES : in->repaints;
    if (action == GLFW_RELEASE || gui_is_typed_into())
        return;
    name_key(name, sizeof name, key, code, modifiers);
    bool own = gui_is_steered() && strchr("LRUDE", *name); // arrows and Escape move the focus
    if (*name && !own)
        obey(in, name);
}

// Letters come by what is printed on the key, not by where it stands.
static void on_character(GLFWwindow *window, unsigned character)
{
    struct input *in = glfwGetWindowUserPointer(window);
    if (gui_is_typed_into())
        in->repaints = GUI_SETTLES;
    else if (character < 0x80 && !(character >= '0' && character <= '9'))
        obey(in, (char[]){(char)character, 0});
}

static void drag(struct input *in, GLFWwindow *window, double dx, double dy)
{
    bool shift = glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                 glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
    // Zooming by dragging: OpenSCAD's speed, a tenth nearer or farther each 14 pixels.
    if (in->buttons & 1 << GLFW_MOUSE_BUTTON_LEFT)
        (shift ? camera_roll : camera_orbit)(&in->camera, dx, dy);
    else if (shift)
        zoom_middle(in, -dy / 14);
    else if (in->buttons & 1 << GLFW_MOUSE_BUTTON_RIGHT)
        camera_pan(&in->camera, dx, dy, in->area.height);
    else
        camera_dolly(&in->camera, dy, in->area.height);
    in->moved = true;
}

static void on_pointer(GLFWwindow *window, double x, double y)
{
    struct input *in = glfwGetWindowUserPointer(window);
    int width, height, frame_width, frame_height;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &frame_width, &frame_height);
    if (width < 1 || height < 1 || in->area.height < 1)
        return;
    bool was_over = in->over;
    in->over = in->held || (!in->buttons && gui_is_over(x, y));
    if (in->over || was_over)
        in->repaints = GUI_SETTLES;
    x *= (double)frame_width / width;
    y *= (double)frame_height / height;
    if (in->buttons)
        drag(in, window, x - in->x, y - in->y);
    in->x = x;
    in->y = y;
}

static void on_button(GLFWwindow *window, int button, int action, int modifiers)
{
    (void)modifiers;
    struct input *in = glfwGetWindowUserPointer(window);
    in->repaints = GUI_SETTLES; // a control may lose the focus
    if (button > GLFW_MOUSE_BUTTON_MIDDLE)
        return;
    double x, y;
    glfwGetCursorPos(window, &x, &y);
    if (action == GLFW_RELEASE) {
        in->buttons &= ~(1 << button);
        in->held = false;
    } else if (gui_is_over(x, y)) {
        in->held = true;
    } else {
        in->buttons |= 1 << button;
    }
}

static void on_wheel(GLFWwindow *window, double dx, double dy)
{
    (void)dx;
    struct input *in = glfwGetWindowUserPointer(window);
    if (in->over)
        in->repaints = GUI_SETTLES;
    else
        zoom(in, dy, in->x - in->area.x, in->y - in->area.y);
}

static void on_exposed(GLFWwindow *window)
{
    struct input *in = glfwGetWindowUserPointer(window);
    if (!in->repaints)
        in->repaints = 1;
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
    in->repaints = GUI_SETTLES;
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
