// digest.h - hashes of nodes with all that stands below them.
#pragma once
#include "csg/csg.h"

struct digest {
    uint64_t hash;
    uint32_t nodes; // of the subtree, itself included
};

// Digests of a node and all below it, in the order of the file: those of a child follow its
// parent's, then come its siblings'. The caller frees them. Places and comments do not count.
struct digest *digest_tree(const struct csg_node *root);
