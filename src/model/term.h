// term.h - placed shapes and the operations between them, with the marks % and #.
#pragma once
#include "model/model.h"

enum term_op { TERM_LEAF, TERM_UNION, TERM_INTERSECTION, TERM_DIFFERENCE };

#define TERM_NONE  UINT32_MAX       // no operand yet
#define TERM_EMPTY (UINT32_MAX - 1) // the empty set

struct term {
    uint8_t op;       // enum term_op
    uint8_t marks;    // CSG_BACKGROUND, CSG_HIGHLIGHT
    bool highlighted; // was marked #, whatever became of the mark
    bool taken_out;   // of a union, as it was marked #: it is part of the model all the same
    bool rendered;    // came from render(): its cut faces look like its others
    uint32_t left;    // operand; LEAF: number of the leaf
    uint32_t right;   // operand
};

struct term_list {
    uint32_t *items;
    uint32_t count, room;
};

struct scene {           // {0} is empty
    struct leaf *leaves; // what body.c adds to them is not there yet; a solid of NULL is empty
    uint32_t leaf_count, leaf_room;
    struct affine *grids; // of leaves, see struct body
    uint32_t grid_count, grid_room;
    struct term *terms;
    uint32_t term_count, term_room;
    struct box *boxes; // of the terms for which they were asked
    uint32_t box_count, box_room;
    uint32_t root; // the picture's solid part
    struct term_list backgrounds, highlights;
};

uint32_t scene_leaf(struct scene *s, const struct leaf *leaf);
void scene_grid(struct scene *s, uint32_t leaf, const struct affine *grid);
void scene_mark(struct scene *s, uint32_t term, uint8_t marks);
uint32_t scene_marks(const struct scene *s, uint32_t term);
void scene_rendered(struct scene *s, uint32_t term);

// The fold of one more operand: left is TERM_NONE before the first. Marked operands are moved to
// the lists as OpenSCAD does it; the result carries a mark when the marked object is all of it.
uint32_t scene_fold(struct scene *s, enum term_op op, uint32_t left, uint32_t right);
// Ends the fold of the top level: what still carries a mark is moved to the lists.
void scene_finish(struct scene *s, uint32_t root);
void scene_show_apart(struct scene *s, uint32_t term); // lists a marked term, takes its marks off

// Copies a term of another scene, unmarked, with all below it. Returns the copy.
uint32_t scene_add(struct scene *s, const struct scene *from, uint32_t term);

// The box that OpenSCAD prunes a term by, given those of its operands at their numbers in boxes:
// flat shapes have no thickness, a difference has the box of its left operand.
struct box term_box(const struct scene *s, uint32_t term, const struct box *boxes);

void scene_free(struct scene *s); // leaves {0}
