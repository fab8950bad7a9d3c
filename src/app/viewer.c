// viewer.c - hcsg-view: one window that shows one file.
#include "app/viewer.h"

#include "app/settings.h"
#include "app/stats.h"
#include "app/viewer_state.h"
#include "base/clock.h"
#include "base/mem.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdlib.h>

// A frame that follows the hand takes this long at most; what is slower is drawn with fewer pixels
// and refined when nothing moved for a while.
static const double frame_seconds = 0.033, still_seconds = 0.12;
// What lasts longer than this is told, and how long it has lasted so often.
static const double told_seconds = 0.5, tick_seconds = 0.1;

static void wake(void *context)
{
    (void)context;
    glfwPostEmptyEvent();
}

// Nothing is drawn for a minimised window; GLFW tells when it comes back.
static bool is_seen(const struct viewer *v)
{
    GLFWwindow *handle = window_handle(v->window);
    return glfwGetWindowAttrib(handle, GLFW_VISIBLE) &&
           !glfwGetWindowAttrib(handle, GLFW_ICONIFIED);
}

static void show_title(struct viewer *v)
{
    char title[256];
    const struct report_line *error = report_first(&v->report, REPORT_ERROR);
    if (v->failed)
        snprintf(title, sizeof title, "%s: error: %s", viewer_file_name(v),
                 error ? error->text : "");
    else
        snprintf(title, sizeof title, "%s%s - hcsg-view", viewer_file_name(v),
                 v->phase == LOAD_EXPORT ? " (openscad runs)"
                 : v->loaded             ? ""
                                         : " (loading)");
    glfwSetWindowTitle(window_handle(v->window), title);
}

// What lasts long enough to be told; NULL for nothing. Since when, if anything goes on at all.
static const char *doing(const struct viewer *v, double *since)
{
    static const char *const phases[] = {
        [LOAD_EXPORT] = "openscad runs", [LOAD_BUILD] = "the model is made"};
    *since = v->phase != LOAD_NONE ? v->phase_since : v->drawing_since;
    if (*since == 0 || clock_seconds() - *since < told_seconds)
        return NULL;
    return v->phase != LOAD_NONE ? phases[v->phase] : "the picture is drawn";
}

static struct panel_facts gather(const struct viewer *v)
{
    struct panel_facts f = {
        .path = v->options->path, .note = v->note, .report = &v->report, .failed = v->failed};
    double since;
    f.doing = doing(v, &since);
    f.doing_for = clock_seconds() - since;
    const struct shot *s = &v->shown;
    if (s->job.loaded) {
        const struct load_times *t = &s->job.loaded->times;
        f.openscad = t->openscad;
        f.load = t->built - t->started;
        f.frame = s->done - s->begun;
        f.rate = v->interval > 0 ? 1 / v->interval : 0;
        f.divisor = s->job.divisor;
        f.combinations = s->combinations;
    }
    return f;
}

static void paint(struct viewer *v)
{
    const struct panel_facts facts = gather(v);
    gui_begin();
    if (panels_draw(&v->panels, &facts, &v->parameters))
        loader_define(v->loader, &v->parameters);
    const struct view_area area = panels_area(&v->panels), *old = &v->input.area;
    if (area.x != old->x || area.y != old->y || area.width != old->width ||
        area.height != old->height)
        v->input.moved = true;
    v->input.area = area;
    window_paint(v->window, &area);
    gui_end();
    window_show(v->window);
    v->ticked = clock_seconds();
}

static void take_news(struct viewer *v)
{
    struct loader_news news;
    if (!loader_take(v->loader, &news))
        return;
    if (news.loaded) {
        loaded_release(v->loaded);
        v->loaded = news.loaded;
        v->input.bounds = news.loaded->visible;
        if (!v->framed && !box_is_empty(v->input.bounds)) {
            input_reset_view(&v->input);
            v->framed = true;
        }
        v->input.moved = true;
        v->refine_at = 0;
    }
    if (news.parameters) {
        parameters_carry(news.parameters, &v->parameters);
        parameters_free(&v->parameters);
        v->parameters = *news.parameters;
        free(news.parameters);
        viewer_repaint(v);
    }
    bool busy = news.phase != LOAD_NONE;
    report_free(&v->report);
    v->report = news.report;
    if (news.loaded || (busy && v->phase == LOAD_NONE))
        *v->note = 0;
    v->failed = news.failed;
    v->phase = news.phase;
    v->phase_since = news.since;
    v->ended = news.ended || (news.failed && !v->options->watch && !v->loaded);
    const struct panel_facts facts = gather(v);
    panels_take_report(&v->panels, &facts);
    show_title(v);
    if (!busy)
        viewer_repaint(v);
}

void viewer_ask(struct viewer *v, bool refined)
{
    v->input.area = panels_area(&v->panels);
    int width = v->input.area.width, height = v->input.area.height;
    if (!v->loaded || width < 1 || height < 1)
        return;
    v->divisor = refined ? 1 : pace_divisor(&v->pace, width, height, frame_seconds);
    v->drawn = false;
    struct drawing_job job = {
        .loaded = v->loaded,
        .camera = v->input.camera,
        .scheme = v->scheme,
        .view = v->view,
        .width = (width + v->divisor - 1) / v->divisor,
        .height = (height + v->divisor - 1) / v->divisor,
        .for_width = width,
        .for_height = height,
        .divisor = v->divisor,
        .settings = {.epsilon = model_epsilon(&v->loaded->model, v->options->epsilon),
                     .threads = v->options->threads,
                     .memory = v->options->memory},
        .asked = clock_seconds(),
    };
    if (v->drawing_since == 0)
        v->drawing_since = job.asked;
    drawing_ask(v->drawing, &job);
}

static void take_failure(struct viewer *v)
{
    struct error why;
    if (!drawing_failed(v->drawing, &why))
        return;
    fprintf(stderr, "hcsg-view: %s\n", why.text);
    snprintf(v->note, sizeof v->note, "%s", why.text);
    viewer_repaint(v);
}

static void take_shot(struct viewer *v)
{
    if (!drawing_take(v->drawing, &v->shown))
        return;
    struct shot *s = &v->shown;
    pace_add(&v->pace, (double)s->job.width * s->job.height, s->done - s->begun);
    window_set_picture(v->window, s->rgb, s->job.width, s->job.height, s->job.for_width,
                       s->job.for_height);
    if (is_seen(v))
        paint(v);
    else
        v->input.repaints = 1;
    double shown = clock_seconds(), interval = shown - v->shown_at;
    if (interval < told_seconds)
        v->interval = v->interval > 0 ? 0.8 * v->interval + 0.2 * interval : interval;
    v->shown_at = shown;
    v->drawn = true;
    v->drawing_since = 0;
    if (v->options->stats)
        stats_print(s, shown, s->job.loaded->number != v->reported);
    v->reported = s->job.loaded->number;
    if (v->save && s->job.divisor == 1) {
        v->save = false;
        commands_save_picture(v);
    }
}

// Asks for the pictures that are due; returns how long to wait for events, 0 for ever.
static double plan(struct viewer *v)
{
    double now = clock_seconds();
    if (v->input.moved && is_seen(v)) {
        v->input.moved = false;
        v->refine_at = v->refine_at == 0 ? now : now + still_seconds;
        viewer_ask(v, false);
    }
    double wait = 0;
    if (v->divisor > 1 && v->drawn) {
        if (now >= v->refine_at)
            viewer_ask(v, true);
        else
            wait = v->refine_at - now;
    }
    double since, tick;
    if (!doing(v, &since))
        tick = since > 0 ? since + told_seconds : 0;
    else if (now - v->ticked >= tick_seconds)
        tick = now;
    else
        tick = v->ticked + tick_seconds;
    if (tick > 0 && tick <= now)
        v->input.repaints += v->input.repaints == 0;
    else if (tick > 0 && (wait == 0 || tick - now < wait))
        wait = tick - now;
    return wait;
}

static void run(struct viewer *v)
{
    GLFWwindow *handle = window_handle(v->window);
    while (!glfwWindowShouldClose(handle)) {
        take_news(v);
        if (v->ended)
            return;
        take_shot(v);
        take_failure(v);
        commands_obey(v);
        double wait = plan(v);
        if (v->input.repaints && is_seen(v)) {
            v->input.repaints--;
            paint(v);
            glfwPollEvents();
        } else if (wait > 0) {
            glfwWaitEventsTimeout(wait);
        } else {
            glfwWaitEvents();
        }
    }
}

static void say(void *context, const char *line)
{
    (void)context;
    fprintf(stderr, "hcsg-view: %s\n", line);
}

// What the command line says holds for this window, and is not remembered.
static void remember(const struct viewer *v)
{
    const struct viewer_options *o = v->options;
    struct settings s = o->settings;
    struct error err;
    GLFWwindow *handle = window_handle(v->window);
    if (!o->given_size && !glfwGetWindowMonitor(handle) &&
        !glfwGetWindowAttrib(handle, GLFW_ICONIFIED))
        glfwGetWindowSize(handle, &s.width, &s.height);
    if (!o->given_projection)
        s.orthographic = v->input.camera.orthographic;
    if (v->scheme != o->scheme)
        snprintf(s.scheme, sizeof s.scheme, "%s", v->scheme->name);
    s.status = v->panels.open[PANEL_STATUS];
    s.customizer = v->panels.open[PANEL_CUSTOMIZER];
    s.view = v->view;
    if (!settings_equal(&s, &o->settings) && !settings_write(&s, &err))
        fprintf(stderr, "hcsg-view: %s\n", err.text);
}

bool viewer_run(const struct viewer_options *options, bool *ok, struct error *err)
{
    struct viewer v = {.options = options, .input.camera = options->camera};
    struct loader_options loading = {.path = options->path,
                                     .openscad = options->openscad,
                                     .epsilon = options->epsilon,
                                     .import_folders = options->import_folders,
                                     .import_folder_count = options->import_folder_count,
                                     .watch = options->watch,
                                     .woken = wake};
    v.framed = options->fixed_camera;
    v.scheme = options->scheme;
    v.view = options->settings.view;
    v.panels.open[PANEL_STATUS] = options->settings.status;
    v.panels.open[PANEL_CUSTOMIZER] = options->settings.customizer;
    struct error why;
    static const struct device_host host = {.say = say, .open_context = window_open_context};
    struct device *device = device_choose(options->device, &host, &why);
    if (!device)
        *err = why;
    else
        v.window = window_new(options->width, options->height, options->scheme->background, err);
    if (!v.window) {
        device_delete(device);
        window_close_all();
        return false;
    }
    if (options->stats)
        printf("device: %s\n", why.text);
    v.drawing = drawing_start(device, wake, NULL, err);
    v.loader = v.drawing ? loader_start(&loading, err) : NULL;
    if (v.loader) {
        input_attach(&v.input, window_handle(v.window));
        gui_start(window_handle(v.window));
        show_title(&v);
        viewer_repaint(&v);
        run(&v);
        remember(&v);
    }
    *ok = v.loaded || options->watch;
    glfwHideWindow(window_handle(v.window)); // the threads may still have something to end
    drawing_stop(v.drawing);
    shot_free(&v.shown);
    loaded_release(v.loaded);
    bool started = v.loader != NULL;
    loader_stop(v.loader);
    report_free(&v.report);
    parameters_free(&v.parameters);
    panel_sets_free(&v.panels.customizer.sets);
    gui_stop();
    window_delete(v.window);
    window_close_all();
    return started;
}
