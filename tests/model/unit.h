// unit.h - cmocka, and models made from text.
#pragma once
#include "csg/csg.h"
#include "geom/mesh.h"
#include "model/model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A model of a text as if it stood in the file `name`.
static inline void model_of_text_as(struct model *out, enum model_mode mode, const char *name,
                                    const char *text, struct solid_store *store,
                                    struct messages *messages)
{
    size_t size = strlen(text);
    char *copy = mem_zalloc(size + 2);
    memcpy(copy, text, size);
    struct csg_tree tree;
    if (!csg_parse(&tree, name, copy, size, messages)) {
        messages_print(messages, stderr);
        fail_msg("%s does not parse", text);
    }
    struct model_options options = MODEL_DEFAULTS;
    options.mode = mode;
    model_build(out, &tree, store, &options, messages);
    csg_free(&tree);
    free(copy);
}

static inline void model_of_text(struct model *out, const char *name, const char *text,
                                 struct solid_store *store, struct messages *messages)
{
    model_of_text_as(out, MODEL_PREVIEW, name, text, store, messages);
}

// Volume of a leaf where it stands.
static inline double leaf_volume(const struct leaf *l)
{
    return mesh_volume(&l->solid->mesh) * fabs(affine_determinant(&l->to_world));
}
