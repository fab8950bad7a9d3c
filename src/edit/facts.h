// facts.h - what there is to say about the nodes of a file: for a tree on the screen, and for a
// click on the picture. Nodes have the numbers of struct source.
#pragma once
#include "edit/edit.h"
#include "model/model.h"

struct node_facts {
    uint32_t leaves;       // placed shapes that come from it or from below
    uint32_t combinations; // known ones in which one of them takes part; once counted
    uint64_t crossings;    // of rays with their faces; once added
    float colour[4]; // of all of them, as in struct leaf; without leaves or of several: not set
    bool several;    // colours
    bool open;       // a mesh of it or below has holes; once looked for
};

struct hole { // in the mesh of a node
    uint32_t node;
    struct vec3 middle; // of the edges around it, in the world
};

struct facts {                // {0} is valid: of nothing
    struct node_facts *nodes; // per node
    uint32_t node_count;
    uint32_t **node_of_leaf; // per body and leaf; SOURCE_NONE: not from this file
    uint32_t body_count;
    struct hole *holes; // one of each node that has some, in the order of the file
    uint32_t hole_count;
};

// Of a model that was built from the source's tree, or from one with changes.
void facts_make(struct facts *out, const struct source *s, const struct model *m);
void facts_free(struct facts *f); // leaves {0}

// On demand, as these take longer; each replaces what was counted before. Combinations are those
// known by now. `crossings[leaf]` is of one body (render/cost.h), added to what is there.
void facts_count_combinations(struct facts *f, const struct source *s, const struct model *m);
void facts_clear_crossings(struct facts *f);
void facts_add_crossings(struct facts *f, const struct source *s, uint32_t body,
                         const uint64_t *crossings, uint32_t leaf_count);
void facts_find_holes(struct facts *f, const struct source *s, const struct model *m);

// What bounds a face of a subtracted leaf: the nearest difference above the leaf's node that has it
// behind its first child. False when there is none.
struct cut {
    uint32_t difference, tool; // the node, and its child that cuts here
    uint32_t target;           // its first child, which is cut; SOURCE_NONE without one
};
bool facts_cut(const struct edit *e, uint32_t node, struct cut *out);

// A node in one line as it is now, "cube(size = [1, 2, 3], center = true)", cut to the size.
void facts_line(const struct edit *e, uint32_t node, char *out, size_t size);
// What a scalar is, "size[1]".
void facts_label(const struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar, char *out,
                 size_t size);
