// evaluation.h - one node that OpenSCAD evaluates as one object, made with all below it.
#pragma once
#include "model/args.h"
#include "model/digest.h"
#include "model/geometry.h"

// Under which the store holds the geometry of a node with this digest.
uint64_t evaluation_key(uint64_t digest, struct detail d);

// Tells the builder what was to be told while the geometry was made.
void evaluation_tell(struct builder *b, const struct geometry *g);

// Fills *g with what the node evaluates to; `digests` are those of the node and all below it. False
// when it was cancelled.
bool evaluation_run(const struct builder *whole, const struct csg_node *n, struct detail d,
                    const struct digest *digests, struct geometry *g);
