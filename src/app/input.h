// input.h - the mouse and the keys, turned into camera moves and actions.
#pragma once
#include "app/keys.h"
#include "app/window.h"
#include "render/camera.h"

struct input {
    struct camera camera;
    struct box bounds;      // what "view all" shows
    struct view_area area;  // set by the viewer
    bool moved;             // the camera, or the window's size, is not what the viewer saw last
    int repaints;           // frames that the window has to be painted
    enum action actions[8]; // for the viewer, in their order; what comes faster is lost
    uint32_t action_count;
    double x, y; // of the pointer, in pixels of the window's framebuffer
    int buttons; // that went down over the picture and are not up yet, one bit each
    bool over;   // the pointer is over a panel, or drags what it took there
    bool held;   // a button went down over a panel
};

// Takes the window's callbacks and its user pointer; the viewer resets moved, repaints and actions.
void input_attach(struct input *in, struct GLFWwindow *window);
// The default view of everything.
void input_reset_view(struct input *in);
