// agree_runs.c - two ways to draw compared on random trees and files.
#include "agree_runs.h"

#include "agree.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "broken.h"
#include "render/gl/plan.h"
#include "report.h"
#include "sides.h"

#include <stdlib.h>
#include <string.h>

static double share(uint64_t others, uint64_t pixels)
{
    return pixels ? 100.0 * (double)(pixels - others) / (double)pixels : 100;
}

// Where pixels lie on faces seen edge-on, silhouettes are everywhere, and either face is right.
static bool agrees(const struct agreement *a, double tolerance, bool aligned)
{
    double wanted = aligned ? 98 : 99.99;
    return !a->unequal && share(a->surface.others, a->pixels) >= wanted &&
           share(a->spans.others, a->pixels) >= wanted &&
           (aligned || fmax(a->surface.depth, a->spans.depth) <= tolerance);
}

static void print_part(const char *name, const struct agreement_of *of, uint64_t pixels)
{
    printf("  %s: same leaf %.4f %%, or another in its place %.4f %%, depths within %.3f um\n",
           name, share(of->others, pixels), share(of->apart, pixels), 1e3 * of->depth);
}

static void print_agreement(const char *name, const struct agreement *a)
{
    printf("%s: %llu pixels, %.1f %% hit, %.1f %% at silhouettes\n", name,
           (unsigned long long)a->pixels, 100 - share(a->hits, a->pixels),
           100 - share(a->silhouettes, a->pixels));
    if (a->unequal)
        printf("  %llu pictures changed with the settings\n", (unsigned long long)a->unequal);
    print_part("surfaces", &a->surface, a->pixels);
    print_part("spans", &a->spans, a->pixels);
}

static void explain_pixel(const struct agreement_of *of, const struct side *side,
                          const struct picture *a, const struct picture *b)
{
    if (!of->others && of->depth <= side->tolerance)
        return;
    printf("pixel %d %d, as drawn by the first and the second:\n", of->x, of->y);
    report_device(stdout, &side->rays, a, of->x, of->y);
    report_device(stdout, &side->rays, b, of->x, of->y);
    report_crossings(stdout, side->body, &side->rays, of->x, of->y);
}

// Is the picture another one with other settings?
static uint64_t count_unequal(struct device *device, const struct side *side,
                              const struct render_settings *settings, const struct picture *wanted)
{
    static const struct render_settings budgets[] = {
        {.slabs = 3}, {.slabs = 5}, {.memory = GL_MEMORY_LEAST}};
    uint64_t unequal = 0;
    for (size_t i = 0; i < array_count(budgets); i++) {
        struct picture p;
        struct render_settings s = *settings;
        int x, y;
        s.slabs = budgets[i].slabs;
        s.memory = budgets[i].memory;
        picture_render(&p, device, side->body, &side->rays, &s);
        if (!picture_equal(wanted, &p, &x, &y)) {
            printf("pixel %d %d changes with the settings\n", x, y);
            report_device(stdout, &side->rays, wanted, x, y);
            report_device(stdout, &side->rays, &p, x, y);
            unequal++;
        }
        picture_free(&p);
    }
    return unequal;
}

static void compare(struct agreement *out, struct device *first, struct device *second,
                    const struct side *side, const struct options *options, bool explain)
{
    struct picture a, b;
    struct render_settings settings = side->settings;
    settings.memory = options->memory;
    settings.slabs = options->slabs;
    settings.walk = options->walk;
    picture_render(&a, first, side->body, &side->rays, &settings);
    settings.walk = options->array ? WALK_ARRAY : WALK_HASH;
    picture_render(&b, second, side->body, &side->rays, &settings);
    agree_compare(out, side->body, &side->rays, &a, &b, side->tolerance);
    if (options->budgets)
        out->unequal = count_unequal(second, side, &settings, &b);
    if (explain) {
        explain_pixel(&out->surface, side, &a, &b);
        explain_pixel(&out->spans, side, &a, &b);
    }
    picture_free(&a);
    picture_free(&b);
}

struct tree_outcome {
    struct agreement agreement;
    bool aligned;
};

struct trees {
    const struct options *options;
    struct crew first, second;
    struct tree_outcome *outcomes;
};

static void compare_tree(void *context, uint32_t item, uint32_t worker)
{
    const struct trees *t = context;
    struct tree_outcome *out = &t->outcomes[item];
    struct random_scene scene;
    struct subject subject;
    struct side side;
    random_scene_make(&scene, t->options->seed + item);
    if (!strcmp(t->options->mode, "broken"))
        broken_scene(&scene, t->options->seed + item);
    subject_make(&subject, &scene);
    side_of_scene(&side, &scene, &subject.body);
    out->aligned = side.aligned;
    compare(&out->agreement, t->first.devices[worker], t->second.devices[worker], &side, t->options,
            t->options->count == 1);
    subject_free(&subject);
    random_scene_free(&scene);
}

int agree_random(const struct options *options)
{
    enum { SHOWN = 8 };
    struct trees trees = {.options = options,
                          .outcomes = mem_zalloc(options->count * sizeof *trees.outcomes)};
    struct agreement sum[2] = {{0}, {0}};
    uint32_t strange = 0;
    crew_init(&trees.first, options->threads, false);
    crew_init(&trees.second, options->threads, options->gl);
    parallel_for(options->count, options->threads, compare_tree, &trees);
    crew_free(&trees.first);
    crew_free(&trees.second);
    for (uint32_t i = 0; i < options->count; i++) {
        const struct tree_outcome *o = &trees.outcomes[i];
        char name[64];
        snprintf(name, sizeof name, "--count 1 --seed %llu", (unsigned long long)options->seed + i);
        agree_add(&sum[o->aligned], &o->agreement);
        if (!agrees(&o->agreement, 2e-3, o->aligned) && strange++ < SHOWN)
            print_agreement(name, &o->agreement);
    }
    free(trees.outcomes);
    printf("%u trees from seed %llu, %u of them beyond the bounds of all\n", options->count,
           (unsigned long long)options->seed, strange);
    print_agreement("generic", &sum[0]);
    print_agreement("pixels on faces seen edge-on", &sum[1]);
    bool few = strange <= options->count / 200; // a pixel of one tree is too few to count in all
    return few && agrees(&sum[0], 2e-3, false) && agrees(&sum[1], 2e-3, true) ? 0 : 1;
}

struct file_sides {
    const struct options *options;
    struct device *first, *second;
    uint32_t strange;
};

static void compare_side(void *context, const struct side *side)
{
    struct file_sides *f = context;
    struct agreement a;
    compare(&a, f->first, f->second, side, f->options, true);
    print_agreement(side->name, &a);
    f->strange += !agrees(&a, side->tolerance, side->aligned);
}

int agree_file(const struct options *options)
{
    struct file_sides f = {options, cpu_device_new(), device_under_test(options->gl), 0};
    bool read = sides_of_file(options->file, options->width, options->height, compare_side, &f);
    device_delete(f.first);
    device_delete(f.second);
    return read && !f.strange ? 0 : 1;
}
