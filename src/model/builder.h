// builder.h - what the parts of a model under construction share.
#pragma once
#include "csg/csg.h"
#include "geom/polygon.h"
#include "geom/primitives.h"
#include "model/model.h"
#include "model/store.h"
#include "model/term.h"

struct builder {
    const struct csg_tree *tree;
    const char *file; // in messages
    char *folder;     // of the file, where imports are looked for
    struct solid_store *store;
    struct messages *messages;
    struct polygon_cutter *cutter;
    struct scene scene;
    uint32_t unsupported;
    const atomic_bool *cancelled; // of the options
    struct {
        char *path;
        const struct solid *solid; // NULL: could not be read
    } * imports;
    uint32_t import_count, import_room;
};

static inline bool builder_cancelled(const struct builder *b)
{
    return b->cancelled && atomic_load_explicit(b->cancelled, memory_order_relaxed);
}

static inline struct place builder_place(const struct builder *b, const struct csg_node *n)
{
    return (struct place){b->file, n->line, n->column};
}

#define builder_warn(b, node, ...)                                                                 \
    messages_add((b)->messages, MESSAGE_WARNING, builder_place((b), (node)), __VA_ARGS__)

// walk.c: fills b->scene from the tree.
void builder_walk(struct builder *b);

// body.c: one body of the given terms in union. The main body takes the leaves of the scene.
void body_build(struct body *out, enum body_kind kind, struct builder *b,
                const struct model_options *options, const uint32_t *terms, uint32_t term_count,
                struct box *intersected);
void body_free(struct body *body);
