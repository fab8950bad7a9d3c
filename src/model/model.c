// model.c - what there is to draw: solids, placed leaves and expressions over them.
#include "base/file.h"
#include "model/evaluate.h"
#include "model/sheet.h"

#include <stdlib.h>

// Each marked object is drawn on its own; past this number of a kind the rest shares one body.
enum { BODIES_MAX = 64 };

// Numbers of six digits are off by up to 5e-6 of their size. Small models, as those drawn in
// metres, are not to lose their real layers to that; large ones mostly have round numbers.
static double default_epsilon(struct box bounds)
{
    double extent = 0;
    if (!box_is_empty(bounds))
        extent = fmax(bounds.max.x - bounds.min.x,
                      fmax(bounds.max.y - bounds.min.y, bounds.max.z - bounds.min.z));
    return extent < 100 ? 1e-5 * extent : fmax(1e-3, 2e-6 * extent);
}

double model_epsilon(const struct model *m, double asked)
{
    return asked >= 0 ? asked : default_epsilon(m->bounds);
}

// Shapes pressed flat become sheets that the filter of thin intervals lets stand.
static void thicken_sheets(struct scene *s, double epsilon)
{
    struct box all = BOX_EMPTY;
    for (uint32_t i = 0; i < s->leaf_count; i++)
        all = box_union(all, box_transformed(s->leaves[i].solid->bounds, &s->leaves[i].to_world));
    double thickness = 4 * (epsilon > 0 ? epsilon : default_epsilon(all));
    for (uint32_t i = 0; i < s->leaf_count; i++) {
        struct leaf *leaf = &s->leaves[i];
        if (sheet_is_flat(&leaf->to_world) &&
            !sheet_thicken(&leaf->to_world, leaf->solid->bounds, thickness))
            leaf->solid = NULL;
    }
}

static void add_bodies(struct model *m, enum body_kind kind, struct builder *b,
                       const struct model_options *options, const struct term_list *terms)
{
    for (uint32_t i = 0, alone = 0; i < terms->count && !builder_cancelled(b); alone++) {
        uint32_t taken = alone + 1 < BODIES_MAX ? 1 : terms->count - i;
        body_build(&m->bodies[m->body_count++], kind, b, options, &terms->items[i], taken,
                   &m->bounds);
        i += taken;
    }
}

static void count_stats(struct model *m, const struct builder *b)
{
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < m->body_count; i++) {
        const struct body *body = &m->bodies[i];
        m->stats.leaves += body->leaf_count;
        for (uint32_t l = 0; l < body->leaf_count; l++)
            triangles += body->leaves[l].solid->mesh.triangle_count;
    }
    m->stats.triangles = triangles < UINT32_MAX ? (uint32_t)triangles : UINT32_MAX;
    m->stats.nodes = b->tree->node_count;
    m->stats.solids = store_counted(b->store);
    m->stats.unsupported = b->unsupported;
}

// Nodes that have to be evaluated as one object are noted on a first walk, evaluated side by side,
// and found ready by the second one.
static void walk_tree(struct builder *b, struct messages *messages)
{
    struct messages first = {0};
    b->messages = &first;
    b->collecting = true;
    builder_walk(b);
    b->collecting = false;
    b->messages = messages;
    bool whole = b->options->mode == MODEL_RENDER;
    if (!b->job_count && !whole) {
        messages_append(messages, &first);
    } else {
        scene_free(&b->scene);
        evaluate_collected(b);
        b->unsupported = 0;
        b->warned.name = NULL;
        if (whole)
            builder_evaluate(b);
        else
            builder_walk(b);
    }
    messages_free(&first);
}

// What the geometry of the whole is, told before the bodies take the scene over.
static void describe(struct model *m, const struct scene *s, bool united)
{
    const struct term *root = s->root < TERM_EMPTY ? &s->terms[s->root] : NULL;
    bool single = root && root->op == TERM_LEAF;
    m->single = single && !united;
    if (single && s->leaves[root->left].flat)
        m->flat = &s->leaves[root->left].solid->outline;
}

void model_build(struct model *out, const struct csg_tree *tree, struct solid_store *store,
                 const struct model_options *options, struct messages *messages)
{
    const char *name = tree->file ? tree->file : "-";
    *out = (struct model){
        .mode = options->mode, .bounds = BOX_EMPTY, .store = store, .file = mem_strdup(name)};
    struct builder b = {.tree = tree,
                        .options = options,
                        .file = out->file,
                        .folder = file_folder(name),
                        .store = store};
    store_join(store);
    store_count_from(store);
    walk_tree(&b, messages);
    if (options->mode == MODEL_RENDER)
        describe(out, &b.scene, options->united);
    thicken_sheets(&b.scene, options->epsilon);

    // Tables borrow from their bodies, so the array must not move once it is being filled.
    size_t most = 1 + 2 * BODIES_MAX;
    out->bodies = mem_zalloc(most * sizeof *out->bodies);
    out->body_count = 1; // the main body is made last: it takes the scene's leaves over
    add_bodies(out, BODY_BACKGROUND, &b, options, &b.scene.backgrounds);
    add_bodies(out, BODY_HIGHLIGHT, &b, options, &b.scene.highlights);
    if (!builder_cancelled(&b))
        body_build(&out->bodies[0], BODY_MAIN, &b, options, &b.scene.root, 1, &out->bounds);
    if (options->before && !builder_cancelled(&b))
        model_inherit(out, options->before);
    count_stats(out, &b);
    out->imports = builder_take_imports(&b, &out->import_count);

    if (!builder_cancelled(&b)) {
        store_forget(store);
        store_sweep(store);
    }
    scene_free(&b.scene);
    polygon_cutter_delete(b.cutter);
    free(b.folder);
}

void model_free(struct model *m)
{
    for (uint32_t i = 0; i < m->body_count; i++)
        body_free(&m->bodies[i]);
    free(m->bodies);
    for (uint32_t i = 0; i < m->import_count; i++)
        free(m->imports[i]);
    free(m->imports);
    free(m->file);
    if (m->store)
        store_leave(m->store);
    *m = (struct model){0};
}
