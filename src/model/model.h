// model.h - what there is to draw: solids, placed leaves and expressions over them.
#pragma once
#include "base/error.h"
#include "geom/solid.h"
#include "hcsg/discovery.h"
#include "hcsg/roi.h"

#include <stdatomic.h>

struct csg_tree;

struct leaf {
    const struct solid *solid; // owned by the model's store
    struct affine to_world;
    struct affine to_local; // its inverse; leaves are never singular
    bool mirrored;          // determinant of to_world is negative
    float colour[4];        // a component below 0 is not set: the scheme's colour stands in
    bool flat;              // the plate of a flat shape
    bool subtracted;        // drawn in the scheme's cut colour when it has none of its own: stands
                            // under an odd number of subtractions
    bool highlighted;       // THROWN_TOGETHER: shown as what is marked #
    uint32_t grid;          // RENDER: 1 + number of the body's grids, 0: not known
    struct place place;     // of the node in the file
    struct box box;         // in the world
};

// What of a model there is to see.
enum model_mode {
    MODEL_PREVIEW,         // the solid picture, with colours, background objects and highlights
    MODEL_RENDER,          // the geometry: one object without colours, flat or solid
    MODEL_THROWN_TOGETHER, // each shape that takes part, whole
};

enum body_kind { BODY_MAIN, BODY_BACKGROUND, BODY_HIGHLIGHT };

// Leaves and one expression over them, drawn on its own. Leaf numbers are those of the file's
// order: of two surfaces at the same depth the higher number shows.
struct body {
    enum body_kind kind;
    struct leaf *leaves;
    uint32_t leaf_count;
    struct expr expr; // without the leaves that cannot matter
    // With them, of bodies that can be seen through: OpenSCAD's products depend on them. Without
    // nodes where it is the same.
    struct expr whole;
    struct sharing sharing;
    bool part;       // of the model: the main body, and what a # took out of it
    bool borders;    // of faces in one plane that of a subtracted leaf shows where the place is not
                     // solid with all borders of leaves, else another one: OpenSCAD's geometry
    struct box *roi; // per leaf
    // From a leaf to the coordinates in which it meets others first: there OpenSCAD's geometry puts
    // its corners onto a grid.
    struct affine *grids;
    struct discovery *table;
};

struct model_stats {
    uint32_t nodes, leaves, solids, triangles, unsupported;
};

struct model {
    enum model_mode mode;
    bool single;                // RENDER: nothing was united, cut or intersected
    const struct outline *flat; // RENDER: the shape that the model is; NULL for solids
    struct body *bodies;        // in drawing order: main first, then backgrounds, then highlights
    uint32_t body_count;
    struct box bounds; // of the intersected leaves of all bodies, for --viewall as OpenSCAD does it
    struct model_stats stats;
    struct solid_store *store;
    char *file;     // its name in the places of leaves
    char **imports; // paths of the files it wants to be made from, also of those that are missing
    uint32_t import_count;
};

struct model_options {
    enum model_mode mode;
    bool united;     // RENDER: a single shape counts as made of several
    double epsilon;  // filter in mm across the faces; negative: the default for the model's extent
    bool share, roi; // value sharing and regions of interest; true unless the bench compares
    // Where imported files are looked for that are not beside the .csg.
    const char *const *import_folders;
    uint32_t import_folder_count;
    // NULL, or the model that this one takes the place of: what is known of combinations stays
    // known where they are the same. It may be drawn meanwhile.
    const struct model *before;
    // NULL, or once true the rest is skipped: what comes out can only be freed.
    const atomic_bool *cancelled;
};
#define MODEL_DEFAULTS ((struct model_options){.epsilon = -1, .share = true, .roi = true})

// Never fails: what cannot be drawn is left out with a message. `store` keeps solids from reload to
// reload (made with solid_store_new, shared by reference); the model holds a reference of its own.
void model_build(struct model *out, const struct csg_tree *tree, struct solid_store *store,
                 const struct model_options *options, struct messages *messages);
void model_free(struct model *m);                          // leaves {0}
double model_epsilon(const struct model *m, double asked); // the filter that holds, in mm

struct solid_store *solid_store_new(void);
void solid_store_delete(struct solid_store *s); // gives up the caller's reference
