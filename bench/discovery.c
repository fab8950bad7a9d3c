// discovery.c - three ways to learn a scene's combinations with OpenGL, side by side.
#include "discovery.h"

#include "base/mem.h"
#include "stage.h"
#include "turn.h"

#include <stdlib.h>
#include <string.h>

struct lesson {
    struct stage stage;
    struct device *device;
    struct discovery_result *out;
    uint8_t *rgb; // of the exact picture
    float *depth;
};

static double draw(struct lesson *l, enum discovery_scheme scheme, struct render_stats *stats)
{
    l->stage.settings.discovery = scheme;
    return stage_draw(&l->stage, l->device, 0, stats);
}

static uint64_t combinations(const struct lesson *l)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < l->stage.model.body_count; i++)
        sum += discovery_stats(l->stage.model.bodies[i].table).combinations;
    return sum;
}

static void learn_at_once(struct lesson *l)
{
    struct discovery_result *out = l->out;
    struct render_stats stats;
    size_t n = (size_t)l->stage.size * l->stage.size;
    draw(l, DISCOVER_AT_ONCE, &stats); // uploads the scene, and may compile
    stage_forget(&l->stage);
    out->exact = draw(l, DISCOVER_AT_ONCE, &stats);
    out->exact_combinations = combinations(l);
    out->exact_bytes = stats.table_bytes;
    for (int i = 0; i < RENDER_PASSES && stats.passes[i].name; i++)
        if (strcmp(stats.passes[i].name, "rewalk") == 0)
            out->rounds = stats.passes[i].count;
    out->known = draw(l, DISCOVER_AT_ONCE, &stats);
    out->waits = stats.waits;
    l->rgb = mem_alloc(n * 3);
    l->depth = mem_alloc(n * sizeof *l->depth);
    memcpy(l->rgb, l->stage.picture.rgb, n * 3);
    memcpy(l->depth, l->stage.picture.depth, n * sizeof *l->depth);
}

static uint32_t wrong_pixels(const struct lesson *l)
{
    uint32_t wrong = 0;
    for (size_t i = 0; i < (size_t)l->stage.size * l->stage.size; i++)
        wrong += l->depth[i] != l->stage.picture.depth[i] ||
                 memcmp(l->rgb + 3 * i, l->stage.picture.rgb + 3 * i, 3) != 0;
    return wrong;
}

static void learn_over_frames(struct lesson *l)
{
    struct discovery_result *out = l->out;
    struct render_stats stats;
    draw(l, DISCOVER_OVER_FRAMES, &stats); // may compile
    stage_forget(&l->stage);
    for (uint32_t i = 0; i < SCHEME_FRAMES && !out->ended; i++) {
        samples_add(&out->frames, draw(l, DISCOVER_OVER_FRAMES, &stats));
        out->frames_bytes += stats.table_bytes;
        out->ended = !stats.missing;
        out->last_wrong = wrong_pixels(l);
        if (i < WRONG_SHOWN)
            out->wrong[i] = out->last_wrong;
    }
    out->frames_combinations = combinations(l);
}

static void learn_in_batch(struct lesson *l, uint32_t side, struct batch_then *out)
{
    struct render_stats stats;
    uint64_t intervals;
    l->stage.settings.discovery = DISCOVER_AT_ONCE;
    stage_forget(&l->stage);
    for (uint32_t i = 0; i < 3; i++) {
        struct rays rays = turn_side(l->stage.model.bounds, i, (int)side);
        out->ms += stage_spans(&l->stage, l->device, &rays, &stats, &intervals);
    }
    out->combinations = (uint32_t)combinations(l);
    draw(l, DISCOVER_AT_ONCE, &stats);
    out->missing = stats.misses;
}

static bool lesson_begin(struct lesson *l, const char *csg, const struct measure_options *options,
                         struct error *err)
{
    struct samples parse = {0}, build = {0};
    bool ok = stage_load(&l->stage, csg, &parse, &build, err);
    samples_free(&parse);
    samples_free(&build);
    if (!ok)
        return false;
    l->stage.settings = (struct render_settings){.epsilon = model_epsilon(&l->stage.model, -1),
                                                 .threads = options->threads,
                                                 .memory = (size_t)MEMORY_BUDGET << 20};
    l->device = device_choose(options->gl, NULL, err);
    if (l->device && !l->device->description[0]) {
        device_delete(l->device);
        l->device = NULL;
    }
    return l->device;
}

bool discovery_measure(struct discovery_result *out, const struct scene *scene, const char *csg,
                       const struct measure_options *options, struct error *err)
{
    struct lesson l = {.stage = {.size = options->size, .unshared = options->unshared}, .out = out};
    *out = (struct discovery_result){.scene = scene};
    bool ok = lesson_begin(&l, csg, options, err);
    if (ok) {
        memcpy(out->device, l.device->description, sizeof out->device);
        learn_at_once(&l);
        learn_over_frames(&l);
        learn_in_batch(&l, SCHEME_BATCH_SMALL, &out->small);
        learn_in_batch(&l, options->size, &out->large);
        ok = !device_failed(l.device, err);
        device_delete(l.device);
    }
    free(l.rgb);
    free(l.depth);
    stage_free(&l.stage);
    return ok;
}

void discovery_free(struct discovery_result *r)
{
    samples_free(&r->frames);
    *r = (struct discovery_result){0};
}

static void row(FILE *tsv, const struct discovery_result *r, const char *metric, double v)
{
    fprintf(tsv, "%s\tdiscovery_%s\t%.6g\t%.6g\t1\n", r->scene->name, metric, v, v);
}

void discovery_rows(FILE *tsv, const struct discovery_result *r)
{
    row(tsv, r, "known_ms", r->known);
    row(tsv, r, "known_waits", (double)r->waits.count);
    row(tsv, r, "known_waits_ms", r->waits.seconds * 1e3);
    row(tsv, r, "known_longest_wait_ms", r->waits.longest * 1e3);
    row(tsv, r, "exact_ms", r->exact);
    row(tsv, r, "exact_combinations", (double)r->exact_combinations);
    row(tsv, r, "exact_rounds", (double)r->rounds);
    row(tsv, r, "exact_table_bytes", (double)r->exact_bytes);
    fprintf(tsv, "%s\tdiscovery_frames_ms\t%.6g\t%.6g\t%u\n", r->scene->name,
            samples_median(&r->frames), samples_least(&r->frames), r->frames.count);
    row(tsv, r, "frames_ended", r->ended);
    row(tsv, r, "frames_combinations", (double)r->frames_combinations);
    row(tsv, r, "frames_table_bytes", (double)r->frames_bytes);
    for (uint32_t i = 0; i < WRONG_SHOWN && i < r->frames.count; i++) {
        char metric[64];
        snprintf(metric, sizeof metric, "frames_wrong_%u", i + 1);
        row(tsv, r, metric, r->wrong[i]);
    }
    row(tsv, r, "frames_wrong_last", r->last_wrong);
    const struct batch_then *batches[] = {&r->small, &r->large};
    for (uint32_t i = 0; i < array_count(batches); i++) {
        static const char *const names[][3] = {{"small_ms", "small_combinations", "small_missing"},
                                               {"large_ms", "large_combinations", "large_missing"}};
        row(tsv, r, names[i][0], batches[i]->ms);
        row(tsv, r, names[i][1], batches[i]->combinations);
        row(tsv, r, names[i][2], (double)batches[i]->missing);
    }
}

static void batch_columns(FILE *out, const struct batch_then *b)
{
    fprintf(out, " %.1f | %u | %llu |", b->ms, b->combinations, (unsigned long long)b->missing);
}

static void at_once_table(FILE *out, const struct discovery_result *results, uint32_t count,
                          uint32_t size)
{
    fprintf(
        out,
        "| scene | nothing new: ms | waits (longest, ms) | at once: ms | combinations | rounds | "
        "table sent, KB | batch of %d: ms | combinations | then missing | batch of %u: ms | "
        "combinations | then missing |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        SCHEME_BATCH_SMALL, size);
    for (uint32_t i = 0; i < count; i++) {
        const struct discovery_result *r = &results[i];
        fprintf(out, "| %s | %.1f | %llu (%.2f) | %.1f | %llu | %llu | %.1f |", r->scene->name,
                r->known, (unsigned long long)r->waits.count, r->waits.longest * 1e3, r->exact,
                (unsigned long long)r->exact_combinations, (unsigned long long)r->rounds,
                (double)r->exact_bytes / 1024);
        batch_columns(out, &r->small);
        batch_columns(out, &r->large);
        fprintf(out, "\n");
    }
}

static void over_frames_table(FILE *out, const struct discovery_result *results, uint32_t count)
{
    fprintf(out, "\n| scene | over frames: frames | ms of one | ms in all | combinations | table "
                 "sent, KB | wrong pixels in frames 1, 2, ... | in the last |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct discovery_result *r = &results[i];
        double ms = 0;
        for (uint32_t k = 0; k < r->frames.count; k++)
            ms += r->frames.values[k];
        fprintf(out, "| %s | %s%u | %.1f | %.1f | %llu | %.1f |", r->scene->name,
                r->ended ? "" : "over ", r->frames.count, samples_median(&r->frames), ms,
                (unsigned long long)r->frames_combinations, (double)r->frames_bytes / 1024);
        for (uint32_t k = 0; k < WRONG_SHOWN && k < r->frames.count; k++)
            fprintf(out, "%s%u", k ? ", " : " ", r->wrong[k]);
        fprintf(out, " | %u |\n", r->last_wrong);
    }
}

void discovery_tables(FILE *out, const struct discovery_result *results, uint32_t count,
                      uint32_t size)
{
    if (!count)
        return;
    fprintf(out, "\nDrawn with %s, %u x %u pixels.\n\n", results[0].device, size, size);
    at_once_table(out, results, count, size);
    over_frames_table(out, results, count);
}
