// products.h - an expression as a sum of products, in the order in which OpenSCAD draws them.
//
// A product is an intersection of leaves minus leaves. OpenSCAD multiplies its trees out with the
// rules of Goldfeather, Molnar, Turk, Fuchs: Near real-time CSG rendering using tree normalization
// and geometric pruning (1989): x - (y + z) = (x - y) - z, x - y * z = (x - y) + (x - z),
// x - (y - z) = (x - y) + x * z, and so on. Of the factors of a product the alternatives of the
// last one change slowest.
#pragma once
#include "base/vec.h"
#include "hcsg/expr.h"

struct product {
    uint32_t first;      // in products.leaves: what is intersected, then what is subtracted
    uint32_t added, cut; // how many of both
};

struct products { // {0} is valid
    struct product *items;
    uint32_t count;
    uint32_t *leaves;
};

// The products of the subtree of a node. By the boxes of the leaves, products that are empty are
// left out, and so are subtrahends that touch nothing. False, and *out is not touched, when that
// takes more than `most` leaves, counted with all intermediate products.
bool products_build(struct products *out, const struct expr *e, uint32_t node,
                    const struct box *leaf_box, uint32_t most);
void products_free(struct products *p); // leaves {0}
