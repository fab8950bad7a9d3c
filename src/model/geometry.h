// geometry.h - what a node is that OpenSCAD evaluates as one object: a flat shape, or solids with
// the operations between them.
#pragma once
#include "base/error.h"
#include "geom/outline.h"
#include "model/term.h"

enum geometry_kind {
    GEOMETRY_NONE, // no object at all, as group() without children: has no dimension
    GEOMETRY_FLAT, // may be empty, as GEOMETRY_SOLID
    GEOMETRY_SOLID,
};

struct geometry { // {0} is none
    enum geometry_kind kind;
    struct outline outline;    // FLAT
    const struct solid *plate; // FLAT: what the preview shows of it, NULL when it is empty
    struct scene scene;        // SOLID: unmarked leaves and terms
    uint32_t root;             // SOLID: of the scene's terms
    // What making it brought up, to be said again when it is used again.
    struct messages messages;
    uint32_t line;  // of the node that the messages are about
    char **imports; // paths
    uint32_t import_count, import_room;
    uint32_t unsupported;
};

void geometry_free(struct geometry *g); // leaves {0}
