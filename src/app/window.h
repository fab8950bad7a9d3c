// window.h - the window: shows a picture in a part of itself.
#pragma once
#include "base/error.h"
#include "render/scheme.h"

struct GLFWwindow;
struct window;

struct view_area { // where the picture stands, in pixels of the window's framebuffer
    int x, y, width, height;
};

// *err says that there is no display, or no OpenGL 3.3 on it.
struct window *window_new(int width, int height, struct rgb background, struct error *err);
void window_delete(struct window *w);
// A context of OpenGL 4.5 of a window that is never shown, current on this thread: for a device's
// host. It stays until window_close_all.
bool window_open_context(void *unused, struct error *err);
void window_close_all(void); // when no window is used any more

struct GLFWwindow *window_handle(struct window *w);

void window_set_background(struct window *w, struct rgb background);
void window_switch_full_screen(struct window *w);

// What shows from the next window_paint on, in place of so many pixels of the window.
void window_set_picture(struct window *w, const uint8_t *rgb, int width, int height, int for_width,
                        int for_height);
// The picture in the middle of the area, which may have changed since it was asked for; around it
// the background.
void window_paint(struct window *w, const struct view_area *area);
void window_show(struct window *w); // what was painted since the last time
