// curves.c - times of transparent frames by the side of the picture: Figure 6 of the HCSG paper.
// paper.
#include "curves.h"

#include "stage.h"
#include "turn.h"

enum { SIDE_LEAST = 256, SIDE_MOST = 8192, FRAMES = 3 };

static const struct way {
    const char *name;
    enum walk walk;
    uint32_t slabs;
} ways_gl[] = {{"gl1", WALK_AUTO, 1}, {"gl2", WALK_AUTO, 2}, {"gl3", WALK_AUTO, 3},
               {"gl4", WALK_AUTO, 4}, {"gl5", WALK_AUTO, 5}, {"glarray", WALK_ARRAY, 1}},
  way_cpu = {"cpu", WALK_AUTO, 0};

static double frame_ms(struct stage *s, struct device *device, uint32_t view)
{
    struct rays rays = turn_view(s->model.bounds, view, (int)s->size);
    struct render_stats stats;
    uint64_t intervals;
    return stage_spans(s, device, &rays, &stats, &intervals);
}

static void follow(FILE *tsv, const char *scene, struct stage *s, struct device *device,
                   const struct way *way, double limit)
{
    double ms = 0;
    s->settings.walk = way->walk;
    s->settings.slabs = way->slabs;
    for (s->size = SIDE_LEAST; s->size <= SIDE_MOST && ms < limit * 1e3; s->size *= 2) {
        struct samples frames = {0};
        ms = frame_ms(s, device, 0); // compiles, finds combinations
        for (uint32_t i = 0; i < FRAMES && (i == 0 || ms < limit * 1e3); i++)
            samples_add(&frames, ms = frame_ms(s, device, i));
        fprintf(tsv, "%s\tcurve_%s_%u_ms\t%.6g\t%.6g\t%u\n", scene, way->name, s->size,
                samples_median(&frames), samples_least(&frames), frames.count);
        fflush(tsv);
        samples_free(&frames);
    }
}

static bool follow_gl(FILE *tsv, const char *scene, struct stage *s,
                      const struct measure_options *options, struct error *err)
{
    struct device *device = options->gl == DEVICE_CPU ? NULL : device_choose(options->gl, err);
    bool ok = device || options->gl == DEVICE_CPU;
    for (size_t i = 0; device && device->description[0] && i < sizeof ways_gl / sizeof *ways_gl;
         i++)
        follow(tsv, scene, s, device, &ways_gl[i], options->limit);
    ok = ok && !(device && device_failed(device, err));
    device_delete(device);
    return ok;
}

bool curves_measure(FILE *tsv, const char *scene, const char *csg,
                    const struct measure_options *options, struct error *err)
{
    struct stage s = {.unshared = options->unshared};
    struct samples parse = {0}, build = {0};
    bool ok = stage_load(&s, csg, &parse, &build, err);
    if (ok) {
        struct device *cpu = cpu_device_new();
        s.settings = (struct render_settings){.epsilon = model_epsilon(&s.model, -1),
                                              .threads = options->threads,
                                              .memory = (size_t)MEMORY_BUDGET << 20};
        follow(tsv, scene, &s, cpu, &way_cpu, options->limit);
        device_delete(cpu);
        ok = follow_gl(tsv, scene, &s, options, err);
    }
    samples_free(&parse);
    samples_free(&build);
    stage_free(&s);
    return ok;
}
