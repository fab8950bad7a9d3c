// scene.h - what of a body the shaders read: its solids, each once, and its leaves.
#pragma once
#include "model/model.h"
#include "render/gl/buffer.h"

// Solids, each once; shared by scenes that need no others, so that what is edited leaves the meshes
// where they are.
struct gl_solids {
    struct gl_buffer vertices, triangles, planes, faces;
    struct gl_solid *entries; // in the order of addresses
    uint32_t count;
    uint32_t references;
};

struct gl_scene { // {0} is valid: nothing uploaded
    struct gl_solids *solids;
    struct gl_buffer leaves, values; // per leaf
    uint32_t leaf_count;
    uint32_t *flags;   // per leaf
    uint64_t renewals; // of the values that are there: discovery_renewals
    bool windings;     // there are leaves with LEAF_WINDING
};

// Inside of the context. False when there is no room. Without `solids` of another scene, which have
// to be all that the body needs (gl_solids_suffice), they are uploaded too.
bool gl_scene_upload(struct gl_scene *s, struct gl_memory *memory, const struct body *body,
                     struct gl_solids *solids, struct error *err);
// Brings the values of the leaves in line with those of their classes.
void gl_scene_renew(struct gl_scene *s, const struct body *body);
void gl_scene_free(struct gl_scene *s); // leaves {0}

bool gl_solids_suffice(const struct gl_solids *s, const struct body *body); // NULL: no
