// passes.c - the passes of a band and slab.
#include "render/gl/passes.h"

#include "base/clock.h"
#include "base/mem.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { LARGE_PIECES = 64 << 10 }; // of large triangles; grows

void gl_work_free(struct gl_work *w)
{
    struct gl_buffer *all[] = {&w->frame,      &w->counters, &w->views,        &w->starts,
                               &w->counts,     &w->large,    &w->pixel_counts, &w->offsets,
                               &w->states,     &w->output,   &w->span_counts,  &w->pending[0],
                               &w->pending[1], &w->misses,   &w->claims,       &w->fragments,
                               &w->sums[0],    &w->sums[1],  &w->sums[2],      &w->bins};
    for (size_t i = 0; i < array_count(all); i++)
        gl_buffer_free(all[i]);
    gl_readback_free(&w->readback);
    gl_timers_free(&w->timers);
}

static size_t pixels_of(const struct frame_data *f)
{
    return (size_t)f->columns * (size_t)f->rows;
}

static void trim(struct gl_buffer *b, size_t most)
{
    if (b->size > most)
        gl_buffer_free(b);
}

// Room for a number that grows from frame to frame: more than asked for, but no more than planned.
static size_t with_reserve(size_t needed, size_t most)
{
    size_t more = needed + needed / 4;
    return more < most ? more : needed > most ? needed : most;
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
    trim(&w->pixel_counts, (pixels + 1) * 4);
    trim(&w->offsets, (pixels + 1) * 4);
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
    size_t leaves = scene->leaf_count, pixels = pixels_of(f);
    return gl_buffer_grow(&w->frame, m, "frame", sizeof *f, err) &&
           gl_buffer_grow(&w->counters, m, "counters", sizeof(struct counters), err) &&
           gl_buffer_grow(&w->bins, m, "bins", BINS * 4, err) &&
           gl_buffer_grow(&w->views, model, "views", leaves * sizeof(struct leaf_view), err) &&
           gl_buffer_grow(&w->starts, model, "starts", (leaves + 1) * 4, err) &&
           gl_buffer_grow(&w->counts, model, "counts", (leaves + 1) * 4, err) &&
           gl_work_pieces(w, p->pieces < LARGE_PIECES ? p->pieces : LARGE_PIECES, err) &&
           gl_buffer_grow(&w->pixel_counts, m, "pixel counts", (pixels + 1) * 4, err) &&
           gl_buffer_grow(&w->offsets, m, "offsets", (pixels + 1) * 4, err) &&
           gl_buffer_grow(&w->states, m, "states", pixels * sizeof(struct pixel_state), err) &&
           gl_buffer_grow(&w->pending[0], m, "pending", pixels * 4, err) &&
           gl_buffer_grow(&w->pending[1], m, "pending", pixels * 4, err) &&
           gl_buffer_grow(&w->misses, m, "misses", (size_t)p->miss_words * 4, err) &&
           gl_buffer_grow(&w->claims, m, "claims", (size_t)p->claims * 4, err) &&
           (spans ? gl_buffer_grow(&w->span_counts, m, "span counts", pixels * 4, err)
                  : gl_buffer_grow(&w->output, m, "output", pixels * 12, err));
}

// Writes of shaders are there for copies.
static void barrier_for_copies(void)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

bool gl_work_read(struct gl_work *w, const struct gl_part *parts, uint32_t count, struct error *err)
{
    return gl_readback_take(&w->readback, w->memory, "readback", parts, count, w->plan.staging,
                            err);
}

static bool read_one(struct gl_work *w, const struct gl_buffer *from, void *out, size_t size,
                     struct error *err)
{
    return gl_work_read(w, &(struct gl_part){from, 0, size, out}, 1, err);
}

bool gl_work_pieces(struct gl_work *w, uint32_t pieces, struct error *err)
{
    size_t most = (size_t)w->plan.pieces * 16;
    return gl_buffer_grow(&w->large, w->memory, "large", with_reserve((size_t)pieces * 16, most),
                          err);
}

static bool use(struct gl_work *w, const char *name, const char *defines, struct error *err)
{
    unsigned program = gl_program(w->programs, name, defines, err);
    if (program)
        glUseProgram(program);
    return program;
}

static void dispatch(size_t groups)
{
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint x = (GLuint)(groups < GROUPS_WIDE ? groups : GROUPS_WIDE);
    glDispatchCompute(x, (GLuint)((groups + GROUPS_WIDE - 1) / GROUPS_WIDE), 1);
}

// The same for a shader that is bound to what it needs.
static bool take(struct gl_work *w, const char *name, const char *defines, size_t groups,
                 struct error *err)
{
    bool fine = use(w, name, defines, err);
    if (fine)
        dispatch(groups);
    return fine;
}

// As many groups as the counters say.
static bool take_counted(struct gl_work *w, const char *name, const char *defines,
                         struct error *err)
{
    if (!use(w, name, defines, err))
        return false;

    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, w->counters.id);
    glDispatchComputeIndirect(offsetof(struct counters, groups));
    return true;
}

static void bind_frame(const struct gl_work *w, const struct gl_scene *scene)
{
    gl_buffer_bind(&w->frame, BIND_FRAME);
    gl_buffer_bind(&scene->leaves, BIND_LEAVES);
    gl_buffer_bind(&w->counters, BIND_COUNTERS);
}

bool gl_work_views(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                   struct error *err)
{
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    bind_frame(w, scene);
    gl_buffer_bind(&w->views, BIND_VIEWS);
    gl_timer_begin(&w->timers, "views");
    bool fine = take(w, "leaf_view", "", (scene->leaf_count + GROUP_SIZE - 1) / GROUP_SIZE, err);
    gl_timer_end(&w->timers);
    return fine;
}

enum { SCAN_LEVELS = 3 }; // 2^30 numbers

static bool scan_levels(struct gl_work *w, const struct gl_buffer *from, const struct gl_buffer *to,
                        size_t n, struct error *err)
{
    size_t count[SCAN_LEVELS + 1] = {n};
    const struct gl_buffer *level[SCAN_LEVELS + 1] = {to};
    uint32_t levels = 0;
    do {
        count[levels + 1] = (count[levels] + SCAN_BLOCK - 1) / SCAN_BLOCK;
        level[levels + 1] = &w->sums[levels];
        if (!gl_buffer_grow(&w->sums[levels], w->memory, "sums", count[levels + 1] * 4, err))
            return false;
    } while (count[++levels] > 1);
    for (uint32_t i = 0; i < levels; i++) {
        gl_buffer_bind_part(from, BIND_SCAN_IN, 0, n * 4);
        gl_buffer_bind_part(level[i], BIND_SCAN_OUT, 0, count[i] * 4);
        gl_buffer_bind_part(level[i + 1], BIND_SCAN_SUMS, 0, count[i + 1] * 4);
        if (!take(w, "scan", i ? "IN_PLACE" : "SCAN", count[i + 1], err))
            return false;
    }
    for (uint32_t i = levels - 1; i-- > 0;) {
        gl_buffer_bind_part(level[i], BIND_SCAN_OUT, 0, count[i] * 4);
        gl_buffer_bind_part(level[i + 1], BIND_SCAN_SUMS, 0, count[i + 1] * 4);
        if (!take(w, "scan", "ADD", count[i + 1], err))
            return false;
    }
    return true;
}

// to[i] = the sum of from[0 .. i) for n numbers.
static bool scan(struct gl_work *w, const struct gl_buffer *from, const struct gl_buffer *to,
                 size_t n, struct error *err)
{
    gl_timer_begin(&w->timers, "scan");
    bool fine = scan_levels(w, from, to, n, err);
    gl_timer_end(&w->timers);
    return fine;
}

static void bind_triangles(const struct gl_work *w, const struct gl_scene *scene,
                           const struct gl_buffer *counts)
{
    bind_frame(w, scene);
    gl_buffer_bind(&w->views, BIND_VIEWS);
    gl_buffer_bind(&scene->solids->vertices, BIND_VERTICES);
    gl_buffer_bind(&scene->solids->triangles, BIND_TRIANGLES);
    gl_buffer_bind(&scene->solids->planes, BIND_PLANES);
    gl_buffer_bind(&w->starts, BIND_STARTS);
    gl_buffer_bind(&w->large, BIND_LARGE);
    gl_buffer_bind(counts, BIND_COUNTS);
    gl_buffer_bind(&w->offsets, BIND_OFFSETS);
    gl_buffer_bind(&w->fragments, BIND_FRAGMENTS);
    gl_buffer_bind(&w->states, BIND_STATES);
}

// Takes all triangles, then all pieces of large ones; `define` says what for.
static bool draw(struct gl_work *w, const struct gl_scene *scene, const struct gl_buffer *counts,
                 const char *pass, const char *define, const char *define_pieces, struct error *err)
{
    bind_triangles(w, scene, counts);
    gl_timer_begin(&w->timers, pass);
    bool fine = take(w, "arguments", "TRIANGLES", 1, err) &&
                take_counted(w, "fragments", define, err) && take(w, "arguments", "", 1, err) &&
                take_counted(w, "fragments", define_pieces, err);
    gl_timer_end(&w->timers);
    return fine;
}

static bool select_leaves(struct gl_work *w, const struct gl_scene *scene, struct error *err)
{
    bind_frame(w, scene);
    gl_buffer_bind(&w->views, BIND_VIEWS);
    gl_buffer_bind(&w->counts, BIND_COUNTS);
    gl_timer_begin(&w->timers, "select");
    bool fine = take(w, "select", "", scene->leaf_count / GROUP_SIZE + 1, err);
    gl_timer_end(&w->timers);
    return fine && scan(w, &w->counts, &w->starts, (size_t)scene->leaf_count + 1, err);
}

bool gl_work_count(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                   uint32_t *fragments, uint32_t *pieces, struct error *err)
{
    size_t pixels = pixels_of(f);
    static const uint32_t none;
    f->large_most = (uint32_t)(w->large.size / 16);
    f->windings = scene->windings;
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    if (!select_leaves(w, scene, err))
        return false;
    gl_buffer_write(&w->counters, offsetof(struct counters, large), &none, 4);
    gl_buffer_write(&w->counters, offsetof(struct counters, wrapped), &none, 4);
    gl_buffer_fill(&w->pixel_counts, 0, (pixels + 1) * 4, 0);
    // A buffer of any size: nothing is written to it.
    if (!gl_buffer_grow(&w->fragments, w->memory, "fragments", sizeof(struct fragment), err) ||
        !draw(w, scene, &w->pixel_counts, "count", "COUNT", "COUNT PIECES", err) ||
        !scan(w, &w->pixel_counts, &w->offsets, pixels + 1, err))
        return false;
    barrier_for_copies();
    gl_buffer_copy(&w->offsets, pixels * 4, &w->counters, offsetof(struct counters, fragments), 4);
    struct counters c;
    if (!read_one(w, &w->counters, &c, sizeof c, err))
        return false;
    *fragments = c.fragments;
    *pieces = c.wrapped ? UINT32_MAX : c.large;
    return true;
}

bool gl_work_histogram(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                       float from, float to, uint32_t bins[BINS], struct error *err)
{
    f->bins_from = from;
    f->bins_each = (float)(BINS / ((double)to - (double)from));
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    gl_buffer_fill(&w->bins, 0, BINS * 4, 0);
    return draw(w, scene, &w->bins, "histogram", "HISTOGRAM", "HISTOGRAM PIECES", err) &&
           read_one(w, &w->bins, bins, BINS * 4, err);
}

bool gl_work_scatter(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                     uint32_t fragments, bool spans, struct error *err)
{
    size_t room = with_reserve(fragments, w->plan.fragments);
    w->crossings = fragments;
    size_t places = room / 2 + pixels_of(f); // a ray of n crossings has n / 2 + 1 at most
    if (spans &&
        !gl_buffer_grow(&w->output, w->memory, "output", places * sizeof(struct span_data), err))
        return false;
    return gl_buffer_grow(&w->fragments, w->memory, "fragments", room * sizeof(struct fragment),
                          err) &&
           draw(w, scene, &w->pixel_counts, "scatter", "SCATTER", "SCATTER PIECES", err);
}

static void bind_walk(const struct gl_work *w, const struct gl_scene *scene,
                      const struct gl_table *table, bool spans)
{
    bind_frame(w, scene);
    gl_buffer_bind(&scene->values, BIND_VALUES);
    gl_buffer_bind(&scene->solids->planes, BIND_PLANES);
    gl_buffer_bind(&scene->solids->faces, BIND_FACES);
    gl_buffer_bind(&w->offsets, BIND_OFFSETS);
    gl_buffer_bind(&w->fragments, BIND_FRAGMENTS);
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
    char defines[sizeof w->array->defines + 32];
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    gl_buffer_write(&w->counters, offsetof(struct counters, missed), none, sizeof none);
    gl_buffer_fill(&w->claims, 0, (size_t)w->plan.claims * 4, 0);
    bind_walk(w, scene, table, spans);
    snprintf(defines, sizeof defines, "%s %s", spans ? "SPANS" : "SURFACE",
             w->array ? w->array->defines : how);
    gl_timer_begin(&w->timers, f->pending ? "rewalk" : "resolve");
    bool fine = take(w, "resolve", defines,
                     ((f->pending ? f->pending : pixels_of(f)) + GROUP_SIZE - 1) / GROUP_SIZE, err);
    gl_timer_end(&w->timers);
    if (!fine)
        return false;
    return read_one(w, &w->counters, c, sizeof *c, err);
}

// Evaluates what a round of walks has put on record; *found: how much of it is new.
static bool learn(struct gl_work *w, const struct body *body, const struct counters *c,
                  uint32_t *found, struct error *err)
{
    size_t words = c->misses < w->plan.miss_words ? c->misses : w->plan.miss_words;
    uint32_t *records = mem_alloc((words + 1) * sizeof *records);
    bool fine = read_one(w, &w->misses, records, words * 4, err);
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
    bool fine = take(w, "reduce", "", squares, err);
    gl_timer_end(&w->timers);
    f->pending = squares;
    f->ahead = AHEAD_FRAMES + 1;
    if (!fine || !walk(w, scene, f, table, spans, "", &recorded, err))
        return false;
    size_t words = recorded.misses < w->plan.miss_words ? recorded.misses : w->plan.miss_words;
    if (!read_one(w, &w->misses, gl_learner_room(w->learner, words), words * 4, err))
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
