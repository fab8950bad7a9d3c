// facing.h - does a face turn its back to the viewer, as it was written?
#pragma once
#include "model/model.h"
#include "render/rays.h"

// Where a picture is seen from.
struct viewpoint {
    bool orthographic;
    struct vec3 eye, ahead; // ahead: orthographic, the direction of all rays
};
struct viewpoint viewpoint_of(const struct rays *rays);

// Made once for a model, which is borrowed. {0} is that of an empty model.
struct facing {
    struct face_corners *meshes; // sorted by solid
    uint32_t mesh_count;
};
void facing_init(struct facing *out, const struct model *m);
void facing_free(struct facing *f); // leaves {0}

// Faces of meshes that were turned count as they were before.
bool facing_back(const struct facing *f, const struct leaf *leaf, uint32_t face,
                 const struct viewpoint *from);
