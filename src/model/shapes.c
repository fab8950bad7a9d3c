// shapes.c - cube, sphere and cylinder: unit solids, sized by the leaf's matrix so that many share
// one.
#include "base/hash.h"
#include "model/nodes.h"
#include "model/rounds.h"

const struct parameters parameters_cube = {{"size", "center"}, 2};
const struct parameters parameters_sphere = {{"r", "d"}, 1};
const struct parameters parameters_cylinder = {{"h", "r1", "r2", "center", "r", "d", "d1", "d2"},
                                               4};

enum { KEY_CUBE = 1, KEY_SPHERE, KEY_CYLINDER };

static uint64_t key_of(uint64_t kind, uint32_t n, double r1, double r2)
{
    double content[3] = {n, r1, r2};
    return hash_bytes(kind, content, sizeof content);
}

static struct affine scaling(double x, double y, double z)
{
    return (struct affine){{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}};
}

// Sizes that give a solid. Those of 0 and below draw nothing, as in OpenSCAD, without a word.
static bool drawable(struct builder *b, const struct args *args, double x, double y, double z)
{
    if (isfinite(x) && isfinite(y) && isfinite(z))
        return x > 0 && y > 0 && z > 0;
    builder_warn(b, args->node, "%s() has a size that is not finite; left out", args->node->name);
    return false;
}

const struct solid *shape_cube(struct builder *b, const struct args *args, struct affine *out)
{
    double s[3] = {1, 1, 1};
    const struct csg_value *size = args->values[0];
    if (value_number(size, &s[0]))
        s[1] = s[2] = s[0];
    else if (!value_numbers(size, s, 3, 3) && size)
        builder_warn(b, args->node, "cube() needs a number or 3 numbers as size; 1 is taken");
    if (!drawable(b, args, s[0], s[1], s[2]))
        return NULL;
    *out = scaling(s[0], s[1], s[2]);
    if (value_true(args->values[1]))
        for (int i = 0; i < 3; i++)
            out->m[i][3] = -s[i] / 2;

    uint64_t key = key_of(KEY_CUBE, 0, 0, 0);
    const struct solid *solid = store_find(b->store, key);
    if (solid)
        return solid;
    struct mesh m;
    primitive_cube(&m);
    return store_add(b->store, key, &m, true, CUT_FACES);
}

const struct solid *shape_sphere(struct builder *b, const struct args *args, struct affine *out)
{
    double r = 1;
    radius_of(b, args, 0, 1, &r);
    if (!drawable(b, args, r, r, r))
        return NULL;
    *out = scaling(r, r, r);
    uint32_t n = corners_around(b, args, r, SPHERE_FRAGMENTS_MAX);
    uint64_t key = key_of(KEY_SPHERE, n, 1, 1);
    const struct solid *solid = store_find(b->store, key);
    if (solid)
        return solid;
    struct mesh m;
    primitive_sphere(&m, n);
    return store_add(b->store, key, &m, true, CUT_CAPS);
}

const struct solid *shape_cylinder(struct builder *b, const struct args *args, struct affine *out)
{
    enum { H, R1, R2, CENTER, R, D, D1, D2 };
    double h = 1, r1 = 1, r2 = 1;
    value_number(args->values[H], &h);
    if (radius_of(b, args, R, D, &r1))
        r2 = r1;
    radius_of(b, args, R1, D1, &r1);
    radius_of(b, args, R2, D2, &r2);
    double r = fmax(r1, r2); // of one number and NaN it is the number
    if (!drawable(b, args, h, r1 + r2, r) || r1 < 0 || r2 < 0)
        return NULL;
    *out = scaling(r, r, h);
    if (value_true(args->values[CENTER]))
        out->m[2][3] = -h / 2;

    uint32_t n = corners_around(b, args, r, CIRCLE_FRAGMENTS_MAX);
    uint64_t key = key_of(KEY_CYLINDER, n, r1 / r, r2 / r);
    const struct solid *solid = store_find(b->store, key);
    if (solid)
        return solid;
    struct mesh m;
    primitive_cylinder(&m, n, r1 / r, r2 / r);
    return store_add(b->store, key, &m, true, r1 == r2 ? CUT_FACES : CUT_CAPS);
}
