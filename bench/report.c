// report.c - results as rows for programs and as tables for people.
#include "report.h"

#include "base/mem.h"

#include <string.h>

static void row(FILE *tsv, const char *scene, const char *metric, const struct samples *s)
{
    if (s->count)
        fprintf(tsv, "%s\t%s\t%.6g\t%.6g\t%u\n", scene, metric, samples_median(s), samples_least(s),
                s->count);
}

static void value(FILE *tsv, const char *scene, const char *metric, double v)
{
    fprintf(tsv, "%s\t%s\t%.6g\t%.6g\t1\n", scene, metric, v, v);
}

void report_heading(FILE *tsv)
{
    fprintf(tsv, "scene\tmetric\tmedian\tmin\tn\n");
}

static double occupancy(const struct result *r)
{
    return r->table.capacity ? (double)r->table.combinations / r->table.capacity : 0;
}

// OpenCSG's time over ours; 0 when it was not measured.
static double ratio(const struct result *r)
{
    int best = result_best_opencsg(r);
    double ours = samples_median(&r->picture);
    return best < 0 || ours <= 0 ? 0 : samples_median(&r->opencsg[best].frames) / ours;
}

void report_rows(FILE *tsv, const struct result *r)
{
    const char *name = r->scene->name;
    row(tsv, name, "parse_ms", &r->parse);
    row(tsv, name, "model_ms", &r->build);
    value(tsv, name, "cold_ms", r->cold);
    row(tsv, name, "opaque_ms", &r->picture);
    row(tsv, name, "setup_ms", &r->setup);
    row(tsv, name, "draw_ms", &r->draw);
    row(tsv, name, "opaque_empty_table_extra", &r->picture_extra);
    row(tsv, name, "edit_tree_ms", &r->edits.tree);
    row(tsv, name, "edit_model_ms", &r->edits.model);
    row(tsv, name, "edit_ms", &r->edits.whole);
    row(tsv, name, "edit_steady_ms", &r->edits.steady);
    row(tsv, name, "edit_over_steady", &r->edits.over_steady);
    row(tsv, name, "intervals_ms", &r->spans);
    row(tsv, name, "intervals_empty_table_extra", &r->spans_extra);
    row(tsv, name, "hash_opaque_ms", &r->walk_picture[WALK_BY_HASH]);
    row(tsv, name, "hash_intervals_ms", &r->walk_spans[WALK_BY_HASH]);
    row(tsv, name, "array_opaque_ms", &r->walk_picture[WALK_BY_ARRAY]);
    row(tsv, name, "array_intervals_ms", &r->walk_spans[WALK_BY_ARRAY]);
    const struct {
        const char *metric;
        double value;
    } values[] = {
        {"leaves", r->leaves},
        {"classes", r->classes},
        {"triangles", r->triangles},
        {"threads", r->threads},
        {"covered", r->covered},
        {"opaque_fragments", r->fragments},
        {"intervals_fragments", r->span_fragments},
        {"opaque_ns_per_fragment_core", r->nanoseconds},
        {"intervals_ns_per_fragment_core", r->span_nanoseconds},
        {"intervals", r->intervals},
        {"misses", r->misses},
        {"combinations", r->table.combinations},
        {"table_occupancy", occupancy(r)},
        {"table_age_mean", r->table.average_age},
        {"table_age_max", r->table.max_age},
        {"table_rebuilds", r->table.rebuilds},
        {"table_bytes", (double)r->table.bytes},
        {"frame_peak_bytes", (double)r->peak_bytes},
    };
    for (size_t i = 0; i < array_count(values); i++)
        value(tsv, name, values[i].metric, values[i].value);
    for (int i = 0; i < OPENCSG_SETTINGS; i++) {
        char metric[64];
        snprintf(metric, sizeof metric, "opencsg_%s_ms", opencsg_settings[i].name);
        row(tsv, name, metric, &r->opencsg[i].frames);
    }
    if (r->products) {
        value(tsv, name, "opencsg_products", r->products);
        value(tsv, name, "opencsg_literals", r->literals);
        value(tsv, name, "opencsg_over_ours", ratio(r));
    }
    report_gl_rows(tsv, r);
    fflush(tsv);
}

// The last part of a path, without its extension.
static void short_name(const char *path, char *out, size_t size)
{
    const char *slash = strrchr(path, '/');
    snprintf(out, size, "%s", slash ? slash + 1 : path);
    char *dot = strrchr(out, '.');
    if (dot)
        *dot = 0;
}

void report_process_row(FILE *tsv, const struct process_result *p)
{
    char name[256];
    short_name(p->file, name, sizeof name);
    row(tsv, name, "process_hcsg_render_ms", &p->ours.times);
    row(tsv, name, "process_openscad_ms", &p->theirs.times);
    fflush(tsv);
}

static void against_opencsg(FILE *out, const struct result *results, uint32_t count)
{
    const char *renderer = NULL;
    fprintf(out, "\n### Against OpenCSG\n\n"
                 "| scene | primitives | products | automatic | automatic, boxes | SCS, queries | "
                 "Goldfeather, queries | hcsg ms | best / hcsg | at least | after |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        if (!r->products)
            continue;
        fprintf(out, "| %s | %u | %u |", r->scene->name, r->leaves, r->products);
        for (int k = 0; k < OPENCSG_SETTINGS; k++) {
            const struct opencsg_result *o = &r->opencsg[k];
            if (o->frames.count)
                fprintf(out, " %.0f (%u) |", samples_median(&o->frames), o->frames.count);
            else
                fprintf(out, " %s |", o->late ? "too slow" : "–");
        }
        fprintf(out, " %.1f | **%.1f** |", samples_median(&r->picture), ratio(r));
        fprintf(out, " %g | %g |\n", r->scene->at_least, r->scene->after);
        renderer = r->renderer;
    }
    if (renderer)
        fprintf(out, "\nOpenGL: %s.\n", renderer);
}

// A figure that only makes sense where there are fragments.
static void print_fragments(FILE *out, double fragments, double nanoseconds)
{
    if (fragments > 0)
        fprintf(out, " %.2f | %.1f |", fragments / 1e6, nanoseconds);
    else
        fprintf(out, " – | – |");
}

// Time of the frame in which nothing is to be decided; 0 when it was not measured.
static double floor_ms(const struct result *results, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(results[i].scene->name, "plain") == 0)
            return samples_median(&results[i].picture);
    return 0;
}

static void frames(FILE *out, const struct result *results, uint32_t count)
{
    double least = floor_ms(results, count);
    fprintf(out, "\n### Frames\n\n"
                 "| scene | covered | opaque ms, median (min, n) | of plain | empty table | "
                 "Mfragments | ns | "
                 "all intervals ms, median (min, n) | empty table | Mfragments | ns | "
                 "intervals per pixel |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        double pixels = (double)r->size * r->size * r->covered;
        fprintf(out, "| %s | %.0f %% | %.1f (%.1f, %u) |", r->scene->name, r->covered * 100,
                samples_median(&r->picture), samples_least(&r->picture), r->picture.count);
        if (least > 0)
            fprintf(out, " %.1f x |", samples_median(&r->picture) / least);
        else
            fprintf(out, " – |");
        fprintf(out, " %+.1f %% |", samples_median(&r->picture_extra) * 100);
        print_fragments(out, r->fragments, r->nanoseconds);
        fprintf(out, " %.1f (%.1f, %u) | %+.1f %% |", samples_median(&r->spans),
                samples_least(&r->spans), r->spans.count, samples_median(&r->spans_extra) * 100);
        print_fragments(out, r->span_fragments, r->span_nanoseconds);
        fprintf(out, " %.2f |\n", pixels > 0 ? r->intervals / pixels : 0);
    }
}

static void stages(FILE *out, const struct result *results, uint32_t count)
{
    fprintf(out, "\n### Stages, ms\n\n"
                 "| scene | triangles | read | build | first frame of all | set up | draw | "
                 "memory of a frame, MB |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        fprintf(out, "| %s | %u | %.2f | %.2f | %.1f | %.2f | %.1f | %.1f |\n", r->scene->name,
                r->triangles, samples_median(&r->parse), samples_median(&r->build), r->cold,
                samples_median(&r->setup), samples_median(&r->draw),
                (double)r->peak_bytes / (1 << 20));
    }
}

static void edits(FILE *out, const struct result *results, uint32_t count)
{
    fprintf(out, "\n### Edited number, ms\n\n"
                 "| scene | primitives | tree | model | edit to picture, median (min, n) | "
                 "the same picture again | edit / again | at most |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct edits_result *e = &results[i].edits;
        if (e->whole.count)
            fprintf(out, "| %s | %u | %.2f | %.2f | %.1f (%.1f, %u) | %.1f | **%.2f** | %.2f |\n",
                    results[i].scene->name, results[i].leaves, samples_median(&e->tree),
                    samples_median(&e->model), samples_median(&e->whole), samples_least(&e->whole),
                    e->whole.count, samples_median(&e->steady), samples_median(&e->over_steady),
                    samples_most(&e->over_steady));
    }
}

static void tables(FILE *out, const struct result *results, uint32_t count)
{
    fprintf(out, "\n### Tables of combinations\n\n"
                 "| scene | values | combinations | places | occupancy | mean age | largest age | "
                 "rebuilds | KB | evaluated in a frame of all intervals from empty |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        const struct discovery_stats *t = &r->table;
        fprintf(out, "| %s | %u | %u | %u | %.0f %% | %.2f | %.0f | %u | %.0f | %.0f |\n",
                r->scene->name, r->classes, t->combinations, t->capacity, occupancy(r) * 100,
                t->average_age, t->max_age, t->rebuilds, (double)t->bytes / 1024, r->misses);
    }
}

static void walks(FILE *out, const struct result *results, uint32_t count)
{
    fprintf(out, "\n### Hash against array, ms\n\n"
                 "| scene | values | opaque: hash | array | array / hash | "
                 "all intervals: hash | array | array / hash |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct result *r = &results[i];
        const struct samples *pictures = r->walk_picture, *spans = r->walk_spans;
        if (!pictures[WALK_BY_ARRAY].count)
            continue;
        double p[WALKS], s[WALKS];
        for (int k = 0; k < WALKS; k++) {
            p[k] = samples_median(&pictures[k]);
            s[k] = samples_median(&spans[k]);
        }
        fprintf(out, "| %s | %u | %.1f | %.0f | %.1f | %.1f | %.0f | %.1f |\n", r->scene->name,
                r->classes, p[WALK_BY_HASH], p[WALK_BY_ARRAY], p[WALK_BY_ARRAY] / p[WALK_BY_HASH],
                s[WALK_BY_HASH], s[WALK_BY_ARRAY], s[WALK_BY_ARRAY] / s[WALK_BY_HASH]);
    }
}

void report_tables(FILE *out, const struct result *results, uint32_t count)
{
    against_opencsg(out, results, count);
    frames(out, results, count);
    stages(out, results, count);
    edits(out, results, count);
    tables(out, results, count);
    walks(out, results, count);
    report_gl_tables(out, results, count);
}

static double process_ratio(const struct process_result *p)
{
    return samples_median(&p->theirs.times) / samples_median(&p->ours.times);
}

static double megabytes(size_t bytes)
{
    return (double)bytes / (1 << 20);
}

static void process_totals(FILE *out, const struct process_result *results, uint32_t count)
{
    struct samples ratios = {0}, shares = {0};
    for (uint32_t i = 0; i < count; i++) {
        const struct process_result *p = &results[i];
        samples_add(&ratios, process_ratio(p));
        samples_add(&shares, (double)p->ours.peak_bytes / (double)p->theirs.peak_bytes);
    }
    fprintf(
        out,
        "\nOf %u files: the median ratio is **%.1f**, the smallest %.1f. hcsg-render's memory is "
        "%.0f %% of openscad's in the median, %.0f %% at most.\n",
        count, samples_median(&ratios), samples_least(&ratios), 100 * samples_median(&shares),
        100 * samples_most(&shares));
    samples_free(&ratios);
    samples_free(&shares);
}

void report_process_table(FILE *out, const struct process_result *results, uint32_t count)
{
    fprintf(out, "\n### Whole processes\n\n"
                 "| file | hcsg-render ms, median (min) | openscad ms, median (min) | ratio | "
                 "hcsg-render MB | openscad MB |\n"
                 "|---|--:|--:|--:|--:|--:|\n");
    for (uint32_t i = 0; i < count; i++) {
        const struct process_result *p = &results[i];
        const char *more = p->late ? "> " : "";
        char name[256];
        short_name(p->file, name, sizeof name);
        fprintf(out, "| %s | %.0f (%.0f) | %s%.0f (%.0f) | %s%.1f | %.0f | %.0f |\n", name,
                samples_median(&p->ours.times), samples_least(&p->ours.times), more,
                samples_median(&p->theirs.times), samples_least(&p->theirs.times), more,
                process_ratio(p), megabytes(p->ours.peak_bytes), megabytes(p->theirs.peak_bytes));
    }
    process_totals(out, results, count);
}
