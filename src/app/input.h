// input.h - the mouse and the keys, turned into camera moves and commands.
#pragma once
#include "render/camera.h"

struct GLFWwindow;

enum command {
    COMMAND_RELOAD = 1,
    COMMAND_SAVE = 2,     // the picture as a PNG file
    COMMAND_HELP = 4,     // on and off
    COMMAND_MESSAGES = 8, // on and off
    COMMAND_CAMERA = 16,  // print it
};

struct input {
    struct camera camera;
    struct box bounds; // what "view all" shows
    bool moved;        // the camera is not the one the viewer saw last
    bool exposed;      // the window has to be painted
    unsigned commands; // bits of enum command
    double x, y;       // of the pointer, in pixels of the window's framebuffer
    int buttons;       // that are down, one bit each
};

extern const char input_help[];

// Takes the window's callbacks and its user pointer; the viewer resets moved, exposed and commands.
void input_attach(struct input *in, struct GLFWwindow *window);
// The default view of everything.
void input_reset_view(struct input *in);
