// nodes.h - what the names of nodes mean.
#pragma once
#include "model/combine.h"

enum node_kind {
    NODE_UNKNOWN,
    NODE_OPERATION,   // union, difference, intersection of the children
    NODE_TRANSFORM,   // moves its children
    NODE_COLOUR,      // colours its children
    NODE_RENDER,      // union whose parts' colours are lost
    NODE_SHAPE,       // a solid
    NODE_FLAT,        // a flat shape
    NODE_IMPORT,      // one of the two, as the file is
    NODE_COMBINED,    // makes one object of its children
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
    // FLAT: the outline, clean or not.
    void (*flat)(struct builder *b, const struct args *args, struct outline *out);
    // COMBINED: what the children together become.
    void (*combine)(struct operands *o, struct value *out);
    enum geometry_kind gives; // NONE: that depends on the children
    bool shows_marked;        // children marked % and # are shown beside it
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

// The warning about a node that is unknown or unsupported, counted; repeated ones of one name and
// line are said once.
void builder_warn_left_out(struct builder *b, const struct csg_node *n,
                           const struct node_type *type);

// The leaf of a SHAPE node under a matrix, without a colour; `place` is where it stands without the
// matrix. False for the empty set, and with a warning for what is too large to be drawn.
bool builder_leaf(struct builder *b, const struct args *args, const struct node_type *type,
                  const struct affine *matrix, struct affine *place, struct leaf *out);
bool leaf_fits(const struct leaf *leaf); // is it small and near enough to be drawn?
void builder_warn_too_large(struct builder *b, const struct csg_node *n);

// flats.c
extern const struct parameters parameters_square, parameters_circle, parameters_polygon,
    parameters_text;
void flat_square(struct builder *b, const struct args *args, struct outline *out);
void flat_circle(struct builder *b, const struct args *args, struct outline *out);
void flat_polygon(struct builder *b, const struct args *args, struct outline *out);
void flat_text(struct builder *b, const struct args *args, struct outline *out);

// import.c
enum { IMPORT_FILE, IMPORT_LAYER, IMPORT_CONVEXITY, IMPORT_ORIGIN, IMPORT_SCALE };
extern const struct parameters parameters_import, parameters_surface;
const struct node_type *import_type(const struct args *args); // what its file makes it
const struct node_type *import_type_of(const struct csg_node *n);
void flat_import(struct builder *b, const struct args *args, struct outline *out);
const struct solid *shape_import(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_surface(struct builder *b, const struct args *args, struct affine *out);

// shapes.c, polyhedron.c
extern const struct parameters parameters_cube, parameters_sphere, parameters_cylinder;
extern const struct parameters parameters_polyhedron;
const struct solid *shape_cube(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_sphere(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_cylinder(struct builder *b, const struct args *args, struct affine *out);
const struct solid *shape_polyhedron(struct builder *b, const struct args *args,
                                     struct affine *out);
