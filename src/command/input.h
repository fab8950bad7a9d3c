// input.h - the tree of the input file, read from a .csg or exported by openscad from a .scad.
#pragma once
#include "command/request.h"
#include "csg/csg.h"
#include "scad/openscad.h"

struct input { // {0} is valid
    struct csg_tree tree;
    struct scad_result scad; // empty for a .csg
};

// Prints what openscad says.
bool input_read(struct input *out, const struct request *r, struct messages *messages);
void input_free(struct input *in); // leaves {0}
