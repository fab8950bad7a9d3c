// layers.h - the order in which OpenSCAD draws bodies that can be seen through.
//
// OpenSCAD draws product after product, in the order of the file. Each shows its nearest surface
// where that lies in front of what was drawn before, mixed with it, and hides what comes later and
// lies behind it. A product that is one see-through leaf shows its back faces first, then its front
// faces. Where nothing can be seen through the order does not matter, so opaque products that
// follow each other are one layer.
//
// The faces of a product of several leaves are drawn where the depth buffer holds just their depth.
// So they are drawn once more where an earlier product left a face of the same leaf there, be it
// part of this product's surface or not.
//
// Of shapes thrown together each is drawn for itself: the model's without their back faces, those
// of other bodies face by face.
#pragma once
#include "render/shade.h"

#define TWIN_NONE UINT32_MAX // of leaves that stand in no see-through product of several

// A leaf in a see-through product of several.
struct factor {
    uint32_t twin; // a number that leaves of one solid in one place have in common
    uint32_t leaf; // in the layer
    bool cut;      // only its back faces are drawn
};

struct layer {
    struct body body;       // with copies of the leaves that stand in it
    uint32_t *leaf_of;      // per leaf of it: number in the body that is drawn
    bool see_through;       // false: all it shows is opaque
    bool both_sides;        // what stands alone, whose back faces show, too
    bool in_turn;           // both_sides: faces by their numbers; else the back faces first
    struct factor *members; // sorted by twin; of see-through layers of several leaves
    bool repeats;           // a member was drawn before
};

struct body_layers {
    struct layer *items;
    uint32_t count;
    uint32_t *twin_of; // per leaf of the body; NULL where there are no members
};

struct layers {
    struct body_layers *bodies; // per body of the model; opaque ones have no layers
    uint32_t body_count;
    bool repeat; // a layer does
};

struct layers *layers_new(const struct shader *shader); // borrows the model's solids
// Of shapes thrown together, where the near plane may be inside of some: these apart, so that their
// far sides show. NULL anywhere else.
struct layers *layers_around(const struct shader *shader, const struct rays *rays);
void layers_delete(struct layers *l); // accepts NULL
