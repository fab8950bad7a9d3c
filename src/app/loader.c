// loader.c - follows the file and hands over the models made of it, on a thread of its own.
#include "app/loader.h"

#include "app/build.h"
#include "app/defined.h"
#include "app/watch.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "scad/openscad.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>
#include <uv.h>

// A file that does not parse, is empty or is gone may be half saved: it is tried again for a while
// before anything is said.
enum { RETRY_FIRST_MS = 10, RETRY_MOST_MS = 80, PATIENCE_MS = 250 };
// Exports longer than this are ended when a value has changed.
enum { FOLLOWED_SECONDS = 1 };

struct loader {
    struct loader_options options;
    bool is_scad;
    uv_thread_t thread;
    uv_loop_t loop;
    uv_async_t wake;
    uv_timer_t retry;
    uv_signal_t signals[3];
    struct watch *watch;
    struct scad_job *job;
    char **files; // that the design depends on, as far as known
    uint32_t file_count, file_capacity;
    struct build *build;
    uint32_t loads;
    double noticed;         // of the load under way
    double failed;          // `noticed` of the newest that failed
    double exporting;       // since when openscad runs, or ran last
    double building;        // since when a model is made; 0: none is
    uint64_t retry_ms;      // before the next try
    bool patient;           // failures may pass
    bool loading;           // what was saved is being made into a model
    struct source *source;  // of the newest model; held
    struct defined defined; // the parameters of a .scad
    bool again;             // values have changed since openscad began
    enum model_mode mode;

    uv_mutex_t mutex; // guards what follows
    struct loaded *retired;
    struct loader_news news;
    struct build_task edit;       // asked for; without a source: none
    struct parameter_texts texts; // asked for; without items: none
    bool fresh, stopping, reload, cancel;
    enum model_mode wanted; // the mode from the next load on
};

struct loaded *loaded_hold(struct loaded *s)
{
    if (s)
        atomic_fetch_add(&s->references, 1);
    return s;
}

// Models are freed where they are built: the store of solids belongs to one thread.
void loaded_release(struct loaded *s)
{
    if (!s || atomic_fetch_sub(&s->references, 1) != 1)
        return;
    struct loader *l = s->loader;
    uv_mutex_lock(&l->mutex);
    s->next = l->retired;
    l->retired = s;
    uv_mutex_unlock(&l->mutex);
    uv_async_send(&l->wake);
}

// Takes the report over; NULL: what was said before still holds.
static void publish(struct loader *l, struct loaded *loaded, struct report *report, bool failed)
{
    uv_mutex_lock(&l->mutex);
    struct loaded *unseen = NULL;
    if (loaded) {
        unseen = l->news.loaded;
        l->news.loaded = loaded;
    }
    if (report) {
        report_free(&l->news.report);
        l->news.report = *report;
        *report = (struct report){0};
        l->news.failed = failed;
    }
    l->news.phase = l->job ? LOAD_EXPORT : l->building > 0 ? LOAD_BUILD : LOAD_NONE;
    l->news.since = l->job ? l->exporting : l->building;
    l->fresh = true;
    uv_mutex_unlock(&l->mutex);
    loaded_release(unseen);
    l->options.woken(l->options.context);
}

static void fail(struct loader *l, struct report *report)
{
    l->failed = l->noticed;
    publish(l, NULL, report, true);
}

static void ask_build(struct loader *l, struct build_task *task)
{
    l->building = clock_seconds();
    l->loading |= !task->source;
    build_ask(l->build, task);
    publish(l, NULL, NULL, false);
}

static void on_retry(uv_timer_t *timer);

// Whether the failed load is tried again before it is reported.
static bool try_again(struct loader *l)
{
    if (!l->patient || clock_seconds() - l->noticed > PATIENCE_MS * 1e-3)
        return false;
    uv_update_time(&l->loop);
    uv_timer_start(&l->retry, on_retry, l->retry_ms, 0);
    if (l->retry_ms < RETRY_MOST_MS)
        l->retry_ms *= 2;
    return true;
}

static void forget_files(struct loader *l)
{
    for (uint32_t i = 0; i < l->file_count; i++)
        free(l->files[i]);
    l->file_count = 0;
}

static void follow_file(struct loader *l, const char *path)
{
    for (uint32_t i = 0; i < l->file_count; i++)
        if (strcmp(l->files[i], path) == 0)
            return;
    array_reserve(&l->files, &l->file_capacity, l->file_count + 1);
    l->files[l->file_count++] = mem_strdup(path);
}

// After a failure openscad does not tell all files: the ones from before still matter.
static void follow_design(struct loader *l, const struct scad_result *result, bool complete)
{
    if (!l->watch)
        return;
    if (complete)
        forget_files(l);
    for (uint32_t i = 0; i < result->file_count; i++)
        follow_file(l, result->files[i]);
    watch_set(l->watch, l->files, l->file_count, l->exporting);
}

static void follow_imports(struct loader *l, const struct model *m, double since)
{
    if (!l->watch || l->is_scad)
        return;
    forget_files(l);
    follow_file(l, l->options.path);
    for (uint32_t i = 0; i < m->import_count; i++)
        follow_file(l, m->imports[i]);
    watch_set(l->watch, l->files, l->file_count, since);
}

static void on_built(void *context, struct build_task *task)
{
    struct loader *l = context;
    struct loaded *s = task->loaded;
    bool edited = task->source != NULL;
    bool doubtful = !edited && !l->is_scad && (!s || task->size == 0);
    l->building = 0;
    if (doubtful && try_again(l)) {
        build_retire(l->build, s);
        publish(l, NULL, NULL, false);
        return;
    }
    if (!edited) {
        l->loading = false;
        messages_print(&task->messages, stderr);
        report_messages(&task->report, &task->messages);
    }
    if (!s) {
        fail(l, &task->report);
        return;
    }
    if (!edited) {
        follow_imports(l, &s->model, task->times.started);
        source_release(l->source);
        l->source = source_hold(s->source);
    }
    s->times = task->times;
    s->number = ++l->loads;
    s->loader = l;
    build_replace(l->build, s);
    // What is wrong with a newer file is more to the point.
    publish(l, s, edited || l->failed > s->times.noticed ? NULL : &task->report, false);
}

static void load(struct loader *l, double noticed);

static void on_exported(void *context, struct scad_result *result, const struct error *err)
{
    struct loader *l = context;
    struct build_task task = {.mode = l->mode, .times.noticed = l->noticed};
    l->job = NULL;
    task.times.openscad = clock_seconds() - l->exporting;
    report_scad(&task.report, result, err);
    report_print(&task.report, stderr);
    follow_design(l, result, !err);
    if (!err && strspn(result->text, " \t\r\n") == result->size) {
        struct error empty;
        error_set(&empty, "%s: the design is empty", l->options.path);
        fprintf(stderr, "%s\n", empty.text);
        report_error(&task.report, empty.text);
        fail(l, &task.report);
    } else if (result->text) {
        task.name = result->name;
        task.text = result->text;
        task.size = result->size;
        result->name = result->text = NULL;
        ask_build(l, &task);
    } else {
        fail(l, &task.report);
    }
    if (!err)
        defined_exported(&l->defined);
    build_task_free(&task);
    scad_result_free(result);
    if (l->again)
        load(l, clock_seconds());
}

static void start_openscad(struct loader *l)
{
    struct parameters *parameters = defined_read(&l->defined, l->options.path);
    uint32_t count;
    char **arguments = defined_arguments(&l->defined, &count);
    // Without a value the option would take the file for one.
    if (l->mode == MODEL_RENDER)
        arguments[count++] = mem_strdup("--render=force");
    const struct scad_options options = {.program = l->options.openscad,
                                         .arguments = (const char *const *)arguments,
                                         .argument_count = count};
    l->exporting = clock_seconds();
    l->job = scad_start(&l->loop, l->options.path, &options, on_exported, l);
    for (uint32_t i = 0; i < count; i++)
        free(arguments[i]);
    free(arguments);
    if (parameters) {
        uv_mutex_lock(&l->mutex);
        struct parameters *unseen = l->news.parameters;
        l->news.parameters = parameters;
        uv_mutex_unlock(&l->mutex);
        parameters_delete(unseen);
    }
    publish(l, NULL, NULL, false);
}

static void begin(struct loader *l)
{
    struct build_task task = {
        .name = mem_strdup(l->options.path), .mode = l->mode, .times.noticed = l->noticed};
    if (!l->is_scad) {
        ask_build(l, &task);
    } else if (access(task.name, F_OK) == 0) {
        start_openscad(l);
    } else if (!try_again(l)) {
        struct error err;
        error_set(&err, "%s: %s", task.name, strerror(errno));
        report_error(&task.report, err.text);
        report_print(&task.report, stderr);
        fail(l, &task.report);
    }
    build_task_free(&task);
}

static void on_retry(uv_timer_t *timer)
{
    begin(timer->data);
}

static void load(struct loader *l, double noticed)
{
    l->noticed = noticed;
    l->retry_ms = RETRY_FIRST_MS;
    l->again = false;
    uv_timer_stop(&l->retry);
    if (l->job)
        scad_cancel(l->job);
    l->job = NULL;
    begin(l);
}

static void give_up(struct loader *l)
{
    uv_timer_stop(&l->retry);
    if (l->job)
        scad_cancel(l->job);
    l->job = NULL;
    build_cancel(l->build);
    l->building = 0;
    l->loading = false;
    publish(l, NULL, NULL, false);
}

static void on_saved(void *context, double noticed)
{
    struct loader *l = context;
    l->patient = true;
    load(l, noticed);
}

static void on_signal(uv_signal_t *handle, int number)
{
    (void)number;
    struct loader *l = handle->data;
    uv_mutex_lock(&l->mutex);
    l->news.ended = l->fresh = true;
    uv_mutex_unlock(&l->mutex);
    l->options.woken(l->options.context);
}

// An export under way is let finish, or nothing would show while a slider moves; a long one is not.
static void define(struct loader *l, const struct parameter_texts *texts)
{
    defined_set(&l->defined, texts);
    l->patient = false;
    if (l->job && clock_seconds() - l->exporting < FOLLOWED_SECONDS)
        l->again = true;
    else
        load(l, clock_seconds());
}

static void on_wake(uv_async_t *handle)
{
    struct loader *l = handle->data;
    uv_mutex_lock(&l->mutex);
    struct loaded *retired = l->retired;
    struct build_task edit = l->edit;
    bool reload = l->reload, cancel = l->cancel, stopping = l->stopping;
    l->retired = NULL;
    l->edit = (struct build_task){0};
    struct parameter_texts texts = l->texts;
    l->texts = (struct parameter_texts){0};
    l->mode = l->wanted;
    l->reload = l->cancel = false;
    uv_mutex_unlock(&l->mutex);
    build_retire(l->build, retired);
    if (stopping) {
        build_task_free(&edit);
        parameter_texts_free(&texts);
        if (l->job)
            scad_cancel(l->job);
        watch_delete(l->watch);
        build_delete(l->build);
        uv_close((uv_handle_t *)&l->wake, NULL);
        uv_close((uv_handle_t *)&l->retry, NULL);
        for (size_t i = 0; i < array_count(l->signals); i++)
            uv_close((uv_handle_t *)&l->signals[i], NULL);
        return;
    }
    if (cancel)
        give_up(l);
    if (texts.count && l->is_scad)
        define(l, &texts);
    parameter_texts_free(&texts);
    if (reload) {
        l->patient = false;
        load(l, clock_seconds());
    }
    edit.mode = l->mode;
    if (edit.source && edit.source == l->source && !l->loading)
        ask_build(l, &edit);
    build_task_free(&edit);
}

static void run(void *context)
{
    struct loader *l = context;
    if (l->options.watch) {
        l->watch = watch_new(&l->loop, on_saved, l);
        follow_file(l, l->options.path);
        watch_set(l->watch, l->files, l->file_count, INFINITY); // nothing was read yet
    }
    load(l, clock_seconds());
    uv_run(&l->loop, UV_RUN_DEFAULT);
    forget_files(l);
    free(l->files);
    source_release(l->source);
}

static void listen_to_signals(struct loader *l)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < array_count(numbers); i++) {
        struct sigaction action;
        l->signals[i].data = l;
        uv_signal_init(&l->loop, &l->signals[i]);
        if (sigaction(numbers[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN)
            uv_signal_start(&l->signals[i], on_signal, numbers[i]);
    }
}

struct loader *loader_start(const struct loader_options *options, struct error *err)
{
    struct loader *l = mem_zalloc(sizeof *l);
    int failed = uv_loop_init(&l->loop);
    if (failed) {
        error_set(err, "cannot follow files: %s", uv_strerror(failed));
        free(l);
        return NULL;
    }
    l->options = *options;
    l->is_scad = strcasecmp(file_extension(options->path), "scad") == 0;
    l->wake.data = l->retry.data = l;
    l->build = build_new(&l->loop, &l->options, on_built, l);
    uv_mutex_init(&l->mutex);
    uv_async_init(&l->loop, &l->wake, on_wake);
    uv_timer_init(&l->loop, &l->retry);
    listen_to_signals(l);
    failed = uv_thread_create(&l->thread, run, l);
    if (failed) {
        error_set(err, "cannot start a thread: %s", uv_strerror(failed));
        l->stopping = true;
        uv_async_send(&l->wake);
        uv_run(&l->loop, UV_RUN_DEFAULT);
        uv_loop_close(&l->loop);
        uv_mutex_destroy(&l->mutex);
        free(l);
        return NULL;
    }
    return l;
}

bool loader_take(struct loader *l, struct loader_news *out)
{
    uv_mutex_lock(&l->mutex);
    bool fresh = l->fresh;
    if (fresh) {
        *out = l->news;
        out->report = report_copy(&l->news.report);
        l->news.loaded = NULL;
        l->news.parameters = NULL;
        l->fresh = false;
    }
    uv_mutex_unlock(&l->mutex);
    return fresh;
}

static void set_flag(struct loader *l, bool *flag)
{
    uv_mutex_lock(&l->mutex);
    *flag = true;
    uv_mutex_unlock(&l->mutex);
    uv_async_send(&l->wake);
}

void loader_reload(struct loader *l)
{
    set_flag(l, &l->reload);
}

void loader_define(struct loader *l, const struct parameters *p)
{
    struct parameter_texts texts = parameter_texts_of(p), replaced;
    uv_mutex_lock(&l->mutex);
    replaced = l->texts;
    l->texts = texts;
    uv_mutex_unlock(&l->mutex);
    uv_async_send(&l->wake);
    parameter_texts_free(&replaced);
}

void loader_set_mode(struct loader *l, enum model_mode mode)
{
    uv_mutex_lock(&l->mutex);
    l->wanted = mode;
    uv_mutex_unlock(&l->mutex);
    set_flag(l, &l->reload);
}

void loader_cancel(struct loader *l)
{
    set_flag(l, &l->cancel);
}

void loader_edit(struct loader *l, const struct edit *e)
{
    struct build_task task = {.source = source_hold(edit_source(e)),
                              .version = edit_version(e),
                              .times.noticed = clock_seconds()};
    task.name = mem_strdup(l->options.path);
    edit_tree(e, &task.tree);
    uv_mutex_lock(&l->mutex);
    struct build_task replaced = l->edit;
    l->edit = task;
    uv_mutex_unlock(&l->mutex);
    uv_async_send(&l->wake);
    build_task_free(&replaced);
}

void loader_stop(struct loader *l)
{
    if (!l)
        return;
    set_flag(l, &l->stopping);
    uv_thread_join(&l->thread);
    uv_loop_close(&l->loop);
    loaded_free(l->retired);
    loaded_free(l->news.loaded);
    build_task_free(&l->edit);
    uv_mutex_destroy(&l->mutex);
    report_free(&l->news.report);
    parameters_delete(l->news.parameters);
    parameter_texts_free(&l->texts);
    defined_free(&l->defined);
    free(l);
}
