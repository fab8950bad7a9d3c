// window.h - the window: shows a picture, and text over it.
#pragma once
#include "base/error.h"
#include "render/scheme.h"

struct GLFWwindow;
struct window;

// *err says that there is no display, or no OpenGL 3.3 on it.
struct window *window_new(int width, int height, struct rgb background, struct error *err);
void window_delete(struct window *w);
struct GLFWwindow *window_handle(struct window *w);

// What shows from the next window_paint on. `smooth`: the picture has fewer pixels than the window.
void window_set_picture(struct window *w, const uint8_t *rgb, int width, int height, bool smooth);
enum window_text { WINDOW_TOP, WINDOW_BOTTOM, WINDOW_TEXTS };
// "" takes it away.
void window_set_text(struct window *w, enum window_text which, const char *utf8);
void window_paint(struct window *w);
