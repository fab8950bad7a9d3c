// random_tree.h - random solids, placements, expressions and cameras; the same for a seed
// everywhere.
#pragma once
#include "oracle.h"
#include "shapes.h"

struct random_mesh {
    struct mesh mesh;
    enum shape shape;
    int fn;
    bool convex; // as told to the device; a convex mesh may be given as a general one
};

struct random_leaf {
    uint32_t mesh;
    struct affine to_world;
};

struct random_scene {
    struct random_mesh *meshes;
    uint32_t mesh_count, mesh_capacity;
    struct random_leaf *leaves;
    uint32_t leaf_count, leaf_capacity;
    struct expr_token *tokens;
    uint32_t token_count, token_capacity;
    struct rays rays;
    double epsilon;
    bool aligned; // pixel centres lie on faces seen edge-on: silhouettes everywhere
};

void random_scene_make(struct random_scene *out, uint64_t seed);
void random_scene_free(struct random_scene *s); // leaves {0}
