// nodes.c - what the names of nodes mean.
#include "model/nodes.h"

#include <stdlib.h>
#include <string.h>

static const struct parameters parameters_render = {{"convexity"}, 1};

#define OPERATION(what) .kind = NODE_OPERATION, .operation = (what)
#define TRANSFORM(which, params)                                                                   \
    .kind = NODE_TRANSFORM, .operation = TERM_UNION, .parameters = &(params),                      \
    .transform = transform_##which
#define SHAPE(which) .kind = NODE_SHAPE, .parameters = &parameters_##which, .shape = shape_##which
#define UNSUPPORTED  .kind = NODE_UNSUPPORTED

// In the order of strcmp.
static const struct node_type types[] = {
    {CSG_ASSIGN, .kind = NODE_ASSIGNMENT},
    {"circle", UNSUPPORTED},
    {"color", .kind = NODE_COLOUR, .operation = TERM_UNION, .parameters = &parameters_colour},
    {"cube", SHAPE(cube)},
    {"cylinder", SHAPE(cylinder)},
    {"difference", OPERATION(TERM_DIFFERENCE)},
    {"dxf_linear_extrude", UNSUPPORTED},
    {"dxf_rotate_extrude", UNSUPPORTED},
    {"fill", UNSUPPORTED},
    {"group", OPERATION(TERM_UNION)},
    {"hull", UNSUPPORTED},
    {"import", SHAPE(import)},
    {"import_dxf", UNSUPPORTED},
    {"import_off", SHAPE(import)},
    {"import_stl", SHAPE(import)},
    {"intersection", OPERATION(TERM_INTERSECTION)},
    {"linear_extrude", UNSUPPORTED},
    {"minkowski", UNSUPPORTED},
    {"mirror", TRANSFORM(mirror, parameters_vector)},
    {"multmatrix", TRANSFORM(multmatrix, parameters_multmatrix)},
    {"offset", UNSUPPORTED},
    {"polygon", UNSUPPORTED},
    {"polyhedron", SHAPE(polyhedron)},
    {"projection", UNSUPPORTED},
    {"render", .kind = NODE_RENDER, .operation = TERM_UNION, .parameters = &parameters_render},
    {"resize", UNSUPPORTED},
    {"roof", UNSUPPORTED},
    {"rotate", TRANSFORM(rotate, parameters_rotate)},
    {"rotate_extrude", UNSUPPORTED},
    {"scale", TRANSFORM(scale, parameters_vector)},
    {"sphere", SHAPE(sphere)},
    {"square", UNSUPPORTED},
    {"surface", UNSUPPORTED},
    {"text", UNSUPPORTED},
    {"translate", TRANSFORM(translate, parameters_vector)},
    {"union", OPERATION(TERM_UNION)},
};

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
