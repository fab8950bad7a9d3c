// report_gl.c - what OpenGL takes beside the processor, in tables shaped like the HCSG paper's.
#include "report.h"

#include <string.h>

static void value(FILE *tsv, const char *scene, const char *metric, double v)
{
    fprintf(tsv, "%s\t%s\t%.6g\t%.6g\t1\n", scene, metric, v, v);
}

static void kind_rows(FILE *tsv, const char *scene, const char *name, const struct gl_kind *k)
{
    char metric[128];
    double frames = k->frames.count;
    if (!k->frames.count)
        return;
    fprintf(tsv, "%s\tgl_%s_ms\t%.6g\t%.6g\t%u\n", scene, name, samples_median(&k->frames),
            samples_least(&k->frames), k->frames.count);
    snprintf(metric, sizeof metric, "gl_%s_fragments", name);
    value(tsv, scene, metric, (double)k->sum.fragments / frames);
    snprintf(metric, sizeof metric, "gl_%s_waits", name);
    value(tsv, scene, metric, (double)k->sum.waits.count / frames);
    snprintf(metric, sizeof metric, "gl_%s_waits_ms", name);
    value(tsv, scene, metric, k->sum.waits.seconds * 1e3 / frames);
    snprintf(metric, sizeof metric, "gl_%s_longest_wait_ms", name);
    value(tsv, scene, metric, k->sum.waits.longest * 1e3);
    for (int i = 0; i < RENDER_PASSES && k->sum.passes[i].name; i++) {
        const struct render_pass *p = &k->sum.passes[i];
        snprintf(metric, sizeof metric, "gl_%s_%s_pass_ms", name, p->name);
        value(tsv, scene, metric, p->seconds * 1e3 / frames);
    }
}

static void batch_rows(FILE *tsv, const char *scene, const char *device, const struct batch *b)
{
    static const int sizes[BATCHES] = {BATCH_SMALL, BATCH_LARGE};
    for (int i = 0; i < BATCHES; i++) {
        char metric[128];
        snprintf(metric, sizeof metric, "%sbatch_%d_ms", device, sizes[i]);
        value(tsv, scene, metric, b[i].ms);
        snprintf(metric, sizeof metric, "%sbatch_%d_combinations", device, sizes[i]);
        value(tsv, scene, metric, b[i].combinations);
    }
}

void report_gl_rows(FILE *tsv, const struct result *r)
{
    const char *scene = r->scene->name;
    batch_rows(tsv, scene, "", r->batch);
    if (!r->gl.measured)
        return;
    value(tsv, scene, "gl_cold_ms", r->gl.cold);
    kind_rows(tsv, scene, "opaque", &r->gl.opaque);
    kind_rows(tsv, scene, "intervals", &r->gl.spans);
    kind_rows(tsv, scene, "array_opaque", &r->gl.array_opaque);
    kind_rows(tsv, scene, "array_intervals", &r->gl.array_spans);
    batch_rows(tsv, scene, "gl_", r->gl.batch);
    value(tsv, scene, "gl_peak_bytes", (double)r->gl.peak_bytes);
    value(tsv, scene, "gl_model_bytes", (double)r->gl.model_bytes);
}

// What the columns of the tables are made of.
enum part { LISTS, WALKS_OF_RAYS, COPIES, DISCOVERY, PARTS };

static enum part part_of(const char *pass)
{
    if (strcmp(pass, "resolve") == 0 || strcmp(pass, "rewalk") == 0)
        return WALKS_OF_RAYS;
    if (strcmp(pass, "upload") == 0 || strcmp(pass, "readback") == 0)
        return COPIES;
    return strcmp(pass, "discover") == 0 ? DISCOVERY : LISTS;
}

// ms of a frame; returns how many slabs of bands it had.
static double parts_of(const struct gl_kind *k, double ms[PARTS])
{
    double slabs = 0, frames = k->frames.count;
    for (int i = 0; i < PARTS; i++)
        ms[i] = 0;
    for (int i = 0; i < RENDER_PASSES && k->sum.passes[i].name; i++) {
        const struct render_pass *p = &k->sum.passes[i];
        ms[part_of(p->name)] += p->seconds * 1e3 / frames;
        if (strcmp(p->name, "scatter") == 0)
            slabs = (double)p->count / frames;
    }
    return slabs;
}

static void kind_columns(FILE *out, const struct gl_kind *k, const struct gl_kind *array)
{
    double ms[PARTS], slabs = parts_of(k, ms), frames = k->frames.count;
    for (int i = 0; i < PARTS; i++)
        fprintf(out, " %.2f |", ms[i]);
    fprintf(out, " %.1f (%.1f, %u) | %.1f | %.2f |", samples_median(&k->frames),
            samples_least(&k->frames), k->frames.count, slabs,
            (double)k->sum.fragments / frames / 1e6);
    fprintf(out, " %.1f (%.2f) |", (double)k->sum.waits.count / frames, k->sum.waits.longest * 1e3);
    if (array->frames.count) {
        parts_of(array, ms);
        fprintf(out, " %.2f | %.1f |\n", ms[WALKS_OF_RAYS], samples_median(&array->frames));
    } else {
        fprintf(out, " – | – |\n");
    }
}

static void kind_table(FILE *out, const struct result *results, uint32_t count, bool spans)
{
    fprintf(
        out,
        "\n### %s on both devices, ms\n\n"
        "| scene | cpu: total | gl: lists | walks | copies | discovery | total, median (min, n) "
        "| slabs | Mfragments | waits (longest) | array: walks | total |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        spans ? "Transparent (all intervals)" : "Opaque");
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        fprintf(out, "| %s | %.1f |", r->scene->name,
                samples_median(spans ? &r->spans : &r->picture));
        if (r->gl.measured)
            kind_columns(out, spans ? &r->gl.spans : &r->gl.opaque,
                         spans ? &r->gl.array_spans : &r->gl.array_opaque);
        else
            fprintf(out, " not measured | | | | | | | | | |\n");
    }
}

static void batch_columns(FILE *out, const struct batch *b)
{
    for (int i = 0; i < BATCHES; i++)
        fprintf(out, " %.1f (%u) |", b[i].ms, b[i].combinations);
}

static void batch_table(FILE *out, const struct result *results, uint32_t count)
{
    fprintf(out,
            "\n### Discovery in batch on both devices, ms (combinations)\n\n"
            "| scene | triangles | primitives | values | cpu: %d x %d | %d x %d | "
            "gl: %d x %d | %d x %d | gl: first frame of all, ms | gl: memory of a frame, MB "
            "| of the model |\n"
            "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
            BATCH_SMALL, BATCH_SMALL, BATCH_LARGE, BATCH_LARGE, BATCH_SMALL, BATCH_SMALL,
            BATCH_LARGE, BATCH_LARGE);
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        fprintf(out, "| %s | %u | %u | %u |", r->scene->name, r->triangles, r->leaves, r->classes);
        batch_columns(out, r->batch);
        if (!r->gl.measured) {
            fprintf(out, " not measured | | | | |\n");
            continue;
        }
        batch_columns(out, r->gl.batch);
        fprintf(out, " %.1f | %.1f | %.1f |\n", r->gl.cold, (double)r->gl.peak_bytes / (1 << 20),
                (double)r->gl.model_bytes / (1 << 20));
    }
}

void report_gl_tables(FILE *out, const struct result *results, uint32_t count)
{
    if (!count || !results[0].gl.device[0])
        return;
    batch_table(out, results, count);
    kind_table(out, results, count, true);
    kind_table(out, results, count, false);
    report_paper_table(out, results, count);
    fprintf(out, "\ngl: %s%s.\n",
            results[0].gl.measured ? "" : "not measured: ", results[0].gl.device);
}
