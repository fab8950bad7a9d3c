// mesh_tree.h - a tree of boxes over the triangles of a mesh, in the mesh's own coordinates.
#pragma once
#include "geom/solid.h"

#include <stddef.h>

struct mesh_node {
    struct box box;
    uint32_t first; // of its triangles in `order`, or of its two children
    uint32_t count; // of triangles; 0: it has children
};

struct mesh_tree {
    struct mesh_node *nodes; // the root is nodes[0]
    uint32_t node_count;
    uint32_t *order;
    size_t bytes;
};

void mesh_tree_build(struct mesh_tree *out, const struct mesh *m);
void mesh_tree_free(struct mesh_tree *t); // leaves {0}
