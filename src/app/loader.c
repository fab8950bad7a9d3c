// loader.c - reads the file, builds its model and follows both, on a thread of its own.
#include "app/loader.h"

#include "app/report.h"
#include "app/watch.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "csg/csg.h"
#include "scad/openscad.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <uv.h>

#define TEXT_LIMIT ((size_t)1 << 32)

// A file that does not parse, is empty or is gone may be half saved: it is tried again for a while
// before anything is said.
enum { RETRY_FIRST_MS = 10, RETRY_MOST_MS = 80, PATIENCE_MS = 250 };

struct loader {
    struct loader_options options;
    bool is_scad;
    uv_thread_t thread;
    uv_loop_t loop;
    uv_async_t wake;
    uv_timer_t retry;
    uv_signal_t interrupt, terminate;
    struct watch *watch;
    struct scad_job *job;
    char **files; // that the design depends on, as far as known
    uint32_t file_count, file_capacity;
    struct solid_store *store;
    uint32_t loads;
    double noticed;    // of the load under way
    uint64_t retry_ms; // before the next try
    bool patient;      // failures may pass

    uv_mutex_t mutex; // guards what follows
    struct loaded *retired;
    struct loader_news news;
    bool fresh, stopping, reload;
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

static void publish(struct loader *l, struct loaded *loaded, char *message, bool failed, bool busy)
{
    uv_mutex_lock(&l->mutex);
    struct loaded *unseen = NULL;
    if (loaded) {
        unseen = l->news.loaded;
        l->news.loaded = loaded;
    }
    if (message) {
        free(l->news.message);
        l->news.message = message;
        l->news.failed = failed;
    }
    l->news.busy = busy;
    l->fresh = true;
    uv_mutex_unlock(&l->mutex);
    loaded_release(unseen);
    l->options.woken(l->options.context);
}

static void fail(struct loader *l, struct messages *m)
{
    messages_print(m, stderr);
    publish(l, NULL, report_summary(m), true, l->job != NULL);
}

// OpenSCAD's bounds also count what intersections cut away.
static struct box visible_box(const struct model *m)
{
    struct box visible = BOX_EMPTY;
    for (uint32_t i = 0; i < m->body_count; i++) {
        const struct body *b = &m->bodies[i];
        for (uint32_t l = 0; l < b->leaf_count; l++) {
            struct box box = box_intersection(b->leaves[l].box, b->roi[l]);
            if (!b->leaves[l].subtracted && !box_is_empty(box))
                visible = box_union(visible, box);
        }
    }
    return visible;
}

static void build(struct loader *l, const struct csg_tree *tree, struct messages *m,
                  struct load_times times)
{
    struct loaded *s = mem_zalloc(sizeof *s);
    struct model_options options = MODEL_DEFAULTS;
    options.epsilon = l->options.epsilon;
    model_build(&s->model, tree, l->store, &options, m);
    s->visible = visible_box(&s->model);
    shader_init(&s->shader, &s->model, l->options.scheme);
    times.built = clock_seconds();
    s->times = times;
    s->number = ++l->loads;
    s->loader = l;
    atomic_init(&s->references, 1);
    messages_print(m, stderr);
    publish(l, s, report_summary(m), false, l->job != NULL);
}

// Takes `text` over. False: the text does not parse, and *m says why.
static bool take_text(struct loader *l, const char *name, char *text, size_t size, double started,
                      struct messages *m)
{
    struct csg_tree tree = {0};
    bool ok = csg_parse(&tree, name, text, size, m);
    free(text);
    if (ok)
        build(l, &tree, m, (struct load_times){l->noticed, started, clock_seconds(), 0});
    csg_free(&tree);
    return ok;
}

static void load_csg(struct loader *l);

static void on_retry(uv_timer_t *timer)
{
    load_csg(timer->data);
}

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

static void load_csg(struct loader *l)
{
    struct messages m = {0};
    struct error err;
    double started = clock_seconds();
    char *text;
    size_t size;
    if (!file_read(l->options.path, TEXT_LIMIT, &text, &size, &err)) {
        if (!try_again(l)) {
            messages_add(&m, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
            fail(l, &m);
        }
    } else if (size == 0 && try_again(l)) {
        free(text);
    } else if (!take_text(l, l->options.path, text, size, started, &m) && !try_again(l)) {
        fail(l, &m);
    }
    messages_free(&m);
}

static void forget_files(struct loader *l)
{
    for (uint32_t i = 0; i < l->file_count; i++)
        free(l->files[i]);
    l->file_count = 0;
}

// After a failure openscad does not tell all files: the ones from before still matter.
static void follow_files(struct loader *l, const struct scad_result *result, bool complete)
{
    if (complete)
        forget_files(l);
    for (uint32_t i = 0; i < result->file_count; i++) {
        uint32_t known = 0;
        while (known < l->file_count && strcmp(l->files[known], result->files[i]) != 0)
            known++;
        if (known < l->file_count)
            continue;
        array_reserve(&l->files, &l->file_capacity, l->file_count + 1);
        l->files[l->file_count++] = mem_strdup(result->files[i]);
    }
    watch_set(l->watch, l->files, l->file_count);
}

static void on_exported(void *context, struct scad_result *result, const struct error *err)
{
    struct loader *l = context;
    struct messages m = {0};
    l->job = NULL;
    if (err)
        messages_add(&m, MESSAGE_ERROR, (struct place){0}, "%s", err->text);
    else
        report_log(result->log, &m);
    if (l->watch)
        follow_files(l, result, !err);
    if (!result->text)
        fail(l, &m);
    else if (!take_text(l, result->name, result->text, result->size, clock_seconds(), &m))
        fail(l, &m);
    result->text = NULL;
    scad_result_free(result);
    messages_free(&m);
}

static void load(struct loader *l, double noticed)
{
    l->noticed = noticed;
    l->retry_ms = RETRY_FIRST_MS;
    uv_timer_stop(&l->retry);
    if (!l->is_scad) {
        load_csg(l);
        return;
    }
    if (l->job)
        scad_cancel(l->job);
    l->job = scad_start(&l->loop, l->options.path, l->options.openscad, on_exported, l);
    publish(l, NULL, NULL, false, true);
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

static void free_loaded(struct loaded *s)
{
    for (struct loaded *next; s; s = next) {
        next = s->next;
        shader_free(&s->shader);
        model_free(&s->model);
        free(s);
    }
}

static void on_wake(uv_async_t *handle)
{
    struct loader *l = handle->data;
    uv_mutex_lock(&l->mutex);
    struct loaded *retired = l->retired;
    bool reload = l->reload, stopping = l->stopping;
    l->retired = NULL;
    l->reload = false;
    uv_mutex_unlock(&l->mutex);
    free_loaded(retired);
    if (stopping) {
        if (l->job)
            scad_cancel(l->job);
        watch_delete(l->watch);
        uv_handle_t *handles[] = {(uv_handle_t *)&l->wake, (uv_handle_t *)&l->retry,
                                  (uv_handle_t *)&l->interrupt, (uv_handle_t *)&l->terminate};
        for (size_t i = 0; i < array_count(handles); i++)
            uv_close(handles[i], NULL);
    } else if (reload) {
        l->patient = false;
        load(l, clock_seconds());
    }
}

static void run(void *context)
{
    struct loader *l = context;
    l->store = solid_store_new();
    if (l->options.watch) {
        l->watch = watch_new(&l->loop, on_saved, l);
        array_reserve(&l->files, &l->file_capacity, 1);
        l->files[l->file_count++] = mem_strdup(l->options.path);
        watch_set(l->watch, l->files, l->file_count);
    }
    load(l, clock_seconds());
    uv_run(&l->loop, UV_RUN_DEFAULT);
    forget_files(l);
    free(l->files);
    solid_store_delete(l->store);
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
    l->wake.data = l->retry.data = l->interrupt.data = l->terminate.data = l;
    uv_mutex_init(&l->mutex);
    uv_async_init(&l->loop, &l->wake, on_wake);
    uv_timer_init(&l->loop, &l->retry);
    uv_signal_init(&l->loop, &l->interrupt);
    uv_signal_init(&l->loop, &l->terminate);
    uv_signal_start(&l->interrupt, on_signal, SIGINT);
    uv_signal_start(&l->terminate, on_signal, SIGTERM);
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
        out->message = mem_strdup(l->news.message ? l->news.message : "");
        l->news.loaded = NULL;
        l->fresh = false;
    }
    uv_mutex_unlock(&l->mutex);
    return fresh;
}

void loader_reload(struct loader *l)
{
    uv_mutex_lock(&l->mutex);
    l->reload = true;
    uv_mutex_unlock(&l->mutex);
    uv_async_send(&l->wake);
}

void loader_stop(struct loader *l)
{
    if (!l)
        return;
    loaded_release(l->news.loaded);
    uv_mutex_lock(&l->mutex);
    l->stopping = true;
    uv_mutex_unlock(&l->mutex);
    uv_async_send(&l->wake);
    uv_thread_join(&l->thread);
    uv_loop_close(&l->loop);
    free_loaded(l->retired);
    uv_mutex_destroy(&l->mutex);
    free(l->news.message);
    free(l);
}
