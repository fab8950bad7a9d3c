// shapes.h - closed meshes from formulas, about as large as the cube from -1/2 to 1/2.
#pragma once
#include "geom/solid.h"

#include <stdbool.h>

enum shape {
    SHAPE_CUBE,
    SHAPE_SPHERE,
    SHAPE_CYLINDER,
    SHAPE_FRUSTUM,
    SHAPE_CONE,
    SHAPE_ELL,  // L-shaped prism
    SHAPE_STAR, // star-shaped prism
    SHAPE_TORUS,
    SHAPES
};

extern const char *const shape_names[SHAPES];

// `fn` of 3 or more: corners of a round outline. Returns whether the shape is convex.
bool shape_make(struct mesh *out, enum shape shape, int fn);
void shape_copy(struct mesh *out, const struct mesh *from);
void shape_free(struct mesh *m); // leaves {0}
