// curves.c - how times follow one thing: the side of the picture, the number of primary values.
#include "curves.h"

#include "base/mem.h"
#include "opponent.h"
#include "stage.h"
#include "turn.h"

enum { SIDE_LEAST = 256, SIDE_MOST = 8192, FRAMES = 3 };

struct way {
    const char *name;
    bool gl, opaque;
    enum walk walk;
    uint32_t slabs;
};

// Of all intervals, unless opaque. The numbers of slabs are those of the paper.
static const struct way by_side[] = {
    {"transparent_cpu", false, false, WALK_AUTO, 0},
    {"transparent_gl1", true, false, WALK_AUTO, 1},
    {"transparent_gl2", true, false, WALK_AUTO, 2},
    {"transparent_gl3", true, false, WALK_AUTO, 3},
    {"transparent_gl4", true, false, WALK_AUTO, 4},
    {"transparent_gl5", true, false, WALK_AUTO, 5},
    {"transparent_glarray", true, false, WALK_ARRAY, 1},
    {"opaque_cpu", false, true, WALK_AUTO, 0},
    {"opaque_gl1", true, true, WALK_AUTO, 1},
    {"opaque_gl3", true, true, WALK_AUTO, 3},
};
static const struct way by_values[] = {
    {"cpu", false, false, WALK_HASH, 0},
    {"cpuarray", false, false, WALK_ARRAY, 0},
    {"gl", true, false, WALK_HASH, 0},
    {"glarray", true, false, WALK_ARRAY, 0},
};

// A scene, how it is measured, and where the figures go.
struct course {
    FILE *tsv;
    const char *scene;
    struct stage stage;
    const struct measure_options *options;
};

static bool course_begin(struct course *c, const char *csg, bool unshared, struct error *err)
{
    struct samples parse = {0}, build = {0};
    c->stage = (struct stage){.size = c->options->size, .unshared = unshared};
    bool ok = stage_load(&c->stage, csg, &parse, &build, err);
    c->stage.settings = (struct render_settings){.epsilon = model_epsilon(&c->stage.model, -1),
                                                 .threads = c->options->threads,
                                                 .memory = (size_t)MEMORY_BUDGET << 20};
    samples_free(&parse);
    samples_free(&build);
    return ok;
}

static void value(const struct course *c, const char *metric, double v)
{
    fprintf(c->tsv, "%s\t%s\t%.6g\t%.6g\t1\n", c->scene, metric, v, v);
}

static void row(const struct course *c, const char *metric, const struct samples *frames)
{
    fprintf(c->tsv, "%s\t%s\t%.6g\t%.6g\t%u\n", c->scene, metric, samples_median(frames),
            samples_least(frames), frames->count);
    fflush(c->tsv);
}

// *out is NULL where the way's device is not to be measured. A device of its own for each way: what
// fails on one way works on the next.
static bool device_for(const struct course *c, const struct way *way, struct device **out,
                       struct error *err)
{
    *out = NULL;
    if (!way->gl)
        *out = cpu_device_new();
    else if (c->options->gl != DEVICE_CPU && !(*out = device_choose(c->options->gl, NULL, err)))
        return false;
    if (way->gl && *out && !(*out)->description[0]) {
        device_delete(*out);
        *out = NULL;
    }
    return true;
}

static double frame_ms(struct course *c, const struct way *way, struct device *device,
                       uint32_t view, struct render_stats *stats)
{
    struct stage *s = &c->stage;
    struct rays rays = turn_view(s->model.bounds, view, (int)s->size);
    uint64_t intervals;
    s->settings.walk = way->walk;
    s->settings.slabs = way->slabs;
    return way->opaque ? stage_draw(s, device, view, stats)
                       : stage_spans(s, device, &rays, stats, &intervals);
}

// Frames that follow one which may compile shaders and find combinations; false when the device
// failed. *stats: of the last.
static bool steady(struct course *c, const struct way *way, struct device *device,
                   struct samples *frames, struct render_stats *stats)
{
    struct error why;
    double limit = c->options->limit * 1e3, ms = frame_ms(c, way, device, 0, stats);
    for (uint32_t i = 0; i < FRAMES && (i == 0 || ms < limit); i++)
        samples_add(frames, ms = frame_ms(c, way, device, 0, stats));
    if (!device_failed(device, &why))
        return true;
    fprintf(stderr, "%s: %s, %u pixels a side: %s\n", c->scene, way->name, c->stage.size, why.text);
    return false;
}

static bool follow_sides(struct course *c, const struct way *way, struct error *err)
{
    struct device *device;
    bool going = true;
    if (!device_for(c, way, &device, err))
        return false;
    for (uint32_t side = SIDE_LEAST; device && going && side <= SIDE_MOST; side *= 2) {
        struct samples frames = {0};
        struct render_stats stats;
        char metric[64];
        c->stage.size = side;
        snprintf(metric, sizeof metric, "curve_%s_%u_ms", way->name, side);
        going = steady(c, way, device, &frames, &stats);
        if (going)
            row(c, metric, &frames);
        going = going && samples_median(&frames) < c->options->limit * 1e3;
        samples_free(&frames);
    }
    device_delete(device);
    return true;
}

static bool follow_opencsg(const struct course *c, const struct scene *scene, const char *csg,
                           const char *program, struct error *err)
{
    bool ok = true, going = program && scene->at_least > 0;
    for (uint32_t side = SIDE_LEAST; ok && going && side <= SIDE_MOST; side *= 2) {
        struct result r = {.scene = scene};
        struct opponent_options how = {.program = program,
                                       .size = side,
                                       .threads = c->options->threads,
                                       .limit = c->options->limit};
        const struct opencsg_result *opencsg = &r.opencsg[OPENCSG_BOXES];
        char metric[64];
        snprintf(metric, sizeof metric, "curve_opaque_opencsg_%u_ms", side);
        ok = opponent_measure_setting(&r, OPENCSG_BOXES, csg, &how, err);
        if (ok && opencsg->frames.count)
            row(c, metric, &opencsg->frames);
        going = opencsg->frames.count && samples_median(&opencsg->frames) < c->options->limit * 1e3;
        result_free(&r);
    }
    return ok;
}

bool curves_by_side(FILE *tsv, const struct scene *scene, const char *csg,
                    const struct curves_options *options, struct error *err)
{
    struct course c = {.tsv = tsv, .scene = scene->name, .options = &options->ours};
    bool ok = course_begin(&c, csg, options->ours.unshared, err);
    for (size_t i = 0; ok && i < array_count(by_side); i++)
        ok = follow_sides(&c, &by_side[i], err);
    ok = ok && follow_opencsg(&c, scene, csg, options->opencsg, err);
    stage_free(&c.stage);
    return ok;
}

static void describe(const struct course *c, const char *how, const struct render_stats *stats)
{
    double values = 0, combinations = 0;
    char metric[64];
    for (uint32_t i = 0; i < c->stage.model.body_count; i++) {
        const struct body *body = &c->stage.model.bodies[i];
        values += body->sharing.class_count;
        combinations += discovery_stats(body->table).combinations;
    }
    snprintf(metric, sizeof metric, "values_%s_count", how);
    value(c, metric, values);
    snprintf(metric, sizeof metric, "values_%s_crossings", how);
    value(c, metric, (double)stats->fragments);
    snprintf(metric, sizeof metric, "values_%s_combinations", how);
    value(c, metric, combinations);
}

static bool compare_walks(struct course *c, const char *how, struct error *err)
{
    for (size_t i = 0; i < array_count(by_values); i++) {
        struct samples frames = {0};
        struct render_stats stats;
        struct device *device;
        char metric[64];
        if (!device_for(c, &by_values[i], &device, err))
            return false;
        snprintf(metric, sizeof metric, "values_%s_%s_ms", how, by_values[i].name);
        if (device && steady(c, &by_values[i], device, &frames, &stats))
            row(c, metric, &frames);
        if (i == 0)
            describe(c, how, &stats);
        device_delete(device);
        samples_free(&frames);
    }
    return true;
}

bool curves_by_values(FILE *tsv, const char *scene, const char *csg,
                      const struct measure_options *options, struct error *err)
{
    bool ok = true;
    for (int unshared = 0; ok && unshared < 2; unshared++) {
        struct course c = {.tsv = tsv, .scene = scene, .options = options};
        ok = course_begin(&c, csg, unshared, err) &&
             compare_walks(&c, unshared ? "unshared" : "shared", err);
        stage_free(&c.stage);
    }
    return ok;
}
