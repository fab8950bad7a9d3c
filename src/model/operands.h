// operands.h - the children of a node and what they are together.
#pragma once
#include "model/args.h"
#include "model/geometry.h"

// What one child is. The outline is owned; the term is one of the scene of the operands.
struct value {
    enum geometry_kind kind;
    struct outline outline;
    uint32_t term;
    struct affine placed; // SOLID of a single leaf: where it stands in the node's coordinates
};

// The children of a node, all flat or all solid, with those that are nothing in between.
struct operands {
    struct builder *b;
    const struct args *args;
    enum geometry_kind kind; // NONE: there is no other child
    struct value *values;
    uint32_t count;
    struct scene *scene;
    uint32_t first_leaf, first_term; // of the scene, that belong to these operands
};

void value_free(struct value *v); // leaves {0}: nothing

// A leaf whose mesh bounds no solid becomes nothing, with a warning, as OpenSCAD has it where an
// object is combined with others; alone it stays.
uint32_t closed_term(struct builder *b, uint32_t term);

// The value of a term as it is in the scene.
struct value value_of_term(const struct scene *s, uint32_t term);

// Folds the operands by an operation of CSG. Like all below it takes what it needs out of them.
void operands_fold(struct operands *o, enum term_op op, struct value *out);
// Moves the leaves of the operands.
void operands_move(struct operands *o, const struct affine *a);
// Moves a flat value as OpenSCAD does: a matrix without area makes it empty, with a warning.
void value_place(struct builder *b, const struct csg_node *n, struct value *v,
                 const struct affine *a);
// The mesh of a term, evaluated where it is no single leaf. False with a warning when it cannot be.
bool operands_mesh(struct operands *o, uint32_t term, struct mesh *out);
// The meshes whose union a term is: leaves where they are, other operations evaluated.
struct mesh_parts { // {0} is empty
    struct solid *items;
    uint32_t count, room;
};
bool operands_parts(struct operands *o, uint32_t term, struct mesh_parts *out);
void mesh_parts_add(struct mesh_parts *p, struct mesh *m, bool convex); // takes the mesh over
void mesh_parts_free(struct mesh_parts *p);                             // leaves {0}
// Points whose hull and whose box are those of a term; added to the list.
struct point_list { // {0} is empty; items are the caller's to free
    struct vec3 *items;
    uint32_t count, room;
};
bool operands_points(struct operands *o, uint32_t term, struct point_list *out);
// Replaces all leaves and terms of the operands by one leaf of the given solid, or nothing for
// NULL.
void operands_become(struct operands *o, const struct solid *solid, struct value *out);
// Adds a leaf to what they have become.
void operands_add(struct operands *o, const struct solid *solid, struct value *out);
