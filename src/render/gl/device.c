// device.c - the gl device: which bodies stay on the graphics processor, and how pictures are told.
#include "render/gl/device.h"

#include "base/clock.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "render/gl/bands.h"
#include "render/gl/spans.h"

#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_DEFAULT = 256 << 20,
    CHUNK_ROWS = 64, // are told of at once
    RESIDENTS = 8,   // bodies that stay on the graphics processor
};

// A body on the graphics processor.
struct resident {
    uint64_t identity; // discovery_identity
    uint64_t used;     // number of the picture that used it last
    struct gl_scene scene;
    struct gl_table table;
    struct gl_array array; // once the bench has asked for it
    struct gl_learner learner;
};

struct gl_device {
    struct device device;
    struct gl_context *context;
    struct gl_programs programs;
    struct gl_memory model;  // account of what comes from the body
    struct gl_memory memory; // and of everything else
    struct gl_work work;
    struct resident residents[RESIDENTS];
    uint64_t pictures;
};

static void evict(struct resident *r)
{
    gl_scene_free(&r->scene);
    gl_table_free(&r->table);
    gl_buffer_free(&r->array.nodes);
    gl_learner_free(&r->learner);
    *r = (struct resident){0};
}

// Makes the body resident, in place of the one that was not used for longest.
static bool settle(struct gl_device *d, struct gl_drawing *g)
{
    uint64_t identity = discovery_identity(g->body->table);
    struct resident *oldest = d->residents;
    struct gl_solids *solids = NULL; // of another body, when it has all that is needed
    d->pictures++;
    for (int i = 0; i < RESIDENTS; i++) {
        struct resident *r = &d->residents[i];
        if (r->identity == identity) {
            r->used = d->pictures;
            g->scene = &r->scene;
            g->table = &r->table;
            g->array = &r->array;
            g->learner = &r->learner;
            return true;
        }
        oldest = r->used < oldest->used ? r : oldest;
        if (!solids && gl_solids_suffice(r->scene.solids, g->body))
            solids = r->scene.solids;
    }
    struct gl_scene scene = {0};
    gl_timer_begin(&d->work.timers, "upload");
    if (!solids) // makes room first
        evict(oldest);
    bool there = gl_scene_upload(&scene, &d->model, g->body, solids, g->err);
    gl_timer_end(&d->work.timers);
    evict(oldest);
    if (!there) {
        gl_scene_free(&scene);
        return false;
    }
    oldest->scene = scene;
    oldest->identity = identity;
    oldest->used = d->pictures;
    g->scene = &oldest->scene;
    g->table = &oldest->table;
    g->array = &oldest->array;
    g->learner = &oldest->learner;
    return true;
}

static bool choose_walk(struct gl_device *d, struct gl_drawing *g)
{
    bool by_array = g->settings->walk == WALK_ARRAY;
    bool over_frames = g->settings->discovery == DISCOVER_OVER_FRAMES && !by_array;
    d->work.array = by_array ? g->array : NULL;
    d->work.learner = over_frames ? g->learner : NULL;
    if (over_frames)
        gl_learner_start(g->learner, g->body);
    else
        g->learner->words = 0;
    return !by_array || g->array->nodes.id || gl_array_upload(g->array, &d->model, g->body, g->err);
}

// What numbers of the shaders cannot hold.
static bool countable(const struct gl_drawing *g)
{
    const int most = (1 << 16) * PIECE; // a piece's place is two numbers of 16 bits
    if (g->rays->width <= most && g->rays->height <= most)
        return true;
    error_set(g->err, "the gl device draws no more than %d pixels a side", most);
    return false;
}

static bool begin(struct gl_device *d, struct gl_drawing *g)
{
    size_t budget = g->settings->memory ? g->settings->memory : MEMORY_DEFAULT;
    struct gl_plan plan;
    if (!countable(g) ||
        !gl_plan_make(&plan, budget, gl_context_facts(d->context)->storage_size, g->rays->width,
                      g->rays->height, g->body->leaf_count, g->spans, g->settings->linked, g->err))
        return false;
    d->work.linked = g->settings->linked;
    gl_work_begin(&d->work, &plan, budget, g->spans);
    d->model.peak = d->model.used;
    gl_frame_init(&g->frame, g->body, g->rays, g->settings);
    if (!gl_frame_range(&g->frame, g->rays, g->body, &g->near, &g->far))
        g->near = g->far = g->frame.start;
    g->whole = g->settings->walk == WALK_ARRAY; // counters are not carried on
    return settle(d, g) && choose_walk(d, g);
}

// The times of the picture's passes, all of which have ended but for the last copies.
static void tell_passes(struct gl_drawing *g)
{
    struct gl_timers *t = &g->work->timers;
    gl_timers_collect(t, true);
    for (uint32_t i = 0; i < t->count; i++) {
        const struct gl_pass *p = &t->passes[i];
        render_stats_pass(g->stats, &(struct render_pass){p->name, p->seconds, p->count});
    }
    gl_timers_restart(t);
}

// Draws in the context.
static int run(struct device *device, struct gl_drawing *g)
{
    struct gl_device *d = (struct gl_device *)device;
    double begun = clock_seconds();
    g->context = d->context;
    g->work = &d->work;
    if (!gl_context_enter(d->context, g->err))
        return 0;
    int rows = 0;
    if (begin(d, g)) {
        g->stats->seconds_setup = clock_seconds() - begun;
        begun = clock_seconds();
        rows = gl_bands_draw(g);
        g->stats->seconds_draw = clock_seconds() - begun;
    }
    if (g->learner)
        gl_learner_finish(g->learner, g->stats);
    tell_passes(g);
    g->stats->peak_bytes = d->memory.peak;
    g->stats->model_bytes = d->model.peak;
    g->stats->waits = d->work.readback.waits;
    gl_slabs_free(&g->slabs);
    gl_context_leave(d->context);
    return rows;
}

// ------------------------------------------------------------------------------------ first
// surfaces

struct surfaces {
    struct surface_image *out;
    void (*drawn)(void *context, struct pixel_rect rect, bool nothing);
    void *context;
    int band, rows; // being told of
};

static void tell_chunk(void *context, uint32_t chunk, uint32_t worker)
{
    const struct surfaces *s = context;
    (void)worker;
    int y0 = s->band + (int)chunk * CHUNK_ROWS, end = s->band + s->rows;
    int y1 = end - y0 < CHUNK_ROWS ? end : y0 + CHUNK_ROWS;
    bool nothing = true;
    size_t width = (size_t)s->out->width;
    for (size_t i = (size_t)y0 * width; i < (size_t)y1 * width && nothing; i++)
        nothing = s->out->leaf[i] == SURFACE_NONE;
    s->drawn(s->context, (struct pixel_rect){0, y0, s->out->width, y1}, nothing);
}

// The band's planes of depth, leaf and face.
static bool read_surfaces(struct gl_drawing *g, const struct surface_image *out)
{
    const struct frame_data *f = &g->frame;
    const struct gl_buffer *output = &g->work->output;
    size_t n = (size_t)f->columns * (size_t)f->rows; // together: of one row, or all columns
    size_t at = (size_t)f->width * (size_t)f->band + (size_t)f->column;
    const struct gl_part planes[] = {{output, 0, n * 4, out->depth + at},
                                     {output, n * 4, n * 4, out->leaf + at},
                                     {output, n * 8, n * 4, out->face + at}};
    return gl_work_read(g->work, planes, array_count(planes), g->err);
}

static bool take_surfaces(struct gl_drawing *g, enum gl_taken what)
{
    struct surfaces *s = g->taker;
    s->band = g->frame.band;
    s->rows = g->frame.rows;
    if (what == GL_BAND)
        return read_surfaces(g, s->out);
    if (what == GL_ROWS && s->drawn)
        parallel_for((uint32_t)((s->rows + CHUNK_ROWS - 1) / CHUNK_ROWS), g->settings->threads,
                     tell_chunk, s);
    return true;
}

static int first_surface(struct device *device, const struct body *body, const struct rays *rays,
                         const struct render_settings *settings, struct surface_image *out,
                         void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                         void *context, struct render_stats *stats, struct error *err)
{
    struct surfaces s = {.out = out, .drawn = drawn, .context = context};
    struct gl_drawing g = {.body = body,
                           .rays = rays,
                           .settings = settings,
                           .stats = stats,
                           .take = take_surfaces,
                           .taker = &s,
                           .err = err};
    return run(device, &g);
}

// --------------------------------------------------------------------------------------------
// spans

struct span_sink {
    void (*sink)(void *context, uint32_t worker, const struct span_block *block);
    void *context;
    const struct frame_data *frame;
    struct gl_spans spans; // of the rows of the band
    uint32_t kept;         // parts of it that will not come again
};

static void tell_row(void *context, uint32_t row, uint32_t worker)
{
    const struct span_sink *s = context;
    uint32_t *first;
    struct span *spans;
    gl_spans_row(&s->spans, row, s->frame->width, &first, &spans);
    int y = s->frame->band + (int)row;
    struct span_block block = {0, y, s->frame->width, y + 1, first, spans};
    s->sink(s->context, worker, &block);
    free(first);
    free(spans);
}

static bool take_spans(struct gl_drawing *g, enum gl_taken what)
{
    struct span_sink *s = g->taker;
    switch (what) {
    case GL_SLAB:
        return gl_spans_add(&s->spans, g->work, &g->frame, g->err);
    case GL_AGAIN:
        gl_spans_keep(&s->spans, s->kept);
        return true;
    case GL_BAND:
        s->kept = s->spans.count;
        return true;
    case GL_ROWS:
        s->frame = &g->frame;
        parallel_for((uint32_t)g->frame.rows, g->settings->threads, tell_row, s);
        gl_spans_keep(&s->spans, s->kept = 0);
        return true;
    }
    return false;
}

static int spans(struct device *device, const struct body *body, const struct rays *rays,
                 const struct render_settings *settings,
                 void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                 void *context, struct render_stats *stats, struct error *err)
{
    struct span_sink s = {.sink = sink, .context = context};
    struct gl_drawing g = {.body = body,
                           .rays = rays,
                           .settings = settings,
                           .stats = stats,
                           .spans = true,
                           .take = take_spans,
                           .taker = &s,
                           .err = err};
    int rows = run(device, &g);
    gl_spans_free(&s.spans);
    return rows;
}

// -------------------------------------------------------------------------------------------
// device

static void delete (struct device *device)
{
    struct gl_device *d = (struct gl_device *)device;
    struct error err;
    if (gl_context_enter(d->context, &err)) {
        for (int i = 0; i < RESIDENTS; i++)
            evict(&d->residents[i]);
        gl_work_free(&d->work);
        gl_programs_free(&d->programs);
        gl_context_leave(d->context);
    }
    gl_context_delete(d->context);
    free(d);
}

static struct gl_context *find_context(const struct device_host *host, const struct gl_log *log,
                                       struct error *err)
{
    struct error first, second;
    struct gl_context *context = gl_context_new(log, &first);
    if (!context && host && host->open_context) {
        context = gl_context_adopt(host->open_context, host->context, log, &second);
        if (!context)
            error_set(err, "%s; window: %s", first.text, second.text);
    } else if (!context) {
        *err = first;
    }
    return context;
}

struct device *gl_device_new(bool software, const struct device_host *host, struct error *err)
{
    static const struct device_kind kind = {first_surface, spans, delete};
    struct gl_log said = {0};
    if (host && host->say && getenv(GL_SHADER_FOLDER))
        said = (struct gl_log){host->say, host->context};
    const struct gl_log *log = said.say ? &said : NULL;
    struct gl_context *context = find_context(host, log, err);
    if (!context)
        return NULL;
    const struct gl_facts *facts = gl_context_facts(context);
    if (!software && facts->software) {
        error_set(err, "%s draws on the processor", facts->renderer);
    } else if (gl_facts_suffice(facts, err)) {
        struct gl_device *d = mem_zalloc(sizeof *d);
        d->device.kind = &kind;
        d->context = context;
        snprintf(d->device.description, sizeof d->device.description, "%s, OpenGL %s",
                 facts->renderer, facts->version);
        gl_programs_init(&d->programs, log);
        d->model.budget = SIZE_MAX;
        d->model.largest = d->memory.largest = facts->storage_size;
        d->work.memory = &d->memory;
        d->work.model = &d->model;
        d->work.programs = &d->programs;
        return &d->device;
    }
    gl_context_delete(context);
    return NULL;
}
