// input.h - the tree of the input file, read from a .csg or exported by openscad from a .scad.
#pragma once
#include "command/request.h"
#include "command/scad_view.h"
#include "csg/csg.h"

struct input { // {0} is valid
    struct csg_tree tree;
    // Of a .scad:
    struct scad_result scad;
    struct scad_view *views; // of each frame
    char *frame_name;        // of the text of the frame in messages
};

// Runs openscad on a .scad, and prints what it says.
bool input_open(struct input *out, const struct request *r, struct messages *messages);
// Fills the tree, of one frame of an animation.
bool input_read(struct input *in, const struct request *r, uint32_t frame,
                struct messages *messages);
void input_free(struct input *in); // leaves {0}
