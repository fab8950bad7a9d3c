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

// Made once for the main body of a model, which is borrowed. {0} is that of an empty model.
struct facing {
    bool *inwards;               // per leaf: it is cut out of the shape that it stands in
    struct face_corners *meshes; // sorted by solid
    uint32_t mesh_count;
};
void facing_init(struct facing *out, const struct model *m);
void facing_free(struct facing *f); // leaves {0}

// Of a leaf of that body. Faces of meshes that were turned count as they were before.
bool facing_back(const struct facing *f, const struct body *body, uint32_t leaf, uint32_t face,
                 const struct viewpoint *from);
