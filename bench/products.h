// products.h - a CSG expression as a union of products, as OpenCSG wants it.
#pragma once
#include "base/vec.h"
#include "hcsg/expr.h"

// The intersection of some leaves minus some others.
struct product {
    struct box box;   // of the intersected leaves
    uint32_t *leaves; // the intersected ones first
    uint32_t intersected, count, capacity;
};

struct products { // {0} is the empty set
    struct product *items;
    uint32_t count, capacity;
};

// Goldfeather's rewriting rules; as in OpenSCAD what cannot matter by the leaves' boxes is left
// out: products with an empty box and subtracted leaves beside it.
void products_build(struct products *out, const struct expr *e, const struct box *leaf_box);
void products_free(struct products *p); // leaves {0}
