// lists.c - what the two ways to list crossings take on the gl device.
#include "lists.h"

#include "stage.h"
#include "turn.h"

#include <string.h>
#include <time.h>

// Times of a frame, ms.
enum { MAKING, WALKING, BOTH, PROCESSOR, PARTS };

struct way {
    struct samples parts[PARTS];
};

static double processor_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static void draw(struct way *w, struct stage *s, struct device *device, bool spans, uint32_t view,
                 struct render_stats *stats)
{
    static const char *const making[] = {"count", "scan", "scatter", "insert"};
    double begun = processor_ms(), ms[PARTS] = {0};
    uint64_t intervals;
    struct rays rays = turn_view(s->model.bounds, view, (int)s->size);
    if (spans)
        stage_spans(s, device, &rays, stats, &intervals);
    else
        stage_draw(s, device, view, stats);
    ms[PROCESSOR] = processor_ms() - begun;
    for (int i = 0; i < RENDER_PASSES && stats->passes[i].name; i++) {
        const struct render_pass *p = &stats->passes[i];
        for (size_t k = 0; k < sizeof making / sizeof *making; k++)
            ms[MAKING] += strcmp(p->name, making[k]) == 0 ? p->seconds * 1e3 : 0;
        ms[WALKING] += strcmp(p->name, "resolve") == 0 ? p->seconds * 1e3 : 0;
    }
    ms[BOTH] = ms[MAKING] + ms[WALKING];
    for (int i = 0; i < PARTS && w; i++)
        samples_add(&w->parts[i], ms[i]);
}

// The median of what the second way takes over what the first one takes.
static double ratio_of(const struct way ways[2], int part)
{
    struct samples ratio = {0};
    for (uint32_t i = 0; i < ways[0].parts[part].count; i++)
        samples_add(&ratio, ways[1].parts[part].values[i] / ways[0].parts[part].values[i]);
    double median = samples_median(&ratio);
    samples_free(&ratio);
    return median;
}

static void measure_kind(FILE *out, const char *scene, struct stage *s, struct device *device,
                         bool spans, uint32_t frames)
{
    struct way ways[2] = {0};
    struct render_stats stats;
    double crossings = 0;
    for (uint32_t i = 0; i < frames; i++)
        for (int linked = 0; linked < 2; linked++) {
            s->settings.linked = linked;
            draw(NULL, s, device, spans, i, &stats); // compiles, finds combinations, makes room
            draw(&ways[linked], s, device, spans, i, &stats);
            crossings += (double)stats.fragments / (2 * frames);
        }
    fprintf(out, "| %s | %s | %.2f | %.1f |", scene, spans ? "all intervals" : "opaque",
            crossings / 1e6, crossings / ((double)s->size * s->size));
    for (int linked = 0; linked < 2; linked++)
        for (int i = 0; i < PARTS; i++)
            fprintf(out, " %.1f |", samples_least(&ways[linked].parts[i]));
    fprintf(out, " %.2f | %.2f |\n", ratio_of(ways, BOTH), ratio_of(ways, PROCESSOR));
    fflush(out);
    for (int i = 0; i < 2 * PARTS; i++)
        samples_free(&ways[i / PARTS].parts[i % PARTS]);
}

void lists_heading(FILE *out)
{
    fprintf(out, "| scene | | Mcrossings | per ray | counted: made | walked | both | processor | "
                 "linked: made | walked | both | processor | linked / counted | processor |\n"
                 "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
}

bool lists_measure(FILE *out, const char *scene, const char *csg,
                   const struct measure_options *options, struct error *err)
{
    struct stage s = {.size = options->size, .unshared = options->unshared};
    struct samples parse = {0}, build = {0};
    struct device *device = device_choose(options->gl, NULL, err);
    bool ok = device && device->description[0] && stage_load(&s, csg, &parse, &build, err);
    if (ok) {
        s.settings = (struct render_settings){.epsilon = model_epsilon(&s.model, -1),
                                              .threads = options->threads,
                                              .memory = (size_t)MEMORY_BUDGET << 20};
        for (int spans = 0; spans < 2; spans++)
            measure_kind(out, scene, &s, device, spans, options->frames);
        ok = !device_failed(device, err);
    }
    device_delete(device);
    samples_free(&parse);
    samples_free(&build);
    stage_free(&s);
    return ok;
}
