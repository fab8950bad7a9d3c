// nodes.c - what the names of nodes mean.
#include "model/nodes.h"

#include <stdlib.h>
#include <string.h>

static const struct parameters parameters_render = {{"convexity"}, 1};

#define OPERATION(what) .kind = NODE_OPERATION, .operation = (what)
#define TRANSFORM(which, params)                                                                   \
    .kind = NODE_TRANSFORM, .operation = TERM_UNION, .parameters = &(params),                      \
    .transform = transform_##which
#define SHAPE(which)                                                                               \
    .kind = NODE_SHAPE, .parameters = &parameters_##which, .shape = shape_##which,                 \
    .gives = GEOMETRY_SOLID
#define FLAT(which)                                                                                \
    .kind = NODE_FLAT, .parameters = &parameters_##which, .flat = flat_##which,                    \
    .gives = GEOMETRY_FLAT
#define IMPORT .kind = NODE_IMPORT, .parameters = &parameters_import
#define COMBINED(which)                                                                            \
    .kind = NODE_COMBINED, .parameters = &parameters_##which, .combine = combine_##which
#define UNSUPPORTED .kind = NODE_UNSUPPORTED

// In the order of strcmp.
static const struct node_type types[] = {
    {CSG_ASSIGN, .kind = NODE_ASSIGNMENT},
    {"circle", FLAT(circle)},
    {"color", .kind = NODE_COLOUR, .operation = TERM_UNION, .parameters = &parameters_colour},
    {"cube", SHAPE(cube)},
    {"cylinder", SHAPE(cylinder)},
    {"difference", OPERATION(TERM_DIFFERENCE)},
    {"dxf_linear_extrude", COMBINED(linear_extrude), .gives = GEOMETRY_SOLID},
    {"dxf_rotate_extrude", COMBINED(rotate_extrude), .gives = GEOMETRY_SOLID},
    {"fill", COMBINED(fill), .gives = GEOMETRY_FLAT},
    {"group", OPERATION(TERM_UNION)},
    {"hull", COMBINED(hull), .shows_marked = true},
    {"import", IMPORT},
    {"import_dxf", IMPORT},
    {"import_off", IMPORT},
    {"import_stl", IMPORT},
    {"intersection", OPERATION(TERM_INTERSECTION)},
    {"linear_extrude", COMBINED(linear_extrude), .gives = GEOMETRY_SOLID},
    {"minkowski", COMBINED(minkowski), .shows_marked = true},
    {"mirror", TRANSFORM(mirror, parameters_vector)},
    {"multmatrix", TRANSFORM(multmatrix, parameters_multmatrix)},
    {"offset", COMBINED(offset), .gives = GEOMETRY_FLAT},
    {"polygon", FLAT(polygon)},
    {"polyhedron", SHAPE(polyhedron)},
    {"projection", COMBINED(projection), .gives = GEOMETRY_FLAT},
    {"render", .kind = NODE_RENDER, .operation = TERM_UNION, .parameters = &parameters_render},
    {"resize", COMBINED(resize), .shows_marked = true},
    {"roof", UNSUPPORTED},
    {"rotate", TRANSFORM(rotate, parameters_rotate)},
    {"rotate_extrude", COMBINED(rotate_extrude), .gives = GEOMETRY_SOLID},
    {"scale", TRANSFORM(scale, parameters_vector)},
    {"sphere", SHAPE(sphere)},
    {"square", FLAT(square)},
    {"surface", SHAPE(surface)},
    {"text", FLAT(text)},
    {"translate", TRANSFORM(translate, parameters_vector)},
    {"union", OPERATION(TERM_UNION)},
};

void builder_warn_left_out(struct builder *b, const struct csg_node *n,
                           const struct node_type *type)
{
    bool known = type->kind == NODE_UNSUPPORTED;
    b->unsupported++;
    if (n->name == b->warned.name && n->line == b->warned.line)
        return;
    b->warned.name = n->name;
    b->warned.line = n->line;
    if (known)
        builder_warn(b, n, "%s() is not supported yet; left out", n->name);
    else
        builder_warn(b, n, "unknown object '%.100s'; left out", n->name);
}

bool leaf_fits(const struct leaf *leaf)
{
    static const double largest = 1e30; // far inside what 32-bit numbers hold
    struct box box = box_transformed(leaf->solid->bounds, &leaf->to_world);
    return fmin(box.min.x, fmin(box.min.y, box.min.z)) >= -largest &&
           fmax(box.max.x, fmax(box.max.y, box.max.z)) <= largest;
}

void builder_warn_too_large(struct builder *b, const struct csg_node *n)
{
    builder_warn(b, n, "%s() is too large or too far away to be drawn; left out", n->name);
}

bool builder_leaf(struct builder *b, const struct args *args, const struct node_type *type,
                  const struct affine *matrix, struct affine *place, struct leaf *out)
{
    *place = AFFINE_IDENTITY;
    const struct solid *solid = type->shape(b, args, place);
    if (!solid)
        return false;
    *out = (struct leaf){.solid = solid,
                         .to_world = affine_mul(matrix, place),
                         .colour = {-1, -1, -1, -1},
                         .place = builder_place(b, args->node)};
    if (leaf_fits(out))
        return true;
    builder_warn_too_large(b, args->node);
    return false;
}

static int compare(const void *name, const void *type)
{
    return strcmp(name, ((const struct node_type *)type)->name);
}

const struct node_type *node_type_of(const char *name)
{
    static const struct node_type unknown = {.name = "", .kind = NODE_UNKNOWN};
    const struct node_type *t = bsearch(name, types, array_count(types), sizeof types[0], compare);
    return t ? t : &unknown;
}
