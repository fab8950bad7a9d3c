// commands.c - what the keys do that do not move the camera.
#include "app/viewer_state.h"
#include "io/write_png.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <unistd.h>

// In the current folder, under the first name that is free: part-1.png, part-2.png ...
void commands_save_picture(struct viewer *v)
{
    const char *name = viewer_file_name(v), *dot = strrchr(name, '.');
    int stem = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
    char path[600];
    struct error err;
    int number = 1;
    do
        snprintf(path, sizeof path, "%.*s-%d.png", stem < 500 ? stem : 500, name, number++);
    while (access(path, F_OK) == 0);
    if (write_png(path, v->shown.rgb, v->shown.job.width, v->shown.job.height, &err)) {
        printf("%s\n", path);
        snprintf(v->note, sizeof v->note, "saved %s", path);
    } else {
        fprintf(stderr, "hcsg-view: %s\n", err.text);
        snprintf(v->note, sizeof v->note, "cannot save the picture: %s", err.text);
    }
    fflush(stdout);
    viewer_repaint(v);
}

static void copy_camera(struct viewer *v)
{
    camera_print_options(&v->input.camera, v->note, sizeof v->note);
    gui_copy(v->note);
    printf("%s\n", v->note);
    fflush(stdout);
}

static void paste_camera(struct viewer *v)
{
    struct error err;
    if (camera_parse_options(&v->input.camera, gui_pasted(), &err))
        v->input.moved = true;
    else
        snprintf(v->note, sizeof v->note, "%s", err.text);
}

static void next_scheme(struct viewer *v)
{
    uint32_t count, next = 0;
    const struct scheme *schemes = scheme_list(&count);
    for (uint32_t i = 0; i + 1 < count; i++)
        if (&schemes[i] == v->scheme)
            next = i + 1;
    v->scheme = &schemes[next];
    window_set_background(v->window, v->scheme->background);
    snprintf(v->note, sizeof v->note, "%s", v->scheme->name);
    v->input.moved = true;
}

static void load(struct viewer *v, enum model_mode mode)
{
    if (v->mode == mode)
        loader_reload(v->loader);
    else
        loader_set_mode(v->loader, mode);
    v->mode = mode;
}

static void toggle(struct viewer *v, bool *what)
{
    *what = !*what;
    v->input.moved = true;
}

static void give_up(struct viewer *v)
{
    if (v->phase != LOAD_NONE) {
        loader_cancel(v->loader);
    } else if (v->drawing_since > 0) {
        drawing_cancel(v->drawing);
        v->drawing_since = 0;
    } else {
        return;
    }
    snprintf(v->note, sizeof v->note, "given up");
}

static void obey(struct viewer *v, enum action action)
{
    bool *open = v->panels.open;
    *v->note = 0;
    switch (action) {
    case ACTION_EDGES:
        toggle(v, &v->view.edges);
        break;
    case ACTION_AXES:
        toggle(v, &v->view.axes);
        break;
    case ACTION_CROSSHAIRS:
        toggle(v, &v->view.crosshairs);
        break;
    case ACTION_SCALES:
        toggle(v, &v->view.scales);
        v->view.axes |= v->view.scales;
        break;
    case ACTION_SCHEME:
        next_scheme(v);
        break;
    case ACTION_RELOAD:
    case ACTION_RENDER:
        load(v, action == ACTION_RENDER ? MODEL_RENDER : MODEL_PREVIEW);
        break;
    case ACTION_GIVE_UP:
        give_up(v);
        break;
    case ACTION_SAVE:
        v->save = true;
        viewer_ask(v, true);
        break;
    case ACTION_COPY_CAMERA:
        copy_camera(v);
        break;
    case ACTION_PASTE_CAMERA:
        paste_camera(v);
        break;
    case ACTION_FULL_SCREEN:
        window_switch_full_screen(v->window);
        break;
    case ACTION_HELP:
        open[PANEL_HELP] = !open[PANEL_HELP];
        break;
    case ACTION_CONSOLE:
        open[PANEL_CONSOLE] = !open[PANEL_CONSOLE];
        v->panels.console_by_itself = false;
        break;
    case ACTION_STATUS:
        open[PANEL_STATUS] = !open[PANEL_STATUS];
        break;
    case ACTION_CUSTOMIZER:
        open[PANEL_CUSTOMIZER] = !open[PANEL_CUSTOMIZER];
        break;
    case ACTION_QUIT:
        glfwSetWindowShouldClose(window_handle(v->window), GLFW_TRUE);
        break;
    default:
        break;
    }
    viewer_repaint(v);
}

void commands_obey(struct viewer *v)
{
    for (uint32_t i = 0; i < v->input.action_count; i++)
        obey(v, v->input.actions[i]);
    v->input.action_count = 0;
}
