// roi.h - regions of interest: the box in which a leaf can change the result.
//
// Section 5.2 of Zanni, Claux, Lefebvre 2018: a subtrahend matters only where its minuend is,
// operands of an intersection only where all of them are.
#pragma once
#include "base/vec.h"
#include "hcsg/expr.h"

// Fills roi[leaf] from the boxes of the leaves, iterated to a fixed point; an empty box means that
// the leaf cannot matter; `roi` may be `leaf_box`. Conservative: never smaller than the true
// region.
void roi_build(struct box *roi, const struct expr *e, const struct box *leaf_box);

// How far beyond its region a leaf is kept when it is cut to it: where it only touches another leaf
// it still has its face.
static inline double roi_margin(double epsilon)
{
    return 16 * epsilon;
}
