// stage.c - a scene that is ready to be drawn, and frames of it.
#include "stage.h"

#include "base/clock.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "csg/csg.h"
#include "turn.h"

#include <stdlib.h>

enum { LOADS = 5 };    // times that a file is read and built
#define LOAD_LIMIT 1.5 // seconds for each of reading and building

bool stage_load(struct stage *s, const char *csg, struct samples *parse, struct samples *build,
                struct error *err)
{
    struct messages messages = {0};
    struct csg_tree tree = {0};
    struct model_options how = MODEL_DEFAULTS;
    how.share = !s->unshared;
    bool ok = true;
    for (double spent = 0; ok && parse->count < LOADS && spent < LOAD_LIMIT;) {
        csg_free(&tree);
        double start = clock_seconds();
        ok = csg_parse_file(&tree, csg, &messages);
        samples_add(parse, (clock_seconds() - start) * 1e3);
        spent += clock_seconds() - start;
    }
    for (double spent = 0; ok && build->count < LOADS && spent < LOAD_LIMIT;) {
        struct messages warnings = {0};
        model_free(&s->model);
        double start = clock_seconds();
        struct solid_store *store = solid_store_new();
        model_build(&s->model, &tree, store, &how, &warnings);
        samples_add(build, (clock_seconds() - start) * 1e3);
        spent += clock_seconds() - start;
        solid_store_delete(store);
        if (build->count == 1)
            messages_print(&warnings, stderr);
        messages_free(&warnings);
    }
    if (ok)
        shader_init(&s->shader, &s->model, scheme_list(&(uint32_t){0}));
    else
        error_set(err, "%s", messages.count ? messages.items[0].text : "cannot read the scene");
    messages_free(&messages);
    csg_free(&tree);
    return ok;
}

void stage_free(struct stage *s)
{
    picture_free(&s->picture);
    shader_free(&s->shader);
    model_free(&s->model);
    *s = (struct stage){0};
}

static void note_peak(struct stage *s, const struct render_stats *stats)
{
    if (stats->peak_bytes > s->peak_bytes)
        s->peak_bytes = stats->peak_bytes;
    if (stats->model_bytes > s->model_bytes)
        s->model_bytes = stats->model_bytes;
}

double stage_draw(struct stage *s, struct device *device, uint32_t view, struct render_stats *stats)
{
    struct rays rays = turn_view(s->model.bounds, view, (int)s->size);
    *stats = (struct render_stats){0};
    double start = clock_seconds();
    picture_draw(&s->picture, device, &s->shader, &rays, &s->settings, stats);
    double ms = (clock_seconds() - start) * 1e3;
    note_peak(s, stats);
    return ms;
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

double stage_spans(struct stage *s, struct device *device, const struct rays *rays,
                   struct render_stats *stats, uint64_t *intervals)
{
    uint32_t workers = parallel_workers(s->settings.threads);
    struct count *counts = mem_zalloc(workers * sizeof *counts);
    *stats = (struct render_stats){0};
    double start = clock_seconds();
    for (uint32_t i = 0; i < s->model.body_count; i++) {
        struct render_stats one = {0};
        device_spans(device, &s->model.bodies[i], rays, &s->settings, count_spans, counts, &one);
        render_stats_add(stats, &one);
    }
    double ms = (clock_seconds() - start) * 1e3;
    note_peak(s, stats);
    *intervals = 0;
    for (uint32_t i = 0; i < workers; i++)
        *intervals += counts[i].intervals;
    free(counts);
    return ms;
}

void stage_forget(struct stage *s)
{
    for (uint32_t i = 0; i < s->model.body_count; i++)
        discovery_clear(s->model.bodies[i].table);
}
