// evaluate.h - nodes that OpenSCAD evaluates as one object, with all below them.
#pragma once
#include "model/args.h"
#include "model/geometry.h"

// The geometry of a node under the given $fn, $fa, $fs: out of the store, or made and put there.
// While b->collecting it is only noted for evaluate_collected, and NULL comes back.
const struct geometry *evaluate_node(struct builder *b, const struct csg_node *n, struct detail d);

// What a node evaluates to, made anew; told as evaluate_node tells it. False when it was cancelled.
bool evaluate_once(struct builder *b, const struct csg_node *n, struct geometry *out);

// Would the node be a flat shape? Told by the first leaf of it that is anything.
bool evaluates_flat(const struct csg_node *n);

// Makes all that was noted, on all processors.
void evaluate_collected(struct builder *b);
