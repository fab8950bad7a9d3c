// products.h - which shapes take part in the sum of products that OpenSCAD makes of a term.
//
// OpenSCAD multiplies a tree of operations out into products of intersected and subtracted shapes,
// and drops what cannot matter by its bounding boxes. Its view "thrown together" shows each shape
// that is left once, in the role in which it comes first.
#pragma once
#include "model/term.h"

enum part_role { PART_ABSENT, PART_INTERSECTED, PART_SUBTRACTED };

struct part {
    uint32_t term; // a leaf, or what render() or an evaluated node made
    enum part_role role;
    bool highlighted; // it or what it stands in was marked #
};

// The parts of the term in the order of the file, absent ones left out. *parts is the caller's to
// free. Where the sum is too long to be made, parts that did not come up in its beginning are there
// in the role of their place in the tree.
void products_parts(const struct scene *s, uint32_t term, struct part **parts, uint32_t *count);
