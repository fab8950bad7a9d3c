// viewer.c - hcsg-view: one window that shows one file.
#include "app/viewer.h"

#include "app/drawing.h"
#include "app/gui.h"
#include "app/input.h"
#include "app/loader.h"
#include "app/pace.h"
#include "app/panels.h"
#include "app/window.h"
#include "base/clock.h"
#include "base/mem.h"
#include "io/write_png.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A frame that follows the hand takes this long at most; what is slower is drawn with fewer pixels
// and refined when nothing moved for a while.
static const double frame_seconds = 0.033, still_seconds = 0.12;
// What lasts longer than this is told, and how long it has lasted so often.
static const double told_seconds = 0.5, tick_seconds = 0.1;

struct viewer {
    const struct viewer_options *options;
    struct window *window;
    struct input input;
    struct loader *loader;
    struct drawing *drawing;
    struct loaded *loaded; // the newest
    struct shot shown;
    bool framed;               // the camera stands
    bool drawn;                // a shot of the newest job was shown
    int divisor;               // of the newest job
    double refine_at;          // when a coarse job may be followed by a full one
    double drawing_since;      // of the newest job, until its shot comes or it is given up; 0: none
    double shown_at, interval; // of the newest shot, and from shot to shot while something moves
    double ticked;             // when it was told how long something lasts
    struct pace pace;
    uint32_t reported; // number of the last load whose way was printed
    struct report report;
    char note[1100]; // what the newest command has to say, "" for nothing
    bool failed, ended, save;
    enum load_phase phase;
    double phase_since;
    struct panels panels;
};

static void wake(void *context)
{
    (void)context;
    glfwPostEmptyEvent();
}

static const char *file_name(const struct viewer *v)
{
    const char *slash = strrchr(v->options->path, '/');
    return slash ? slash + 1 : v->options->path;
}

// Nothing is drawn for a minimised window; GLFW tells when it comes back.
static bool is_seen(const struct viewer *v)
{
    GLFWwindow *handle = window_handle(v->window);
    return glfwGetWindowAttrib(handle, GLFW_VISIBLE) &&
           !glfwGetWindowAttrib(handle, GLFW_ICONIFIED);
}

static void repaint(struct viewer *v)
{
    v->input.repaints = GUI_SETTLES;
}

static void show_title(struct viewer *v)
{
    char title[256];
    const struct report_line *error = report_first(&v->report, REPORT_ERROR);
    if (v->failed)
        snprintf(title, sizeof title, "%s: error: %s", file_name(v), error ? error->text : "");
    else
        snprintf(title, sizeof title, "%s%s - hcsg-view", file_name(v),
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
    struct panel_facts f = {.note = v->note, .report = &v->report, .failed = v->failed};
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
    panels_draw(&v->panels, &facts);
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
    bool busy = news.phase != LOAD_NONE;
    report_free(&v->report);
    v->report = news.report;
    if (busy && v->phase == LOAD_NONE)
        *v->note = 0;
    v->failed = news.failed;
    v->phase = news.phase;
    v->phase_since = news.since;
    v->ended = news.ended || (news.failed && !v->options->watch && !v->loaded);
    const struct panel_facts facts = gather(v);
    panels_take_report(&v->panels, &facts);
    show_title(v);
    if (!busy)
        repaint(v);
}

static void ask(struct viewer *v, bool refined)
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

static void print_passes(const struct render_stats *stats)
{
    for (int i = 0; i < RENDER_PASSES && stats->passes[i].name; i++)
        printf("%s %s %.2f", i ? "," : "passes, ms:", stats->passes[i].name,
               1e3 * stats->passes[i].seconds);
    if (stats->passes[0].name)
        printf("\n");
}

static void print_memory(const struct render_stats *stats)
{
    const double mb = 1 << 20;
    printf("memory, MB: frame %.1f", (double)stats->peak_bytes / mb);
    if (stats->model_bytes)
        printf(", model %.1f", (double)stats->model_bytes / mb);
    printf("\n");
}

static void print_stats(struct viewer *v, double shown)
{
    const struct shot *s = &v->shown;
    const struct load_times *t = &s->job.loaded->times;
    printf("frame %dx%d 1/%d: %.1f ms, asked to shown %.1f ms, setup %.2f ms", s->job.width,
           s->job.height, s->job.divisor, 1e3 * (s->done - s->begun), 1e3 * (shown - s->job.asked),
           1e3 * s->stats.seconds_setup);
    if (s->stats.fragments) // the rays that need a walk
        printf(", walked %llu surfaces, %llu combinations new",
               (unsigned long long)s->stats.fragments, (unsigned long long)s->stats.misses);
    printf("\n");
    if (s->stats.waits.count)
        printf("waits for the graphics processor: %llu, %.2f ms, longest %.2f ms\n",
               (unsigned long long)s->stats.waits.count, 1e3 * s->stats.waits.seconds,
               1e3 * s->stats.waits.longest);
    print_passes(&s->stats);
    print_memory(&s->stats);
    if (s->job.loaded->number != v->reported)
        printf("load %u: %.1f ms to shown (wait %.1f, parse %.1f, model %.1f, draw %.1f, "
               "show %.1f), %u leaves\n",
               s->job.loaded->number, 1e3 * (shown - t->noticed), 1e3 * (t->started - t->noticed),
               1e3 * (t->parsed - t->started), 1e3 * (t->built - t->parsed),
               1e3 * (s->done - t->built), 1e3 * (shown - s->done),
               s->job.loaded->model.stats.leaves);
    fflush(stdout);
}

// In the current folder, under the first name that is free: part-1.png, part-2.png ...
static void save_picture(struct viewer *v)
{
    const char *name = file_name(v), *dot = strrchr(name, '.');
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
    repaint(v);
}

static void take_failure(struct viewer *v)
{
    struct error why;
    if (!drawing_failed(v->drawing, &why))
        return;
    fprintf(stderr, "hcsg-view: %s\n", why.text);
    snprintf(v->note, sizeof v->note, "%s", why.text);
    repaint(v);
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
        print_stats(v, shown);
    v->reported = s->job.loaded->number;
    if (v->save && s->job.divisor == 1) {
        v->save = false;
        save_picture(v);
    }
}

// "--camera=..." as both programs take it.
static void copy_camera(struct viewer *v)
{
    char text[CAMERA_TEXT];
    camera_print(&v->input.camera, text);
    snprintf(v->note, sizeof v->note, "--camera=%s%s", text,
             v->input.camera.orthographic ? " --projection=o" : "");
    gui_copy(v->note);
    printf("%s\n", v->note);
    fflush(stdout);
}

static void give_up(struct viewer *v)
{
    double since;
    doing(v, &since);
    if (since == 0)
        return;
    if (v->phase != LOAD_NONE)
        loader_cancel(v->loader);
    else
        drawing_cancel(v->drawing);
    v->drawing_since = v->phase != LOAD_NONE ? v->drawing_since : 0;
    snprintf(v->note, sizeof v->note, "given up");
}

static void obey(struct viewer *v, enum action action)
{
    bool *open = v->panels.open;
    *v->note = 0;
    switch (action) {
    case ACTION_RELOAD:
        loader_reload(v->loader);
        break;
    case ACTION_GIVE_UP:
        give_up(v);
        break;
    case ACTION_SAVE:
        v->save = true;
        ask(v, true);
        break;
    case ACTION_COPY_CAMERA:
        copy_camera(v);
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
    case ACTION_QUIT:
        glfwSetWindowShouldClose(window_handle(v->window), GLFW_TRUE);
        break;
    default:
        break;
    }
    repaint(v);
}

static void obey_all(struct viewer *v)
{
    for (uint32_t i = 0; i < v->input.action_count; i++)
        obey(v, v->input.actions[i]);
    v->input.action_count = 0;
}

// Asks for the pictures that are due; returns how long to wait for events, 0 for ever.
static double plan(struct viewer *v)
{
    double now = clock_seconds();
    if (v->input.moved && is_seen(v)) {
        v->input.moved = false;
        v->refine_at = v->refine_at == 0 ? now : now + still_seconds;
        ask(v, false);
    }
    double wait = 0;
    if (v->divisor > 1 && v->drawn) {
        if (now >= v->refine_at)
            ask(v, true);
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
        obey_all(v);
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

bool viewer_run(const struct viewer_options *options, bool *ok, struct error *err)
{
    struct viewer v = {
        .options = options, .input.camera = options->camera, .panels.open[PANEL_STATUS] = true};
    struct loader_options loading = {.path = options->path,
                                     .openscad = options->openscad,
                                     .epsilon = options->epsilon,
                                     .import_folders = options->import_folders,
                                     .import_folder_count = options->import_folder_count,
                                     .scheme = options->scheme,
                                     .watch = options->watch,
                                     .woken = wake};
    v.framed = options->fixed_camera;
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
        repaint(&v);
        run(&v);
    }
    *ok = v.loaded || options->watch;
    glfwHideWindow(window_handle(v.window)); // the threads may still have something to end
    drawing_stop(v.drawing);
    shot_free(&v.shown);
    loaded_release(v.loaded);
    bool started = v.loader != NULL;
    loader_stop(v.loader);
    report_free(&v.report);
    gui_stop();
    window_delete(v.window);
    window_close_all();
    return started;
}
