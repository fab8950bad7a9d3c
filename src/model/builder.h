// builder.h - what the parts of a model under construction share.
#pragma once
#include "csg/csg.h"
#include "geom/polygon.h"
#include "geom/primitives.h"
#include "model/model.h"
#include "model/store.h"
#include "model/term.h"

struct job { // a node to be evaluated
    const struct csg_node *node;
    struct detail detail;
    uint64_t key; // in the store
};

struct builder {
    const struct csg_tree *tree;
    const struct model_options *options;
    const char *file; // in messages
    char *folder;     // of the file, where imports are looked for first
    struct solid_store *store;
    struct messages *messages;
    struct polygon_cutter *cutter;
    struct scene scene;
    uint32_t unsupported; // nodes left out, unknown ones too
    struct {              // of the newest warning about one
        const char *name;
        uint32_t line;
    } warned;
    // While true nothing is made but a list of the nodes that have to be evaluated.
    bool collecting;
    struct job *jobs;
    uint32_t job_count, job_room;
    struct import *imports; // import.c
    uint32_t import_count, import_room;
};

static inline bool builder_cancelled(const struct builder *b)
{
    const atomic_bool *cancelled = b->options->cancelled;
    return cancelled && atomic_load_explicit(cancelled, memory_order_relaxed);
}

static inline struct place builder_place(const struct builder *b, const struct csg_node *n)
{
    return (struct place){b->file, n->line, n->column};
}

#define builder_warn(b, node, ...)                                                                 \
    messages_add((b)->messages, MESSAGE_WARNING, builder_place((b), (node)), __VA_ARGS__)

// import.c: the paths that the model is made from.
void builder_note_import(struct builder *b, const char *path);
char **builder_take_imports(struct builder *b, uint32_t *count); // the caller's to free

// walk.c: fills b->scene from the tree.
void builder_walk(struct builder *b);
// The first node marked with ! in the order of the file, NULL without one.
const struct csg_node *builder_root(struct builder *b);

// whole.c: fills b->scene with the one object that the whole file evaluates to: solids of one term,
// or the plate of a flat shape pressed flat.
void builder_evaluate(struct builder *b);

// body.c: one body of the given terms in union. The main body takes the leaves of the scene.
void body_build(struct body *out, enum body_kind kind, struct builder *b,
                const struct model_options *options, const uint32_t *terms, uint32_t term_count,
                struct box *intersected);
void body_free(struct body *body);

// inherit.c: once the bodies are there, and before they are drawn.
void model_inherit(struct model *m, const struct model *before);
