// measure.c - our own times on one scene.
#include "measure.h"

#include "base/clock.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "csg/csg.h"
#include "io/write_png.h"
#include "render/picture.h"
#include "turn.h"

#include <stdlib.h>

enum {
    LOADS = 5,          // times that a file is read and built
    ARRAY_LEAVES = 1000 // with more, a frame of the array method takes minutes
};
#define LOAD_LIMIT 1.5 // seconds for each of reading and building

// One scene, ready to draw.
struct stage {
    const struct measure_options *options;
    struct result *result;
    struct model model;
    struct device *device;
    struct shader shader;
    struct picture picture;
    struct render_settings settings;
};

static bool load(struct stage *s, const char *csg, struct error *err)
{
    struct result *r = s->result;
    struct messages messages = {0};
    struct csg_tree tree = {0};
    bool ok = true;
    for (double spent = 0; ok && r->parse.count < LOADS && spent < LOAD_LIMIT;) {
        csg_free(&tree);
        double start = clock_seconds();
        ok = csg_parse_file(&tree, csg, &messages);
        samples_add(&r->parse, (clock_seconds() - start) * 1e3);
        spent += clock_seconds() - start;
    }
    for (double spent = 0; ok && r->build.count < LOADS && spent < LOAD_LIMIT;) {
        struct messages warnings = {0};
        model_free(&s->model);
        double start = clock_seconds();
        struct solid_store *store = solid_store_new();
        model_build(&s->model, &tree, store, &MODEL_DEFAULTS, &warnings);
        samples_add(&r->build, (clock_seconds() - start) * 1e3);
        spent += clock_seconds() - start;
        solid_store_delete(store);
        if (r->build.count == 1)
            messages_print(&warnings, stderr);
        messages_free(&warnings);
    }
    if (!ok)
        error_set(err, "%s", messages.count ? messages.items[0].text : "cannot read the scene");
    messages_free(&messages);
    csg_free(&tree);
    return ok;
}

static void note_peak(struct stage *s, const struct render_stats *stats)
{
    if (stats->peak_bytes > s->result->peak_bytes)
        s->result->peak_bytes = stats->peak_bytes;
}

// Draws a view to RGB; returns ms.
static double draw(struct stage *s, uint32_t view, struct render_stats *stats)
{
    struct rays rays = turn_view(s->model.bounds, view, (int)s->options->size);
    *stats = (struct render_stats){0};
    double start = clock_seconds();
    picture_draw(&s->picture, s->device, &s->shader, &rays, &s->settings, stats);
    double ms = (clock_seconds() - start) * 1e3;
    note_peak(s, stats);
    return ms;
}

static void forget(struct stage *s)
{
    for (uint32_t i = 0; i < s->model.body_count; i++)
        discovery_clear(s->model.bodies[i].table);
}

// Nanoseconds that a core spends on a fragment.
static double per_fragment(const struct stage *s, double ms, double fragments)
{
    return fragments > 0 ? ms * 1e6 * s->result->threads / fragments : 0;
}

static double share_covered(const struct stage *s)
{
    size_t pixels = (size_t)s->options->size * s->options->size, covered = 0;
    for (size_t i = 0; i < pixels; i++)
        covered += s->picture.depth[i] < INFINITY;
    return (double)covered / (double)pixels;
}

static void measure_turn(struct stage *s)
{
    struct result *r = s->result;
    struct render_stats stats;
    double spent = 0;
    for (uint32_t i = 0; i < s->options->frames && (i == 0 || spent < s->options->limit); i++) {
        double ms = draw(s, i, &stats);
        spent += ms / 1e3;
        samples_add(&r->picture, ms);
        samples_add(&r->setup, stats.seconds_setup * 1e3);
        samples_add(&r->draw, stats.seconds_draw * 1e3);
        r->fragments += (double)stats.fragments;
        r->covered += share_covered(s);
    }
    r->fragments /= r->picture.count;
    r->covered /= r->picture.count;
    r->nanoseconds = per_fragment(s, samples_median(&r->draw), r->fragments);
}

struct count { // per worker, on cache lines of their own
    uint64_t intervals;
    double length;
    char apart[112];
};

static void count_spans(void *context, uint32_t worker, const struct span_block *block)
{
    struct count *c = (struct count *)context + worker;
    size_t rays = (size_t)(block->x1 - block->x0) * (size_t)(block->y1 - block->y0);
    c->intervals += block->first[rays] - block->first[0];
    for (uint32_t i = block->first[0]; i < block->first[rays]; i++)
        c->length += (double)(block->spans[i].leave - block->spans[i].enter);
}

// All intervals of a view, counted; returns ms.
static double draw_spans(struct stage *s, uint32_t view, struct render_stats *sum,
                         uint64_t *intervals)
{
    struct rays rays = turn_view(s->model.bounds, view, (int)s->options->size);
    uint32_t workers = parallel_workers(s->settings.threads);
    struct count *counts = mem_zalloc(workers * sizeof *counts);
    *sum = (struct render_stats){0};
    double start = clock_seconds();
    for (uint32_t i = 0; i < s->model.body_count; i++) {
        struct render_stats stats = {0};
        device_spans(s->device, &s->model.bodies[i], &rays, &s->settings, count_spans, counts,
                     &stats);
        sum->fragments += stats.fragments;
        sum->misses += stats.misses;
        sum->seconds_draw += stats.seconds_draw;
        note_peak(s, &stats);
    }
    double ms = (clock_seconds() - start) * 1e3;
    *intervals = 0;
    for (uint32_t i = 0; i < workers; i++)
        *intervals += counts[i].intervals;
    free(counts);
    return ms;
}

static void measure_spans(struct stage *s)
{
    struct result *r = s->result;
    struct render_stats stats;
    struct samples inside = {0};
    uint64_t intervals;
    double spent = 0;
    for (uint32_t i = 0; i < s->options->frames && (i == 0 || spent < s->options->limit); i++) {
        double ms = draw_spans(s, i, &stats, &intervals);
        spent += ms / 1e3;
        samples_add(&r->spans, ms);
        samples_add(&inside, stats.seconds_draw * 1e3);
        r->span_fragments += (double)stats.fragments;
        r->intervals += (double)intervals;
    }
    r->span_fragments /= r->spans.count;
    r->intervals /= r->spans.count;
    r->span_nanoseconds = per_fragment(s, samples_median(&inside), r->span_fragments);
    samples_free(&inside);
    for (uint32_t i = 0; i < s->model.body_count; i++) {
        struct discovery_stats t = discovery_stats(s->model.bodies[i].table);
        if (t.combinations >= r->table.combinations)
            r->table = t;
    }
}

// Pairs of frames of one view, so that whatever slows the machine down slows both.
static void measure_empty(struct stage *s)
{
    struct result *r = s->result;
    struct render_stats stats;
    uint64_t intervals;
    double spent = 0;
    for (uint32_t i = 0; i < s->options->frames && (i == 0 || spent < s->options->limit); i++) {
        forget(s);
        double empty = draw(s, i, &stats), filled = draw(s, i, &stats);
        samples_add(&r->picture_extra, empty / filled - 1);
        spent += (empty + filled) / 1e3;
        forget(s);
        empty = draw_spans(s, i, &stats, &intervals);
        r->misses += (double)stats.misses;
        filled = draw_spans(s, i, &stats, &intervals);
        samples_add(&r->spans_extra, empty / filled - 1);
        spent += (empty + filled) / 1e3;
    }
    r->misses /= r->spans_extra.count;
}

static void measure_walk(struct stage *s, int which, enum walk walk)
{
    struct result *r = s->result;
    struct render_stats stats;
    uint64_t intervals;
    s->settings.walk = walk;
    double spent = 0;
    for (uint32_t i = 0; i < TURN_VIEWS && (i == 0 || spent < s->options->limit); i++) {
        double ms = draw(s, i, &stats);
        samples_add(&r->walk_picture[which], ms);
        spent += ms / 1e3;
    }
    spent = 0;
    for (uint32_t i = 0; i < TURN_VIEWS && (i == 0 || spent < s->options->limit); i++) {
        double ms = draw_spans(s, i, &stats, &intervals);
        samples_add(&r->walk_spans[which], ms);
        spent += ms / 1e3;
    }
    s->settings.walk = WALK_AUTO;
}

static bool write_picture(const struct stage *s, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s-hcsg.png", s->options->pictures, s->result->scene->name);
    return write_png(path, s->picture.rgb, s->picture.width, s->picture.height, err);
}

static void describe(struct result *r, const struct model *m)
{
    r->triangles = m->stats.triangles;
    for (uint32_t i = 0; i < m->body_count; i++) {
        r->leaves += m->bodies[i].leaf_count;
        r->classes += m->bodies[i].sharing.class_count;
    }
}

bool measure_scene(struct result *out, const char *csg, const struct measure_options *options,
                   struct error *err)
{
    bool ok = true;
    struct stage s = {.options = options, .result = out};
    if (!load(&s, csg, err)) {
        model_free(&s.model);
        return false;
    }
    out->threads = parallel_workers(options->threads);
    out->size = options->size;
    describe(out, &s.model);
    s.settings = (struct render_settings){.epsilon = model_epsilon(&s.model, -1),
                                          .threads = options->threads,
                                          .memory = (size_t)MEMORY_BUDGET << 20};
    s.device = cpu_device_new();
    shader_init(&s.shader, &s.model, scheme_list(&(uint32_t){0}));

    struct render_stats stats;
    out->cold = draw(&s, 0, &stats);
    if (options->pictures)
        ok = write_picture(&s, err);
    if (ok) {
        measure_turn(&s);
        measure_spans(&s);
        measure_empty(&s);
        measure_walk(&s, WALK_BY_HASH, WALK_HASH);
        if (out->leaves <= ARRAY_LEAVES)
            measure_walk(&s, WALK_BY_ARRAY, WALK_ARRAY);
    }
    picture_free(&s.picture);
    shader_free(&s.shader);
    device_delete(s.device);
    model_free(&s.model);
    return ok;
}
