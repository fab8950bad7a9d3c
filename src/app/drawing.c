// drawing.c - draws pictures on a thread of its own: always the newest that was asked for.
#include "app/drawing.h"

#include "base/clock.h"
#include "base/mem.h"
#include "render/picture.h"

#include <stdlib.h>
#include <string.h>
#include <uv.h>

struct drawing {
    uv_thread_t thread;
    struct device *device;
    void (*done)(void *context);
    void *context;

    uv_mutex_t mutex; // guards what follows
    uv_cond_t asked;
    struct drawing_job next; // loaded NULL: nothing asked for
    struct shot newest;
    bool fresh, stopping;
    struct error failure;  // of the device; empty: none, or taken
    int divisor;           // of the picture being drawn, 0 when none is
    atomic_bool cancelled; // that picture is not wanted any more
};

void shot_free(struct shot *s)
{
    loaded_release(s->job.loaded);
    free(s->rgb);
    *s = (struct shot){0};
}

static void draw(struct shot *s, const struct drawing_job *job, struct device *device,
                 struct picture *picture)
{
    loaded_release(s->job.loaded);
    s->job = *job;
    s->begun = clock_seconds();
    struct rays rays =
        camera_rays(&job->camera, job->width, job->height, job->loaded->model.bounds);
    picture_draw(picture, device, &job->loaded->shader, &rays, &job->settings, &s->stats);
    size_t size = 3 * (size_t)job->width * (size_t)job->height;
    if (s->capacity < size) {
        free(s->rgb);
        s->rgb = mem_alloc(size);
        s->capacity = size;
    }
    memcpy(s->rgb, picture->rgb, size);
    s->combinations = 0;
    for (uint32_t i = 0; i < job->loaded->model.body_count; i++)
        if (job->loaded->model.bodies[i].table)
            s->combinations += discovery_stats(job->loaded->model.bodies[i].table).combinations;
    s->done = clock_seconds();
}

static void exchange(struct shot *a, struct shot *b)
{
    struct shot old = *a;
    *a = *b;
    *b = old;
}

static void run(void *context)
{
    struct drawing *d = context;
    struct picture picture = {0};
    struct shot work = {0};
    for (;;) {
        uv_mutex_lock(&d->mutex);
        while (!d->next.loaded && !d->stopping)
            uv_cond_wait(&d->asked, &d->mutex);
        struct drawing_job job = d->next;
        d->next.loaded = NULL;
        d->divisor = job.divisor;
        atomic_store(&d->cancelled, false);
        bool stopping = d->stopping;
        uv_mutex_unlock(&d->mutex);
        if (stopping) {
            loaded_release(job.loaded);
            break;
        }
        job.settings.cancelled = &d->cancelled;
        draw(&work, &job, d->device, &picture);
        struct error failure;
        bool failed = device_failed(d->device, &failure);
        uv_mutex_lock(&d->mutex);
        if (failed)
            d->failure = failure;
        bool whole = !atomic_load(&d->cancelled);
        d->divisor = 0;
        if (whole) {
            exchange(&work, &d->newest);
            d->fresh = true;
        }
        uv_mutex_unlock(&d->mutex);
        if (whole)
            d->done(d->context);
    }
    shot_free(&work);
    picture_free(&picture);
}

struct drawing *drawing_start(struct device *device, void (*done)(void *context), void *context,
                              struct error *err)
{
    struct drawing *d = mem_zalloc(sizeof *d);
    d->device = device;
    d->done = done;
    d->context = context;
    uv_mutex_init(&d->mutex);
    uv_cond_init(&d->asked);
    int failed = uv_thread_create(&d->thread, run, d);
    if (failed) {
        error_set(err, "cannot start a thread: %s", uv_strerror(failed));
        uv_cond_destroy(&d->asked);
        uv_mutex_destroy(&d->mutex);
        device_delete(device);
        free(d);
        return NULL;
    }
    return d;
}

void drawing_ask(struct drawing *d, const struct drawing_job *job)
{
    uv_mutex_lock(&d->mutex);
    struct loaded *replaced = d->next.loaded;
    d->next = *job;
    loaded_hold(job->loaded);
    if (d->divisor && job->divisor > d->divisor) // a drag begins: its pictures are coarse and soon
        atomic_store(&d->cancelled, true);       // there, the fine one under way would hold them up
    uv_cond_signal(&d->asked);
    uv_mutex_unlock(&d->mutex);
    loaded_release(replaced);
}

bool drawing_take(struct drawing *d, struct shot *shot)
{
    uv_mutex_lock(&d->mutex);
    bool fresh = d->fresh;
    if (fresh)
        exchange(shot, &d->newest);
    d->fresh = false;
    uv_mutex_unlock(&d->mutex);
    return fresh;
}

bool drawing_failed(struct drawing *d, struct error *why)
{
    uv_mutex_lock(&d->mutex);
    bool failed = d->failure.text[0] != 0;
    if (failed)
        *why = d->failure;
    d->failure.text[0] = 0;
    uv_mutex_unlock(&d->mutex);
    return failed;
}

void drawing_cancel(struct drawing *d)
{
    uv_mutex_lock(&d->mutex);
    atomic_store(&d->cancelled, true);
    uv_mutex_unlock(&d->mutex);
}

void drawing_stop(struct drawing *d)
{
    if (!d)
        return;
    uv_mutex_lock(&d->mutex);
    d->stopping = true;
    atomic_store(&d->cancelled, true);
    uv_cond_signal(&d->asked);
    uv_mutex_unlock(&d->mutex);
    uv_thread_join(&d->thread);
    shot_free(&d->newest);
    device_delete(d->device);
    uv_cond_destroy(&d->asked);
    uv_mutex_destroy(&d->mutex);
    free(d);
}
