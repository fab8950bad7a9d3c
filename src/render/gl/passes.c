// passes.c - the buffers of a band and slab, and the walks over its lists.
#include "render/gl/pass.h"

#include "base/clock.h"
#include "base/mem.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { LARGE_PIECES = 64 << 10 }; // of large triangles; grows

void gl_work_free(struct gl_work *w)
{
    struct gl_buffer *all[] = {
        &w->frame,        &w->counters,   &w->views,  &w->starts, &w->counts,    &w->large,
        &w->pixel_counts, &w->offsets,    &w->links,  &w->states, &w->output,    &w->span_counts,
        &w->pending[0],   &w->pending[1], &w->misses, &w->claims, &w->fragments, &w->sums[0],
        &w->sums[1],      &w->sums[2],    &w->bins};
    for (size_t i = 0; i < array_count(all); i++)
        gl_buffer_free(all[i]);
    gl_readback_free(&w->readback);
    gl_timers_free(&w->timers);
}

static void trim(struct gl_buffer *b, size_t most)
{
    if (b->size > most)
        gl_buffer_free(b);
}

void gl_work_begin(struct gl_work *w, const struct gl_plan *plan, size_t budget, bool spans)
{
    struct gl_memory *m = w->memory;
    size_t pixels = (size_t)plan->rows * (size_t)plan->columns;
    w->plan = *plan;
    size_t sums = plan->numbers;
    for (size_t i = 0; i < array_count(w->sums); i++) {
        sums = sums / SCAN_BLOCK + 1;
        trim(&w->sums[i], sums * 4);
    }
    trim(&w->large, (size_t)plan->pieces * 16);
    trim(&w->pixel_counts, w->linked ? 0 : (pixels + 1) * 4);
    trim(&w->offsets, w->linked ? 0 : (pixels + 1) * 4);
    trim(&w->links, w->linked ? gl_links_size(pixels, plan->fragments) : 0);
    trim(&w->states, pixels * sizeof(struct pixel_state));
    trim(&w->pending[0], pixels * 4);
    trim(&w->pending[1], pixels * 4);
    trim(&w->span_counts, pixels * 4);
    trim(&w->misses, (size_t)plan->miss_words * 4);
    trim(&w->claims, (size_t)plan->claims * 4);
    trim(&w->fragments, (size_t)plan->fragments * sizeof(struct fragment));
    trim(&w->output,
         spans ? (pixels + plan->fragments / 2) * sizeof(struct span_data) : pixels * 12);
    if (w->readback.buffer.size > plan->staging)
        gl_readback_free(&w->readback);
    w->readback.timers = &w->timers;
    w->readback.waits = (struct render_waits){0};
    m->budget = budget;
    m->peak = m->used;
}

bool gl_work_prepare(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                     bool spans, struct error *err)
{
    struct gl_memory *m = w->memory, *model = w->model;
    const struct gl_plan *p = &w->plan;
    size_t leaves = scene->leaf_count, pixels = gl_pass_pixels(f);
    return gl_buffer_grow(&w->frame, m, "frame", sizeof *f, err) &&
           gl_buffer_grow(&w->counters, m, "counters", sizeof(struct counters), err) &&
           gl_buffer_grow(&w->bins, m, "bins", BINS * 4, err) &&
           gl_buffer_grow(&w->views, model, "views", leaves * sizeof(struct leaf_view), err) &&
           gl_buffer_grow(&w->starts, model, "starts", (leaves + 1) * 4, err) &&
           gl_buffer_grow(&w->counts, model, "counts", (leaves + 1) * 4, err) &&
           gl_work_pieces(w, p->pieces < LARGE_PIECES ? p->pieces : LARGE_PIECES, err) &&
           (w->linked ||
            (gl_buffer_grow(&w->pixel_counts, m, "pixel counts", (pixels + 1) * 4, err) &&
             gl_buffer_grow(&w->offsets, m, "offsets", (pixels + 1) * 4, err))) &&
           gl_buffer_grow(&w->states, m, "states", pixels * sizeof(struct pixel_state), err) &&
           gl_buffer_grow(&w->pending[0], m, "pending", pixels * 4, err) &&
           gl_buffer_grow(&w->pending[1], m, "pending", pixels * 4, err) &&
           gl_buffer_grow(&w->misses, m, "misses", (size_t)p->miss_words * 4, err) &&
           gl_buffer_grow(&w->claims, m, "claims", (size_t)p->claims * 4, err) &&
           (spans ? gl_buffer_grow(&w->span_counts, m, "span counts", pixels * 4, err)
                  : gl_buffer_grow(&w->output, m, "output", pixels * 12, err));
}

bool gl_work_read(struct gl_work *w, const struct gl_part *parts, uint32_t count, struct error *err)
{
    return gl_readback_take(&w->readback, w->memory, "readback", parts, count, w->plan.staging,
                            err);
}

bool gl_work_pieces(struct gl_work *w, uint32_t pieces, struct error *err)
{
    size_t most = (size_t)w->plan.pieces * 16;
    return gl_buffer_grow(&w->large, w->memory, "large", gl_pass_reserve((size_t)pieces * 16, most),
                          err);
}

bool gl_work_views(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                   struct error *err)
{
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    gl_pass_bind(w, scene);
    gl_buffer_bind(&w->views, BIND_VIEWS);
    gl_timer_begin(&w->timers, "views");
    bool fine =
        gl_pass_take(w, "leaf_view", "", (scene->leaf_count + GROUP_SIZE - 1) / GROUP_SIZE, err);
    gl_timer_end(&w->timers);
    return fine;
}

static void bind_walk(const struct gl_work *w, const struct gl_scene *scene,
                      const struct gl_table *table, bool spans)
{
    gl_pass_bind(w, scene);
    gl_buffer_bind(&scene->values, BIND_VALUES);
    gl_buffer_bind(&scene->solids->planes, BIND_PLANES);
    gl_buffer_bind(&scene->solids->faces, BIND_FACES);
    gl_pass_bind_lists(w);
    gl_buffer_bind(&w->states, BIND_STATES);
    gl_buffer_bind(&w->pending[0], BIND_PENDING);
    gl_buffer_bind(&w->pending[1], BIND_MISSED);
    gl_buffer_bind(&w->misses, BIND_MISSES);
    gl_buffer_bind(&w->claims, BIND_CLAIMS);
    gl_buffer_bind(&w->output, BIND_OUTPUT);
    if (w->array)
        gl_buffer_bind(&w->array->nodes, BIND_NODES);
    else
        gl_buffer_bind(gl_table_records(table), BIND_TABLE);
    if (spans)
        gl_buffer_bind(&w->span_counts, BIND_SPANS);
}

// One round of walks; *c: what came of it. `how`: what the shader is built with besides.
static bool walk(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                 const struct gl_table *table, bool spans, const char *how, struct counters *c,
                 struct error *err)
{
    static const uint32_t none[2];
    char defines[sizeof w->array->defines + 40];
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    gl_buffer_write(&w->counters, offsetof(struct counters, missed), none, sizeof none);
    gl_buffer_fill(&w->claims, 0, (size_t)w->plan.claims * 4, 0);
    bind_walk(w, scene, table, spans);
    snprintf(defines, sizeof defines, "%s %s %s", spans ? "SPANS" : "SURFACE",
             w->linked ? "LINKED" : "", w->array ? w->array->defines : how);
    gl_timer_begin(&w->timers, f->pending ? "rewalk" : "resolve");
    bool fine = gl_pass_take(
        w, "resolve", defines,
        ((f->pending ? f->pending : gl_pass_pixels(f)) + GROUP_SIZE - 1) / GROUP_SIZE, err);
    gl_timer_end(&w->timers);
    if (!fine)
        return false;
    return gl_pass_read(w, &w->counters, c, sizeof *c, err);
}

// Evaluates what a round of walks has put on record; *found: how much of it is new.
static bool learn(struct gl_work *w, const struct body *body, const struct counters *c,
                  uint32_t *found, struct error *err)
{
    size_t words = c->misses < w->plan.miss_words ? c->misses : w->plan.miss_words;
    uint32_t *records = mem_alloc((words + 1) * sizeof *records);
    bool fine = gl_pass_read(w, &w->misses, records, words * 4, err);
    *found = fine ? gl_discover(body, records, words) : 0;
    free(records);
    return fine;
}

// Brings values and combinations to where shaders see them.
static bool upload(struct gl_work *w, struct gl_scene *scene, struct frame_data *f,
                   struct gl_table *table, const struct body *body, struct render_stats *stats,
                   struct error *err)
{
    uint64_t uploaded = table->uploaded;
    gl_timer_begin(&w->timers, "upload");
    bool there = gl_table_upload(table, w->model, body->table, err);
    if (there && scene->renewals != discovery_renewals(body->table))
        gl_scene_renew(scene, body);
    gl_timer_end(&w->timers);
    stats->table_bytes += table->uploaded - uploaded;
    f->table_shift = table->shift;
    return there;
}

// A walk in which what is unknown is empty; then one ray of each square records what it misses.
static bool resolve_over_frames(struct gl_work *w, struct gl_scene *scene, struct frame_data *f,
                                struct gl_table *table, const struct body *body, bool spans,
                                struct counters *c, struct render_stats *stats, struct error *err)
{
    struct counters recorded;
    gl_learner_finish(w->learner, stats);
    if (!upload(w, scene, f, table, body, stats, err) ||
        !walk(w, scene, f, table, spans, "OVER_FRAMES", c, err))
        return false;
    stats->missing += c->missed;
    if (!c->missed)
        return true;

    uint32_t squares = (uint32_t)((f->columns + REDUCE_SIDE - 1) / REDUCE_SIDE *
                                  ((f->rows + REDUCE_SIDE - 1) / REDUCE_SIDE));
    gl_timer_begin(&w->timers, "reduce");
    bool fine = gl_pass_take(w, "reduce", "", squares, err);
    gl_timer_end(&w->timers);
    f->pending = squares;
    f->ahead = AHEAD_FRAMES + 1;
    if (!fine || !walk(w, scene, f, table, spans, "", &recorded, err))
        return false;
    size_t words = recorded.misses < w->plan.miss_words ? recorded.misses : w->plan.miss_words;
    if (!gl_pass_read(w, &w->misses, gl_learner_room(w->learner, words), words * 4, err))
        return false;
    f->pending = 0;
    return f->slab_last || walk(w, scene, f, table, spans, "OVER_FRAMES CARRY", c, err);
}

bool gl_work_resolve(struct gl_work *w, struct gl_scene *scene, struct frame_data *f,
                     struct gl_table *table, const struct body *body, bool spans, uint32_t *stuck,
                     uint32_t *alive, struct render_stats *stats, struct error *err)
{
    struct counters c = {.resume = UINT32_MAX};
    gl_buffer_write(&w->counters, 0, &c, sizeof c);
    f->pending = 0;
    f->ahead = AHEAD;
    f->miss_most = w->plan.miss_words;
    f->claim_mask = w->plan.claims - 1;
    *stuck = 0;
    if (w->learner && !resolve_over_frames(w, scene, f, table, body, spans, &c, stats, err))
        return false;
    while (!w->learner) {
        if (!upload(w, scene, f, table, body, stats, err) ||
            !walk(w, scene, f, table, spans, "", &c, err))
            return false;
        if (!c.missed)
            break;
        struct gl_buffer swap = w->pending[0];
        w->pending[0] = w->pending[1];
        w->pending[1] = swap;
        f->pending = c.missed;
        uint32_t found;
        double begun = clock_seconds();
        if (!learn(w, body, &c, &found, err))
            return false;
        struct render_pass pass = {"discover", clock_seconds() - begun, 1};
        render_stats_pass(stats, &pass);
        stats->misses += found;
        bool full = c.misses > w->plan.miss_words;
        if (!found && full && f->ahead == 1) {
            error_set(err, "records of unknown combinations need more memory than there is");
            return false;
        }
        if (!found && !full) {
            *stuck = c.missed;
            break;
        }
        f->ahead = found ? AHEAD : 1; // what the first ones go on from may have had no room
    }
    discovery_settle(body->table);
    stats->open_rays += f->slab_first ? c.open : 0; // each slab sees all of a ray that may be open
    *alive = c.alive;
    return true;
}
