// measure.c - our own times on one scene.
#include "measure.h"

#include "base/parallel.h"
#include "edits.h"
#include "io/write_png.h"
#include "stage.h"
#include "turn.h"

// With more, a frame of the array method takes minutes: values, and with OpenGL values times the ms
// of a frame by the hash.
enum { ARRAY_VALUES = 1000, GL_ARRAY_EFFORT = 300000 };

// What is being measured.
struct run {
    const struct measure_options *options;
    struct result *result;
    struct stage stage;
    struct device *device;
};

static double draw(struct run *s, uint32_t view, struct render_stats *stats)
{
    return stage_draw(&s->stage, s->device, view, stats);
}

static double draw_spans(struct run *s, uint32_t view, struct render_stats *stats,
                         uint64_t *intervals)
{
    struct rays rays = turn_view(s->stage.model.bounds, view, (int)s->stage.size);
    return stage_spans(&s->stage, s->device, &rays, stats, intervals);
}

// Nanoseconds that a core spends on a fragment.
static double per_fragment(const struct run *s, double ms, double fragments)
{
    return fragments > 0 ? ms * 1e6 * s->result->threads / fragments : 0;
}

static double share_covered(const struct run *s)
{
    size_t pixels = (size_t)s->options->size * s->options->size, covered = 0;
    for (size_t i = 0; i < pixels; i++)
        covered += s->stage.picture.depth[i] < INFINITY;
    return (double)covered / (double)pixels;
}

static void measure_turn(struct run *s)
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

static void measure_spans(struct run *s)
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
    for (uint32_t i = 0; i < s->stage.model.body_count; i++) {
        struct discovery_stats t = discovery_stats(s->stage.model.bodies[i].table);
        if (t.combinations >= r->table.combinations)
            r->table = t;
    }
}

// Pairs of frames of one view, so that whatever slows the machine down slows both.
static void measure_empty(struct run *s)
{
    struct result *r = s->result;
    struct render_stats stats;
    uint64_t intervals;
    double spent = 0;
    for (uint32_t i = 0; i < s->options->frames && (i == 0 || spent < s->options->limit); i++) {
        stage_forget(&s->stage);
        double empty = draw(s, i, &stats), filled = draw(s, i, &stats);
        samples_add(&r->picture_extra, empty / filled - 1);
        spent += (empty + filled) / 1e3;
        stage_forget(&s->stage);
        empty = draw_spans(s, i, &stats, &intervals);
        r->misses += (double)stats.misses;
        filled = draw_spans(s, i, &stats, &intervals);
        samples_add(&r->spans_extra, empty / filled - 1);
        spent += (empty + filled) / 1e3;
    }
    r->misses /= r->spans_extra.count;
}

static void measure_walk(struct run *s, int which, enum walk walk)
{
    struct result *r = s->result;
    struct render_stats stats;
    uint64_t intervals;
    s->stage.settings.walk = walk;
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
    s->stage.settings.walk = WALK_AUTO;
}

static bool write_picture(const struct run *s, const char *by, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s-%s.png", s->options->pictures, s->result->scene->name, by);
    return write_png(path, s->stage.picture.rgb, s->stage.picture.width, s->stage.picture.height,
                     err);
}

static void describe(struct result *r, const struct model *m)
{
    r->triangles = m->stats.triangles;
    for (uint32_t i = 0; i < m->body_count; i++) {
        r->leaves += m->bodies[i].leaf_count;
        r->classes += m->bodies[i].sharing.class_count;
    }
}

// What section 4.2 of the HCSG paper does before the first frame: all intervals from three sides,
// until no combination is unknown.
static void measure_batch(struct run *s, struct batch out[BATCHES])
{
    static const int sizes[BATCHES] = {BATCH_SMALL, BATCH_LARGE};
    for (int i = 0; i < BATCHES; i++) {
        stage_forget(&s->stage);
        for (uint32_t side = 0; side < 3; side++) {
            struct rays rays = turn_side(s->stage.model.bounds, side, sizes[i]);
            struct render_stats stats;
            uint64_t intervals;
            out[i].ms += stage_spans(&s->stage, s->device, &rays, &stats, &intervals);
        }
        for (uint32_t k = 0; k < s->stage.model.body_count; k++)
            out[i].combinations += discovery_stats(s->stage.model.bodies[k].table).combinations;
    }
}

// A turn of pictures or, with spans, of all intervals.
static void measure_kind(struct run *s, bool spans, struct gl_kind *out)
{
    double spent = 0;
    for (uint32_t i = 0; i < s->options->frames && (i == 0 || spent < s->options->limit); i++) {
        struct render_stats stats;
        uint64_t intervals;
        double ms = spans ? draw_spans(s, i, &stats, &intervals) : draw(s, i, &stats);
        spent += ms / 1e3;
        samples_add(&out->frames, ms);
        render_stats_add(&out->sum, &stats);
    }
}

static bool draw_with_gl(struct run *s, struct gl_result *out, struct error *err)
{
    struct render_stats stats;
    uint64_t intervals;
    s->stage.peak_bytes = s->stage.model_bytes = 0;
    stage_forget(&s->stage);
    out->cold = draw(s, 0, &stats); // uploads, and may compile
    if (s->options->pictures && !write_picture(s, "gl", err))
        return false;
    measure_kind(s, false, &out->opaque);
    draw_spans(s, 0, &stats, &intervals); // may compile
    measure_kind(s, true, &out->spans);
    measure_batch(s, out->batch);
    out->peak_bytes = s->stage.peak_bytes;
    out->model_bytes = s->stage.model_bytes;
    return true;
}

static void draw_array_with_gl(struct run *s, struct gl_result *out)
{
    struct render_stats stats;
    uint64_t intervals;
    s->stage.settings.walk = WALK_ARRAY;
    draw(s, 0, &stats); // compiles
    measure_kind(s, false, &out->array_opaque);
    draw_spans(s, 0, &stats, &intervals); // compiles
    measure_kind(s, true, &out->array_spans);
    s->stage.settings.walk = WALK_AUTO;
}

// What the processor has drawn instead is no figure.
static bool has_failed(struct run *s, const char *what, struct error *why)
{
    bool failed = device_failed(s->device, why);
    if (failed)
        fprintf(stderr, "%s, %s: %s\n", s->result->scene->name, what, why->text);
    return failed;
}

static void kind_free(struct gl_kind *k)
{
    samples_free(&k->frames);
    *k = (struct gl_kind){0};
}

// On devices of their own: what fails on one scene or way works on the next.
static bool measure_array_with_gl(struct run *s, struct error *err)
{
    struct gl_result *out = &s->result->gl;
    struct error why;
    s->device = device_choose(s->options->gl, NULL, err);
    if (!s->device)
        return false;
    draw_array_with_gl(s, out);
    if (has_failed(s, "array", &why)) {
        kind_free(&out->array_opaque);
        kind_free(&out->array_spans);
    }
    device_delete(s->device);
    return true;
}

static bool measure_gl(struct run *s, struct error *err)
{
    struct gl_result *out = &s->result->gl;
    if (s->options->gl == DEVICE_CPU)
        return true;
    s->device = device_choose(s->options->gl, NULL, err);
    if (!s->device)
        return false;
    out->measured = s->device->description[0];
    snprintf(out->device, sizeof out->device, "%.*s", (int)sizeof out->device - 1,
             out->measured ? s->device->description : err->text);
    bool ok = !out->measured || draw_with_gl(s, out, err);
    struct error why;
    if (ok && has_failed(s, "gl", &why)) {
        kind_free(&out->opaque);
        kind_free(&out->spans);
        *out = (struct gl_result){0};
        snprintf(out->device, sizeof out->device, "%.*s", (int)sizeof out->device - 1, why.text);
    }
    device_delete(s->device);
    if (ok && out->measured &&
        s->result->classes * samples_median(&out->spans.frames) < GL_ARRAY_EFFORT)
        ok = measure_array_with_gl(s, err);
    return ok;
}

bool measure_scene(struct result *out, const char *csg, const struct measure_options *options,
                   struct error *err)
{
    bool ok = true;
    struct run s = {.options = options,
                    .result = out,
                    .stage.size = options->size,
                    .stage.unshared = options->unshared};
    if (!stage_load(&s.stage, csg, &out->parse, &out->build, err)) {
        stage_free(&s.stage);
        return false;
    }
    out->threads = parallel_workers(options->threads);
    out->size = options->size;
    describe(out, &s.stage.model);
    s.stage.settings = (struct render_settings){.epsilon = model_epsilon(&s.stage.model, -1),
                                                .threads = options->threads,
                                                .memory = (size_t)MEMORY_BUDGET << 20};
    s.device = cpu_device_new();

    struct render_stats stats;
    out->cold = draw(&s, 0, &stats);
    if (options->pictures)
        ok = write_picture(&s, "hcsg", err);
    if (ok) {
        measure_turn(&s);
        measure_spans(&s);
        measure_empty(&s);
        measure_batch(&s, out->batch);
        measure_walk(&s, WALK_BY_HASH, WALK_HASH);
        if (out->classes <= ARRAY_VALUES)
            measure_walk(&s, WALK_BY_ARRAY, WALK_ARRAY);
    }
    out->peak_bytes = s.stage.peak_bytes;
    device_delete(s.device);
    ok = ok && edits_measure(out, csg, options, err) && measure_gl(&s, err);
    stage_free(&s.stage);
    return ok;
}
