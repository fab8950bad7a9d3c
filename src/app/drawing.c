// drawing.c - draws pictures on a thread of its own: always the newest that was asked for.
#include "app/drawing.h"

#include "base/clock.h"
#include "base/mem.h"
#include "render/facets.h"
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

// What is made of a model before its first picture, and kept for the next ones.
struct prepared {
    struct loaded *loaded; // held; NULL: nothing is prepared
    struct shader shader;
    struct facets *facets; // NULL until edges are asked for
};

static void prepared_free(struct prepared *p)
{
    facets_delete(p->facets);
    if (p->loaded)
        shader_free(&p->shader);
    loaded_release(p->loaded);
    *p = (struct prepared){0};
}

static void prepare(struct prepared *p, const struct drawing_job *job)
{
    if (p->loaded != job->loaded || p->shader.scheme != job->scheme) {
        prepared_free(p);
        p->loaded = loaded_hold(job->loaded);
        shader_init(&p->shader, &p->loaded->model, job->scheme);
    }
    if (job->view.edges && !p->facets)
        p->facets = facets_new(&p->loaded->model);
}

// As OpenSCAD: of evaluated geometry the result of a boolean shows its edges, a lone shape none.
static void want_edges(struct prepared *p, struct picture *picture, bool edges)
{
    const struct model *m = &p->loaded->model;
    bool wires = edges && m->mode == MODEL_RENDER && !m->single && !m->flat;
    p->shader.edges = edges && m->mode == MODEL_PREVIEW ? p->facets : NULL;
    picture->wires = wires ? p->facets : NULL;
}

static void draw(struct shot *s, const struct drawing_job *job, struct device *device,
                 struct prepared *prepared, struct picture *picture)
{
    loaded_release(s->job.loaded);
    s->job = *job;
    s->begun = clock_seconds();
    struct rays rays =
        camera_rays(&job->camera, job->width, job->height, job->loaded->model.bounds);
    const struct overlay overlay = {.scheme = job->scheme,
                                    .centre = job->camera.centre,
                                    .distance = job->camera.distance,
                                    .axes = job->view.axes,
                                    .scales = job->view.axes && job->view.scales,
                                    .crosshairs = job->view.crosshairs};
    prepare(prepared, job);
    want_edges(prepared, picture, job->view.edges);
    picture->overlay = &overlay;
    picture_draw(picture, device, &prepared->shader, &rays, &job->settings, &s->stats);
    picture->overlay = NULL;
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
    struct prepared prepared = {0};
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
        draw(&work, &job, d->device, &prepared, &picture);
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
    prepared_free(&prepared);
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
