// nodes.h - what the names of nodes mean.
#pragma once
#include "model/args.h"

enum node_kind {
    NODE_UNKNOWN,
    NODE_OPERATION,   // union, difference, intersection of the children
    NODE_TRANSFORM,   // moves its children
    NODE_COLOUR,      // colours its children
    NODE_RENDER,      // union whose parts' colours are lost
    NODE_SHAPE,       // a solid
    NODE_ASSIGNMENT,  // $fn = 8;
    NODE_UNSUPPORTED, // known, not drawn yet
};

struct node_type {
    const char *name;
    enum node_kind kind;
    enum term_op operation;
    const struct parameters *parameters; // NULL: arguments have no meaning
    // TRANSFORM: the matrix of its arguments.
    void (*transform)(struct builder *b, const struct args *args, struct affine *out);
    // SHAPE: the solid and where it stands in the node's coordinates; NULL is the empty set.
    const struct solid *(*shape)(struct builder *b, const struct args *args, struct affine *out);
};

// NODE_UNKNOWN's row for names that OpenSCAD does not know.
const struct node_type *node_type_of(const char *name);

// transforms.c
extern const struct parameters parameters_vector, parameters_rotate, parameters_multmatrix;
void transform_translate(struct builder *b, const struct args *args, struct affine *out);
void transform_rotate(struct builder *b, const struct args *args, struct affine *out);
void transform_scale(struct builder *b, const struct args *args, struct affine *out);
void transform_mirror(struct builder *b, const struct args *args, struct affine *out);
void transform_multmatrix(struct builder *b, const struct args *args, struct affine *out);

// colours.c
extern const struct parameters parameters_colour;
void colour_of(struct builder *b, const struct args *args, float out[4]);

// shapes.c, polyhedron.c, import.c
extern const struct parameters parameters_cube, parameters_sphere, parameters_cylinder;
extern const struct parameters parameters_polyhedron, parameters_import;
const struct solid *shape_cube(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_sphere(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_cylinder(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_polyhedron(struct builder *b, const struct args *args,
                                     struct affine *out);
const struct solid *shape_import(struct builder *b, const struct args *args, struct affine *out);
