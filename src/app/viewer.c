// viewer.c - hcsg-view: one window that shows one file.
#include "app/viewer.h"

#include "app/drawing.h"
#include "app/input.h"
#include "app/loader.h"
#include "app/pace.h"
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

struct viewer {
    const struct viewer_options *options;
    struct window *window;
    struct input input;
    struct loader *loader;
    struct drawing *drawing;
    struct loaded *loaded; // the newest
    struct shot shown;
    bool framed;      // the camera stands
    bool drawn;       // a shot of the newest job was shown
    int divisor;      // of the newest job
    double refine_at; // when a coarse job may be followed by a full one
    struct pace pace;
    uint32_t reported; // number of the last load whose way was printed
    char *message;
    char note[1100]; // what the newest command has to say, "" for nothing
    bool failed, busy, ended;
    bool help, hide_messages, save;
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

static void show_state(struct viewer *v)
{
    char title[256], text[10000];
    const char *name = file_name(v), *message = v->message ? v->message : "";
    if (v->failed)
        snprintf(title, sizeof title, "%s: error: %.*s", name, (int)strcspn(message, "\n"),
                 message);
    else
        snprintf(title, sizeof title, "%s%s - hcsg-view", name,
                 v->busy     ? " (openscad runs)"
                 : v->loaded ? ""
                             : " (loading)");
    glfwSetWindowTitle(window_handle(v->window), title);
    window_set_text(v->window, WINDOW_TOP, v->help ? input_help : "");
    snprintf(text, sizeof text, "%s%s%s", v->hide_messages ? "" : message,
             *v->note && *message && !v->hide_messages ? "\n" : "", v->note);
    window_set_text(v->window, WINDOW_BOTTOM, text);
    v->input.exposed = true;
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
    free(v->message);
    v->message = news.message;
    *v->note = 0;
    v->failed = news.failed;
    v->busy = news.busy;
    v->ended = news.ended || (news.failed && !v->options->watch && !v->loaded);
    show_state(v);
}

static void ask(struct viewer *v, bool refined)
{
    int width, height;
    glfwGetFramebufferSize(window_handle(v->window), &width, &height);
    if (!v->loaded || width < 1 || height < 1)
        return;
    v->divisor = refined ? 1 : pace_divisor(&v->pace, width, height, frame_seconds);
    v->drawn = false;
    struct drawing_job job = {
        .loaded = v->loaded,
        .camera = v->input.camera,
        .width = (width + v->divisor - 1) / v->divisor,
        .height = (height + v->divisor - 1) / v->divisor,
        .divisor = v->divisor,
        .settings = {.epsilon = model_epsilon(&v->loaded->model, v->options->epsilon),
                     .threads = v->options->threads,
                     .memory = v->options->memory},
        .asked = clock_seconds(),
    };
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
    show_state(v);
}

static void take_failure(struct viewer *v)
{
    struct error why;
    if (!drawing_failed(v->drawing, &why))
        return;
    fprintf(stderr, "hcsg-view: %s\n", why.text);
    snprintf(v->note, sizeof v->note, "%s", why.text);
    show_state(v);
}

static void take_shot(struct viewer *v)
{
    if (!drawing_take(v->drawing, &v->shown))
        return;
    struct shot *s = &v->shown;
    pace_add(&v->pace, (double)s->job.width * s->job.height, s->done - s->begun);
    window_set_picture(v->window, s->rgb, s->job.width, s->job.height, s->job.divisor > 1);
    v->input.exposed = !is_seen(v);
    if (!v->input.exposed)
        window_paint(v->window);
    v->drawn = true;
    if (v->options->stats)
        print_stats(v, clock_seconds());
    v->reported = s->job.loaded->number;
    if (v->save && s->job.divisor == 1) {
        v->save = false;
        save_picture(v);
    }
}

static void obey(struct viewer *v)
{
    unsigned commands = v->input.commands;
    v->input.commands = 0;
    if (commands)
        *v->note = 0;
    if (commands & COMMAND_RELOAD)
        loader_reload(v->loader);
    if (commands & COMMAND_HELP)
        v->help = !v->help;
    if (commands & COMMAND_MESSAGES)
        v->hide_messages = !v->hide_messages;
    if (commands & COMMAND_CAMERA) {
        char text[CAMERA_TEXT];
        camera_print(&v->input.camera, text);
        printf("--camera=%s%s\n", text, v->input.camera.orthographic ? " --projection=o" : "");
        fflush(stdout);
        snprintf(v->note, sizeof v->note, "--camera=%s%s", text,
                 v->input.camera.orthographic ? " --projection=o" : "");
    }
    if (commands & COMMAND_SAVE) {
        v->save = true;
        ask(v, true);
    }
    if (commands)
        show_state(v);
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
    if (v->divisor <= 1 || !v->drawn)
        return 0;
    if (now < v->refine_at)
        return v->refine_at - now;
    ask(v, true);
    return 0;
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
        obey(v);
        double wait = plan(v);
        if (v->input.exposed && is_seen(v)) {
            v->input.exposed = false;
            window_paint(v->window);
        }
        if (wait > 0)
            glfwWaitEventsTimeout(wait);
        else
            glfwWaitEvents();
    }
}

bool viewer_run(const struct viewer_options *options, bool *ok, struct error *err)
{
    struct viewer v = {.options = options, .input.camera = options->camera, .reported = 0};
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
    struct device *device = device_choose(options->device, &why);
    if (!device)
        *err = why;
    else
        v.window = window_new(options->width, options->height, options->scheme->background, err);
    if (!v.window) {
        device_delete(device);
        return false;
    }
    if (options->stats)
        printf("device: %s\n", why.text);
    v.drawing = drawing_start(device, wake, NULL, err);
    v.loader = v.drawing ? loader_start(&loading, err) : NULL;
    if (v.loader) {
        input_attach(&v.input, window_handle(v.window));
        show_state(&v);
        run(&v);
    }
    *ok = v.loaded || options->watch;
    glfwHideWindow(window_handle(v.window)); // the threads may still have something to end
    drawing_stop(v.drawing);
    shot_free(&v.shown);
    loaded_release(v.loaded);
    bool started = v.loader != NULL;
    loader_stop(v.loader);
    free(v.message);
    window_delete(v.window);
    return started;
}
