// normals.h - which way the faces of a model's leaves look.
#pragma once
#include "model/model.h"

// Made once for a model, which is borrowed. {0} is that of an empty model.
struct normals {
    struct face_normals *meshes; // sorted by solid
    uint32_t mesh_count;
};

void normals_init(struct normals *out, const struct model *m);
void normals_free(struct normals *n); // leaves {0}

// Unit vector of the world, out of the leaf's solid; zero when the face has no area.
struct vec3 normals_find(const struct normals *n, const struct leaf *leaf, uint32_t face);
