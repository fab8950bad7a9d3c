// bench_main.c - hcsg-bench: frame times on the scenes of scenes.txt, beside OpenCSG's.
#include "base/mem.h"
#include "curves.h"
#include "discovery.h"
#include "lists.h"
#include "measure.h"
#include "program.h"
#include "report.h"
#include "turn.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct {
    const char *list, *scenes, *output, *pictures, *device;
    bool opencsg, process, unshared, curves, values, discovery, lists;
    uint32_t frames, threads, size;
    double limit;
} given = {.list = HCSG_BENCH_LIST,
           .scenes = HCSG_BENCH_SCENES,
           .device = "auto",
           .frames = TURN_VIEWS,
           .threads = 2,
           .size = 1024,
           .limit = 6};

static const struct option options[] = {
    {"list", 0, OPTION_TEXT, "FILE", "table of the scenes (default: scenes.txt of the source)",
     &given.list, 0, 0},
    {"scenes", 0, OPTION_TEXT, "FOLDER", "where the scenes are exported to as NAME.csg",
     &given.scenes, 0, 0},
    {"output", 'o', OPTION_TEXT, "FILE", "write all figures there: scene, metric, median, min, n",
     &given.output, 0, 0},
    {"pictures", 0, OPTION_TEXT, "FOLDER", "write pictures of the first view there",
     &given.pictures, 0, 0},
    {"device", 0, OPTION_TEXT, "auto|cpu|gl",
     "measure OpenGL beside the processor: where there is hardware for\n"
     "it (auto, default), not at all, or also in software",
     &given.device, 0, 0},
    {"opencsg", 0, OPTION_FLAG, NULL, "measure OpenCSG too, scene by scene", &given.opencsg, 0, 0},
    {"unshared", 0, OPTION_FLAG, NULL, "give each primitive a value of its own", &given.unshared, 0,
     0},
    {"curves", 0, OPTION_FLAG, NULL,
     "write times of all intervals by the side of the picture, 256 to\n"
     "8192, and opaque frames, to --output instead: for bench/plot",
     &given.curves, 0, 0},
    {"values", 0, OPTION_FLAG, NULL,
     "write times by the hash and by the array, with values shared and\n"
     "unshared, to --output instead: for bench/plot",
     &given.values, 0, 0},
    {"discovery", 0, OPTION_FLAG, NULL,
     "compare how combinations are learned with OpenGL: at once, over\n"
     "frames, from three sides",
     &given.discovery, 0, 0},
    {"lists", 0, OPTION_FLAG, NULL,
     "measure instead how OpenGL lists crossings: counted, written and\n"
     "sorted, or inserted in order into linked lists",
     &given.lists, 0, 0},
    {"process", 0, OPTION_FLAG, NULL,
     "the operands are .csg files: time whole runs of hcsg-render and openscad", &given.process, 0,
     0},
    {"frames", 0, OPTION_COUNT, "N", "frames of each kind, 13 views in turn (default 13)",
     &given.frames, 1, 10000},
    {"threads", 0, OPTION_COUNT, "N", "threads to draw with; 0: one per processor (default 2)",
     &given.threads, 0, 256},
    {"size", 0, OPTION_COUNT, "N", "side of the picture in pixels (default 1024)", &given.size, 16,
     8192},
    {"limit", 0, OPTION_NUMBER, "S", "seconds for each kind of frame (default 6)", &given.limit, 0,
     1e6},
};

static const struct program program = {
    .name = "hcsg-bench",
    .version = HCSG_VERSION,
    .summary = "Measures hcsg on its scenes.",
    .operands = "[SCENE...]",
    .options = options,
    .option_count = array_count(options),
};

// Path of a program that was built beside this one.
static void sibling(char *out, size_t size, const char *name)
{
    char self[3072];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = 0;
    char *slash = strrchr(self, '/');
    if (slash)
        slash[1] = 0;
    snprintf(out, size, "%s%s", self, name);
}

static bool is_wanted(const char *name, char **names, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0)
            return true;
    return count == 0;
}

static bool names_are_known(const struct scenes *scenes, char **names, int count, struct error *err)
{
    for (int i = 0; i < count; i++) {
        bool found = false;
        for (uint32_t k = 0; k < scenes->count; k++)
            found |= strcmp(scenes->items[k].name, names[i]) == 0;
        if (!found) {
            error_set(err, "no scene '%s' in %s", names[i], given.list);
            return false;
        }
    }
    return true;
}

static bool bench_scene(FILE *tsv, struct result *r, struct discovery_result *lesson,
                        struct error *err)
{
    char csg[4096], opencsg[4096];
    snprintf(csg, sizeof csg, "%s/%s.csg", given.scenes, r->scene->name);
    sibling(opencsg, sizeof opencsg, "hcsg-bench-opencsg");
    struct measure_options ours = {.threads = given.threads,
                                   .size = given.size,
                                   .frames = given.frames,
                                   .limit = given.limit,
                                   .unshared = given.unshared,
                                   .pictures = given.pictures};
    fprintf(stderr, "%s: %s\n", program.name, r->scene->name);
    if (!device_wish_parse(&ours.gl, given.device, err))
        return false;
    if (given.curves) {
        struct curves_options curves = {ours, given.opencsg ? opencsg : NULL};
        return curves_by_side(tsv, r->scene, csg, &curves, err);
    }
    if (given.values)
        return curves_by_values(tsv, r->scene->name, csg, &ours, err);
    if (given.discovery) {
        bool learned = discovery_measure(lesson, r->scene, csg, &ours, err);
        if (learned && tsv)
            discovery_rows(tsv, lesson);
        return learned;
    }
    if (given.lists)
        return lists_measure(stdout, r->scene->name, csg, &ours, err);
    if (!measure_scene(r, csg, &ours, err))
        return false;
    const struct opponent_options theirs = {.program = opencsg,
                                            .size = given.size,
                                            .threads = r->threads,
                                            .limit = given.limit,
                                            .pictures = given.pictures};
    bool drawable = r->scene->at_least > 0;
    bool ok = !given.opencsg || !drawable || opponent_measure(r, csg, &theirs, err);
    if (ok && tsv)
        report_rows(tsv, r);
    return ok;
}

static bool bench_scenes(FILE *tsv, char **names, int count, struct error *err)
{
    struct scenes scenes;
    if (!scenes_read(&scenes, given.list, err))
        return false;
    struct result *results = mem_zalloc((scenes.count + 1) * sizeof *results);
    struct discovery_result *lessons = mem_zalloc((scenes.count + 1) * sizeof *lessons);
    uint32_t done = 0;
    if (given.lists)
        lists_heading(stdout);
    bool ok = names_are_known(&scenes, names, count, err);
    for (uint32_t i = 0; ok && i < scenes.count; i++) {
        if (!is_wanted(scenes.items[i].name, names, count))
            continue;
        struct result *r = &results[done];
        r->scene = &scenes.items[i];
        ok = bench_scene(tsv, r, &lessons[done++], err);
    }
    if (ok && given.discovery)
        discovery_tables(stdout, lessons, done, given.size);
    else if (ok && !given.curves && !given.values && !given.lists)
        report_tables(stdout, results, done);
    for (uint32_t i = 0; i < done; i++) {
        result_free(&results[i]);
        discovery_free(&lessons[i]);
    }
    free(results);
    free(lessons);
    scenes_free(&scenes);
    return ok;
}

static bool bench_processes(FILE *tsv, char **files, int count, struct error *err)
{
    char render[4096];
    sibling(render, sizeof render, "hcsg-render");
    struct process_result *results = mem_zalloc(((size_t)count + 1) * sizeof *results);
    uint32_t done = 0;
    bool ok = true;
    for (int i = 0; ok && i < count; i++) {
        ok = process_measure(&results[done], files[i], render, err);
        if (ok && tsv)
            report_process_row(tsv, &results[done]);
        done += ok;
    }
    if (ok)
        report_process_table(stdout, results, done);
    for (uint32_t i = 0; i < done; i++)
        process_free(&results[i]);
    free(results);
    return ok;
}

static bool run(char **operands, int count, struct error *err)
{
    FILE *tsv = NULL;
    if ((given.curves || given.values) && !given.output) {
        error_set(err, "%s needs --output", given.curves ? "--curves" : "--values");
        return false;
    }
    if (given.output) {
        tsv = fopen(given.output, given.process ? "a" : "w");
        if (!tsv) {
            error_set(err, "%s: cannot write", given.output);
            return false;
        }
        if (!given.process)
            report_heading(tsv);
    }
    bool ok = given.process ? bench_processes(tsv, operands, count, err)
                            : bench_scenes(tsv, operands, count, err);
    if (tsv && fclose(tsv) != 0 && ok) {
        error_set(err, "%s: cannot write", given.output);
        ok = false;
    }
    return ok;
}

int main(int argc, char **argv)
{
    return program_main(&program, argc, argv, run);
}
