// device.c - the gl device: pictures cut into bands of rows and slabs of depth that fit the budget.
#include "render/gl/device.h"

#include "base/clock.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "render/gl/passes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMORY_DEFAULT = 256 << 20,
    PIXEL_BYTES = 64, // of all buffers of a band, rounded up
    CHUNK_ROWS = 64,  // are told of at once
    RESIDENTS = 8,    // bodies that stay on the graphics processor
};

// A body on the graphics processor.
struct resident {
    uint64_t identity; // discovery_identity
    uint64_t used;     // number of the picture that used it last
    struct gl_scene scene;
    struct gl_table table;
    struct gl_array array; // once the bench has asked for it
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

// A picture that is being drawn.
struct drawing {
    struct gl_device *d;
    const struct body *body;
    const struct rays *rays;
    const struct render_settings *settings;
    struct render_stats *stats;
    struct resident *resident;
    struct frame_data frame;
    bool spans;
    bool whole;      // the band is not cut in depth
    float near, far; // keys between which leaves lie
    size_t most;     // fragments that the budget has room for
    struct error *err;
};

static bool cancelled(const struct drawing *g)
{
    const atomic_bool *c = g->settings->cancelled;
    return c && atomic_load_explicit(c, memory_order_relaxed);
}

// ------------------------------------------------------------------------------------ bands and
// slabs

// Makes the crossings of the band up to frame.slab_end, or up to where there is room for them.
// False: not even the nearest have room; *failed: nor had the driver.
static bool fill(struct drawing *g, float begin, bool *failed)
{
    struct frame_data *f = &g->frame;
    struct gl_work *w = &g->d->work;
    uint32_t fragments, pieces;
    *failed = false;
    for (;;) {
        if (!gl_work_count(w, &g->resident->scene, f, &fragments, &pieces, g->err)) {
            *failed = true;
            return false;
        }
        if (pieces > f->large_most) {
            if ((size_t)pieces * 16 > g->most * sizeof(struct fragment) / 2)
                return false;
            *failed = !gl_buffer_grow(&w->large, w->memory, "large", (size_t)pieces * 16, g->err);
            if (*failed)
                return false;
            continue;
        }
        if (fragments <= g->most || (f->rows == 1 && g->whole))
            break;
        float end = begin + (fminf(f->slab_end, g->far) - begin) / 2;
        if (g->whole || !(end > begin && end < f->slab_end)) {
            if (f->rows > 1)
                return false;
            break; // a row at one depth: less is not to be had
        }
        f->slab_end = end;
        f->slab_last = false;
    }
    g->stats->fragments += fragments;
    *failed = !gl_work_scatter(w, &g->resident->scene, f, fragments, g->spans, g->err);
    return !*failed;
}

enum outcome { BAND_DONE, BAND_TOO_LARGE, BAND_FAILED };

static enum outcome draw_band(struct drawing *g, uint32_t *stuck)
{
    struct frame_data *f = &g->frame;
    float begin = g->near;
    uint32_t alive = 1;
    bool failed;
    if (!gl_work_prepare(&g->d->work, &g->resident->scene, f, g->spans, g->err) ||
        !gl_work_views(&g->d->work, &g->resident->scene, f, g->err))
        return BAND_FAILED;
    for (f->slab_first = true; alive; f->slab_first = false) {
        f->slab_end = f->end;
        f->slab_last = true;
        if (!fill(g, begin, &failed))
            return failed ? BAND_FAILED : BAND_TOO_LARGE;
        if (!gl_work_resolve(&g->d->work, &g->resident->scene, f, &g->resident->table, g->body,
                             g->spans, stuck, &alive, g->stats, g->err))
            return BAND_FAILED;
        if (*stuck || f->slab_last || cancelled(g))
            break;
        begin = f->slab_end;
    }
    return BAND_DONE;
}

// How many rows of the picture fit the budget at once.
static int rows_within(const struct drawing *g)
{
    size_t budget = g->settings->memory ? g->settings->memory : MEMORY_DEFAULT;
    size_t rows = budget / 4 / PIXEL_BYTES / (size_t)g->rays->width;
    return rows < 1 ? 1 : rows < (size_t)g->rays->height ? (int)rows : g->rays->height;
}

// Draws the picture band by band; `take` gets each. Returns the rows that are done.
static int draw(struct drawing *g, bool (*take)(struct drawing *g, void *context), void *context)
{
    struct frame_data *f = &g->frame;
    int rows = rows_within(g);
    uint32_t stuck = 0;
    for (f->band = 0; f->band < f->height && !cancelled(g);) {
        f->rows = f->height - f->band < rows ? f->height - f->band : rows;
        enum outcome o = draw_band(g, &stuck);
        if (o == BAND_TOO_LARGE) {
            rows = f->rows > 1 ? f->rows / 2 : 1;
            continue;
        }
        if (o == BAND_DONE && stuck)
            error_set(g->err, "%u combinations share one primary key", stuck);
        if (o == BAND_FAILED || stuck || gl_context_failed(g->d->context, g->err))
            return f->band;
        if (!take(g, context))
            return f->band;
        f->band += f->rows;
    }
    return f->height;
}

static void evict(struct resident *r)
{
    gl_scene_free(&r->scene);
    gl_buffer_free(&r->table.records);
    gl_buffer_free(&r->array.nodes);
    *r = (struct resident){0};
}

// Makes the body resident, in place of the one that was not used for longest.
static bool settle(struct drawing *g)
{
    struct gl_device *d = g->d;
    uint64_t identity = discovery_identity(g->body->table);
    struct resident *oldest = d->residents;
    d->pictures++;
    for (int i = 0; i < RESIDENTS; i++) {
        struct resident *r = &d->residents[i];
        if (r->identity == identity) {
            r->used = d->pictures;
            g->resident = r;
            return true;
        }
        oldest = r->used < oldest->used ? r : oldest;
    }
    evict(oldest);
    gl_timer_begin(&d->work.timers, "upload");
    bool there = gl_scene_upload(&oldest->scene, &d->model, g->body, g->err);
    gl_timer_end(&d->work.timers);
    if (!there) {
        evict(oldest);
        return false;
    }
    oldest->identity = identity;
    oldest->used = d->pictures;
    g->resident = oldest;
    return true;
}

static bool choose_walk(struct drawing *g)
{
    struct gl_array *a = &g->resident->array;
    bool by_array = g->settings->walk == WALK_ARRAY;
    g->d->work.array = by_array ? a : NULL;
    return !by_array || a->nodes.id || gl_array_upload(a, &g->d->model, g->body, g->err);
}

static bool begin(struct drawing *g)
{
    size_t budget = g->settings->memory ? g->settings->memory : MEMORY_DEFAULT;
    size_t block = gl_context_facts(g->d->context)->storage_size;
    g->most = (budget < block ? budget / 2 : block / 2) / sizeof(struct fragment);
    gl_frame_init(&g->frame, g->body, g->rays, g->settings);
    if (!gl_frame_range(&g->frame, g->rays, g->body, &g->near, &g->far))
        g->near = g->far = g->frame.start;
    g->whole = g->spans || g->settings->walk == WALK_ARRAY; // counters are not carried on
    return settle(g) && choose_walk(g);
}

// The times of the picture's passes, all of which have ended but for the last copies.
static void tell_passes(struct drawing *g)
{
    struct gl_timers *t = &g->d->work.timers;
    gl_timers_collect(t, true);
    for (uint32_t i = 0; i < t->count; i++) {
        const struct gl_pass *p = &t->passes[i];
        render_stats_pass(g->stats, &(struct render_pass){p->name, p->seconds, p->count});
    }
    gl_timers_restart(t);
}

// Draws in the context.
static int run(struct drawing *g, bool (*take)(struct drawing *g, void *context), void *context)
{
    double begun = clock_seconds();
    if (!gl_context_enter(g->d->context, g->err))
        return 0;
    int rows = 0;
    if (begin(g)) {
        g->stats->seconds_setup = clock_seconds() - begun;
        begun = clock_seconds();
        rows = draw(g, take, context);
        g->stats->seconds_draw = clock_seconds() - begun;
    }
    tell_passes(g);
    g->stats->peak_bytes = g->d->memory.peak;
    gl_context_leave(g->d->context);
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

static bool take_surfaces(struct drawing *g, void *context)
{
    struct surfaces *s = context;
    size_t width = (size_t)g->frame.width;
    size_t n = width * (size_t)g->frame.rows, at = width * (size_t)g->frame.band;
    const uint32_t *output = gl_work_read(&g->d->work, &g->d->work.output, n * 12, g->err);
    if (!output)
        return false;
    memcpy(s->out->depth + at, output, n * 4);
    memcpy(s->out->leaf + at, output + n, n * 4);
    memcpy(s->out->face + at, output + 2 * n, n * 4);
    s->band = g->frame.band;
    s->rows = g->frame.rows;
    if (s->drawn)
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
    struct drawing g = {.d = (struct gl_device *)device,
                        .body = body,
                        .rays = rays,
                        .settings = settings,
                        .stats = stats,
                        .err = err};
    return run(&g, take_surfaces, &s);
}

// --------------------------------------------------------------------------------------------
// spans

struct span_sink {
    void (*sink)(void *context, uint32_t worker, const struct span_block *block);
    void *context;
    const struct frame_data *frame;
    const uint32_t *offsets, *counts;
    const struct span *spans;
};

// One row of the band: its spans stand at the places of its crossings.
static void tell_row(void *context, uint32_t row, uint32_t worker)
{
    const struct span_sink *s = context;
    uint32_t width = (uint32_t)s->frame->width, begun = row * width, total = 0;
    uint32_t *first = mem_alloc((width + 1) * sizeof *first);
    for (uint32_t x = 0; x < width; x++) {
        first[x] = total;
        total += s->counts[begun + x];
    }
    first[width] = total;
    struct span *spans = mem_alloc((total + 1) * sizeof *spans);
    for (uint32_t x = 0; x < width; x++)
        for (uint32_t k = 0; k < s->counts[begun + x]; k++)
            spans[first[x] + k] = s->spans[s->offsets[begun + x] / 2 + begun + x + k];
    int y = s->frame->band + (int)row;
    struct span_block block = {0, y, s->frame->width, y + 1, first, spans};
    s->sink(s->context, worker, &block);
    free(first);
    free(spans);
}

// The first bytes of a buffer, to be freed. NULL when the context is lost.
static void *copy_of(struct drawing *g, const struct gl_buffer *b, size_t size)
{
    const void *now = gl_work_read(&g->d->work, b, size, g->err);
    return now ? memcpy(mem_alloc(size), now, size) : NULL;
}

static bool take_spans(struct drawing *g, void *context)
{
    struct span_sink *s = context;
    struct gl_work *w = &g->d->work;
    size_t pixels = (size_t)g->frame.width * (size_t)g->frame.rows;
    uint32_t *offsets = copy_of(g, &w->offsets, (pixels + 1) * 4);
    uint32_t *counts = copy_of(g, &w->span_counts, pixels * 4);
    const struct span *spans = NULL;
    if (offsets && counts) {
        size_t places = offsets[pixels] / 2 + pixels;
        spans = gl_work_read(w, &w->output, places * sizeof *spans, g->err);
    }
    if (spans) {
        s->frame = &g->frame;
        s->offsets = offsets;
        s->counts = counts;
        s->spans = spans;
        parallel_for((uint32_t)g->frame.rows, g->settings->threads, tell_row, s);
    }
    free(offsets);
    free(counts);
    return spans;
}

static int spans(struct device *device, const struct body *body, const struct rays *rays,
                 const struct render_settings *settings,
                 void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                 void *context, struct render_stats *stats, struct error *err)
{
    struct span_sink s = {.sink = sink, .context = context};
    struct drawing g = {.d = (struct gl_device *)device,
                        .body = body,
                        .rays = rays,
                        .settings = settings,
                        .stats = stats,
                        .spans = true,
                        .err = err};
    return run(&g, take_spans, &s);
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

struct device *gl_device_new(bool software, struct error *err)
{
    static const struct device_kind kind = {first_surface, spans, delete};
    struct gl_context *context = gl_context_new(NULL, err);
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
        gl_programs_init(&d->programs, NULL);
        d->model.budget = d->memory.budget = SIZE_MAX;
        d->work.memory = &d->memory;
        d->work.programs = &d->programs;
        return &d->device;
    }
    gl_context_delete(context);
    return NULL;
}
