// test_oracle.c - the device against the oracle.
//
//   test_oracle random [--count N] [--seed N] [--threads N]   random trees, pixel by pixel
//   test_oracle random --seed N --pixel X Y                   one pixel, with the fewest leaves
//   test_oracle threads | memory | slabs | walks | lists      one picture whatever the settings
//   test_oracle FILE.csg WIDTH HEIGHT [--pixel X Y]           a file from several sides
//   test_oracle agree random [--count N] ...                  two ways to draw, not the oracle
//   test_oracle agree broken [--count N] ...                  of meshes that are open or inside out
//   test_oracle agree FILE.csg WIDTH HEIGHT ...
// --memory MB, --slabs N: what it has to do with, for agree.
// --device gl: of the device on the graphics processor. --hash: the one on the processor walks.
// agree --array: the second way goes by the array method. --budgets: its pictures are the same, bit
// for bit, at 1, 3 and 5 slabs and in next to no memory.
#include "agree_runs.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "broken.h"
#include "report.h"
#include "sides.h"

#include <stdlib.h>
#include <string.h>

struct outcome {
    uint64_t pixels, hits, verdicts[VERDICTS];
    uint64_t probed, unstable; // of a sample of all pixels
    uint64_t open;             // rays of which the device says that a mesh does not close
    bool aligned;
    bool explain; // asked for: print the first pixel that is worse than all before
    int x, y;     // first pixel that is wrong, or unexplained when none is wrong
    enum verdict worst;
    enum fit reason;
    uint64_t reasons[FITS_COUNT]; // of pixels that are not forgiven
};

static void compare_picture(struct outcome *out, struct comparison *c, const struct picture *p)
{
    for (int y = 0; y < c->rays->height; y++)
        for (int x = 0; x < c->rays->width; x++) {
            enum verdict v = compare_pixel(c, p, x, y);
            out->pixels++;
            out->hits += c->answer.count > 0;
            out->verdicts[v]++;
            if (v != VERDICT_AGREES && v != VERDICT_FORGIVEN)
                out->reasons[c->reason]++;
            if (v > out->worst) {
                out->worst = v;
                out->x = x;
                out->y = y;
                out->reason = c->reason;
                if (out->explain && v >= VERDICT_UNEXPLAINED) {
                    printf("pixel %d %d: %s\n", x, y, fit_text[c->reason]);
                    compare_pixel(c, p, x, y); // judging cast other rays
                    report_pixel(stdout, c, p, x, y);
                }
            }
            if (out->pixels % 41 == 0) {
                out->probed++;
                out->unstable += compare_unstable(c, x, y);
            }
        }
    out->open += p->surface_stats.open_rays + p->span_stats.open_rays;
}

static void compare_side(struct outcome *out, struct device *device, const struct side *side,
                         const struct expr_token *tokens, size_t token_count,
                         const struct options *pixel)
{
    struct picture picture;
    struct oracle oracle;
    struct oracle_leaf *leaves = subject_leaves(side->body);
    picture_render(&picture, device, side->body, &side->rays, &side->settings);
    oracle_init(&oracle, leaves, side->body->leaf_count, tokens, token_count);
    struct comparison c = {.oracle = &oracle,
                           .rays = &side->rays,
                           .epsilon = side->settings.epsilon,
                           .tolerance = side->tolerance};
    if (pixel->one_pixel) {
        compare_pixel(&c, &picture, pixel->x, pixel->y);
        report_pixel(stdout, &c, &picture, pixel->x, pixel->y);
    }
    compare_picture(out, &c, &picture);
    compare_free(&c);
    oracle_free(&oracle);
    picture_free(&picture);
    free(leaves);
}

struct job {
    const struct options *options;
    struct crew crew;
    struct outcome *outcomes;
};

static void compare_seed(void *context, uint32_t item, uint32_t worker)
{
    const struct job *job = context;
    struct outcome *out = &job->outcomes[item];
    struct random_scene scene;
    struct subject subject;
    struct side side;
    random_scene_make(&scene, job->options->seed + item);
    subject_make(&subject, &scene);
    side_of_scene(&side, &scene, &subject.body);
    side.settings.walk = job->options->walk;
    compare_side(out, job->crew.devices[worker], &side, scene.tokens, scene.token_count,
                 job->options);
    out->aligned = scene.aligned;
    subject_free(&subject);
    random_scene_free(&scene);
}

static void add_outcome(struct outcome *sum, const struct outcome *o)
{
    sum->pixels += o->pixels;
    sum->hits += o->hits;
    sum->probed += o->probed;
    sum->unstable += o->unstable;
    sum->open += o->open;
    for (int i = 0; i < VERDICTS; i++)
        sum->verdicts[i] += o->verdicts[i];
    for (int i = 0; i < FITS_COUNT; i++)
        sum->reasons[i] += o->reasons[i];
}

static double percent(uint64_t part, uint64_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0;
}

static void print_outcome(const char *name, const struct outcome *o)
{
    printf("%s: %llu pixels, %.1f %% hit, %llu forgiven (%.4f %%), %llu owner, %llu unexplained, "
           "%llu "
           "wrong, "
           "%.3f %% unstable, %llu open rays\n",
           name, (unsigned long long)o->pixels, percent(o->hits, o->pixels),
           (unsigned long long)o->verdicts[VERDICT_FORGIVEN],
           percent(o->verdicts[VERDICT_FORGIVEN], o->pixels),
           (unsigned long long)o->verdicts[VERDICT_OWNER],
           (unsigned long long)o->verdicts[VERDICT_UNEXPLAINED],
           (unsigned long long)o->verdicts[VERDICT_WRONG], percent(o->unstable, o->probed),
           (unsigned long long)o->open);
    for (int i = 1; i < FITS_COUNT; i++)
        if (o->reasons[i])
            printf("  %llu pixels: %s\n", (unsigned long long)o->reasons[i], fit_text[i]);
}

// Of coincident faces the device may name one that does not make the surface, on few pixels: depth
// is right there, colour may not be.
static bool acceptable(const struct outcome *o, bool aligned)
{
    const uint64_t *v = o->verdicts;
    bool small = o->pixels < 100000; // where one pixel is already a share
    return v[VERDICT_WRONG] == 0 && o->open == 0 && percent(v[VERDICT_OWNER], o->pixels) < 0.01 &&
           percent(v[VERDICT_FORGIVEN], o->pixels) < (aligned || small ? 2 : 0.02) &&
           percent(v[VERDICT_UNEXPLAINED], o->pixels) < (aligned ? 0.02
                                                         : small ? 0.03
                                                                 : 0.001);
}

// Pixels that the comparison would forgive must be rare, or it would prove little.
static bool proves(const struct outcome *o, bool aligned)
{
    return percent(o->unstable, o->probed) < (aligned ? 20 : 2);
}

static void print_seed(uint64_t seed, const struct outcome *o)
{
    printf("seed %llu: %llu wrong, %llu unexplained, %llu owner, %llu open rays, %s: "
           "--seed %llu --pixel %d %d\n",
           (unsigned long long)seed, (unsigned long long)o->verdicts[VERDICT_WRONG],
           (unsigned long long)o->verdicts[VERDICT_UNEXPLAINED],
           (unsigned long long)o->verdicts[VERDICT_OWNER], (unsigned long long)o->open,
           fit_text[o->reason], (unsigned long long)seed, o->x, o->y);
}

static int run_random(const struct options *options)
{
    struct outcome *outcomes = mem_zalloc(options->count * sizeof *outcomes);
    struct job job = {.options = options, .outcomes = outcomes};
    crew_init(&job.crew, options->threads, options->gl);
    parallel_for(options->count, options->threads, compare_seed, &job);
    crew_free(&job.crew);
    struct outcome sum[2] = {{0}, {0}};
    uint32_t shown[4] = {0}, empty = 0;
    for (uint32_t i = 0; i < options->count; i++) {
        const struct outcome *o = &outcomes[i];
        add_outcome(&sum[o->aligned], o);
        empty += o->hits == 0;
        bool strange = o->worst == VERDICT_UNEXPLAINED && o->aligned;
        int kind = o->worst == VERDICT_WRONG || o->open          ? 0
                   : o->worst == VERDICT_UNEXPLAINED && !strange ? 1
                   : o->verdicts[VERDICT_OWNER]                  ? 2
                   : strange                                     ? 3
                                                                 : 4;
        if (kind < 4 && shown[kind]++ < 8)
            print_seed(options->seed + i, o);
    }
    printf("%u trees from seed %llu, %u of them without a surface, %u with errors\n",
           options->count, (unsigned long long)options->seed, empty, shown[0] + shown[1]);
    print_outcome("generic", &sum[0]);
    print_outcome("pixels on faces seen edge-on", &sum[1]);
    free(outcomes);
    bool fine = acceptable(&sum[0], false) && acceptable(&sum[1], true);
    return fine && proves(&sum[0], false) && proves(&sum[1], true) ? 0 : 1;
}

static int run_pixel(const struct options *options)
{
    struct random_scene scene;
    random_scene_make(&scene, options->seed);
    struct render_settings settings = {
        .epsilon = scene.epsilon, .threads = 1, .walk = options->walk};
    printf("seed %llu, %u leaves, pixel %d %d of %d x %d\n", (unsigned long long)options->seed,
           scene.leaf_count, options->x, options->y, scene.rays.width, scene.rays.height);
    struct device *device = device_under_test(options->gl);
    report_smallest(stdout, device, &scene, &settings, options->x, options->y);
    device_delete(device);
    random_scene_free(&scene);
    return 0;
}

// The same view with `times` as many pixels each way.
static void enlarge(struct rays *r, int times)
{
    r->width *= times;
    r->height *= times;
    r->step_x = vec3_scale(r->step_x, 1.0 / times);
    r->step_y = vec3_scale(r->step_y, 1.0 / times);
}

// Pictures of `count` trees with all settings are bit-identical to those with the first.
static int run_same(const struct options *options, const struct render_settings *settings,
                    int setting_count, uint32_t count, int times)
{
    struct device *device = device_under_test(options->gl);
    int different = 0;
    size_t peak = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct random_scene scene;
        struct subject subject;
        random_scene_make(&scene, i % 8 == 7 ? 399 + 400 * (i / 8) : i);
        if (i % 2 && !strcmp(options->mode, "lists"))
            broken_scene(&scene, i);
        enlarge(&scene.rays, times);
        subject_make(&subject, &scene);
        struct picture first = {0}, other;
        for (int k = 0; k < setting_count; k++) {
            struct picture *p = k ? &other : &first;
            struct render_settings s = settings[k];
            s.epsilon = scene.epsilon;
            picture_render(p, device, &subject.body, &scene.rays, &s);
            int x, y;
            size_t bytes = p->surface_stats.peak_bytes > p->span_stats.peak_bytes
                               ? p->surface_stats.peak_bytes
                               : p->span_stats.peak_bytes;
            if (s.memory && bytes > s.memory) {
                printf("tree %u: %zu bytes where %zu are allowed\n", i, bytes, s.memory);
                different++;
            }
            peak = bytes > peak ? bytes : peak;
            if (!k)
                continue;
            if (!picture_equal(&first, &other, &x, &y)) {
                printf("tree %u, setting %d: pixel %d %d of %d x %d differs\n", i, k, x, y,
                       scene.rays.width, scene.rays.height);
                different++;
            }
            picture_free(&other);
        }
        picture_free(&first);
        subject_free(&subject);
        random_scene_free(&scene);
    }
    struct error why;
    if (device_failed(device, &why)) {
        printf("the device has failed: %s\n", why.text);
        different++;
    }
    device_delete(device);
    printf("%s: %u trees, %d differences, at most %zu bytes\n", options->mode, count, different,
           peak);
    return different ? 1 : 0;
}

struct file_job {
    const struct options *options;
    struct device *device;
    int failed;
};

static void judge_side(void *context, const struct side *side)
{
    struct file_job *job = context;
    struct outcome o = {.explain = true};
    size_t token_count;
    struct expr_token *tokens = subject_tokens(&side->body->expr, &token_count);
    compare_side(&o, job->device, side, tokens, token_count, job->options);
    print_outcome(side->name, &o);
    job->failed += !acceptable(&o, side->aligned);
    free(tokens);
}

static int run_file(const struct options *o)
{
    struct file_job job = {.options = o, .device = device_under_test(o->gl)};
    bool read = sides_of_file(o->file, o->width, o->height, judge_side, &job);
    device_delete(job.device);
    return read && !job.failed ? 0 : 1;
}

int main(int argc, char **argv)
{
    static const struct render_settings threads[] = {
        {.threads = 1}, {.threads = 2}, {.threads = 8}};
    static const struct render_settings memory[] = {{.threads = 2},
                                                    {.threads = 2, .memory = 16 << 20}};
    static const struct render_settings gl_memory[] = {{.threads = 2},
                                                       {.memory = 4 << 20},
                                                       {.memory = 1 << 20},
                                                       {.memory = 64 << 10},
                                                       {.memory = 0}};
    static const struct render_settings slabs[] = {
        {.slabs = 0}, {.slabs = 1}, {.slabs = 3}, {.slabs = 5}, {.slabs = 17, .memory = 2 << 20}};
    static const struct render_settings lists[] = {
        {0}, {.linked = true}, {.linked = true, .slabs = 3}, {.linked = true, .memory = 64 << 10}};
    static const struct render_settings walks[] = {{.walk = WALK_HASH}, {.walk = WALK_ARRAY}};
    struct options options = {0};
    if (!options_parse(&options, argc, argv))
        return 2;
    if (options.agree)
        return options.file ? agree_file(&options) : agree_random(&options);
    if (options.file)
        return run_file(&options);
    if (!strcmp(options.mode, "threads"))
        return run_same(&options, threads, array_count(threads), 40, 8);
    if (!strcmp(options.mode, "slabs"))
        return run_same(&options, slabs, array_count(slabs), 7, 2);
    if (!strcmp(options.mode, "lists"))
        return run_same(&options, lists, array_count(lists), 12, 1);
    if (!strcmp(options.mode, "memory") && options.gl)
        return run_same(&options, gl_memory, array_count(gl_memory), 7, 3);
    if (!strcmp(options.mode, "memory"))
        return run_same(&options, memory, array_count(memory), 16, 24);
    if (!strcmp(options.mode, "walks"))
        return run_same(&options, walks, array_count(walks), 40, 2);
    return options.one_pixel ? run_pixel(&options) : run_random(&options);
}
