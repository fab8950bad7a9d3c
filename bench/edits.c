// edits.c - the time from a number that is edited to its picture.
#include "edits.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "edit/edit.h"
#include "render/picture.h"
#include "turn.h"

#include <stdlib.h>
#include <string.h>

enum { EDITS = 13 };

struct shown {
    struct model model;
    struct shader shader;
};

struct live {
    struct edit *edit;
    struct solid_store *store;
    struct device *device;
    struct picture picture;
    struct rays rays;
    struct shown *now;
};

static struct shown *build(const struct csg_tree *tree, struct solid_store *store,
                           const struct model *before)
{
    struct shown *out = mem_zalloc(sizeof *out);
    struct messages messages = {0};
    struct model_options options = MODEL_DEFAULTS;
    options.before = before;
    model_build(&out->model, tree, store, &options, &messages);
    shader_init(&out->shader, &out->model, scheme_list(&(uint32_t){0}));
    messages_free(&messages);
    return out;
}

static void shown_free(struct shown *s)
{
    shader_free(&s->shader);
    model_free(&s->model);
    free(s);
}

static double draw(struct live *l, const struct measure_options *options,
                   struct render_stats *stats)
{
    struct render_settings settings = {.epsilon = model_epsilon(&l->now->model, -1),
                                       .threads = options->threads,
                                       .memory = (size_t)MEMORY_BUDGET << 20};
    double start = clock_seconds();
    picture_draw(&l->picture, l->device, &l->now->shader, &l->rays, &settings, stats);
    return (clock_seconds() - start) * 1e3;
}

// A size of a shape, or how far a matrix moves along x.
static bool change_number(struct edit *e, uint32_t node)
{
    const char *name = edit_name(e, node);
    bool matrix = strcmp(name, "multmatrix") == 0;
    struct csg_value v;
    struct error err;
    if (!matrix && strcmp(name, "cube") != 0 && strcmp(name, "sphere") != 0 &&
        strcmp(name, "cylinder") != 0)
        return false;
    for (uint32_t a = 0; a < edit_source(e)->nodes[node]->argument_count; a++) {
        const char *argument = edit_source(e)->nodes[node]->arguments[a].name;
        if (argument && *argument == '$')
            continue;
        if (edit_scalar(e, node, a, matrix ? 3 : 0, &v) && v.kind == CSG_NUMBER)
            return edit_set_number(e, node, a, matrix ? 3 : 0, v.number * 1.03 + 0.01, &err);
    }
    return false;
}

// The first number in a node from this one on that can be changed.
static bool change_from(struct edit *e, uint32_t node)
{
    uint32_t count = edit_source(e)->node_count;
    for (uint32_t i = 0; i < count; i++)
        if (change_number(e, (node + i) % count))
            return true;
    return false;
}

static void measure_one(struct live *l, const struct measure_options *options,
                        struct edits_result *out)
{
    struct csg_tree tree;
    struct render_stats stats;
    double start = clock_seconds();
    edit_tree(l->edit, &tree);
    samples_add(&out->tree, (clock_seconds() - start) * 1e3);
    double parsed = clock_seconds();
    struct shown *before = l->now;
    l->now = build(&tree, l->store, &before->model);
    samples_add(&out->model, (clock_seconds() - parsed) * 1e3);
    draw(l, options, &stats);
    double whole = (clock_seconds() - start) * 1e3, again = draw(l, options, &stats);
    samples_add(&out->whole, whole);
    samples_add(&out->steady, again);
    samples_add(&out->over_steady, whole / again);
    csg_free(&tree);
    shown_free(before);
}

bool edits_measure(struct result *out, const char *csg, const struct measure_options *options,
                   struct error *err)
{
    struct live l = {0};
    struct messages messages = {0};
    char *text;
    size_t size;
    if (!file_read(csg, (size_t)1 << 30, &text, &size, err))
        return false;
    struct source *source = source_new(csg, text, size, &messages);
    if (!source) {
        error_set(err, "%s", messages.count ? messages.items[0].text : "cannot read the scene");
        messages_free(&messages);
        return false;
    }
    l.edit = edit_new(source);
    l.store = solid_store_new();
    l.device = cpu_device_new();
    l.now = build(&source->tree, l.store, NULL);
    l.rays = turn_view(l.now->model.bounds, 0, (int)options->size);
    struct render_stats stats;
    draw(&l, options, &stats);
    double spent = 0;
    for (uint32_t i = 0; i < EDITS && (i == 0 || spent < options->limit); i++) {
        double start = clock_seconds();
        if (!change_from(l.edit, source->node_count / EDITS * i))
            break;
        measure_one(&l, options, &out->edits);
        spent += clock_seconds() - start;
    }
    shown_free(l.now);
    picture_free(&l.picture);
    device_delete(l.device);
    solid_store_delete(l.store);
    edit_delete(l.edit);
    source_release(source);
    messages_free(&messages);
    return true;
}
