// transforms.c - the matrices of translate, rotate, scale, mirror and multmatrix.
#include "base/angle.h"
#include "model/nodes.h"

const struct parameters parameters_vector = {{"v"}, 1};
const struct parameters parameters_rotate = {{"a", "v"}, 2};
const struct parameters parameters_multmatrix = {{"m"}, 1};

static bool all_finite(const double *v, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (!isfinite(v[i]))
            return false;
    return true;
}

static void warn_argument(struct builder *b, const struct args *args, const char *expected)
{
    builder_warn(b, args->node, "%s() needs %s; has no effect", args->node->name, expected);
}

void transform_translate(struct builder *b, const struct args *args, struct affine *out)
{
    double v[3] = {0};
    *out = AFFINE_IDENTITY;
    if (!value_numbers(args->values[0], v, 2, 3) || !all_finite(v, 3)) {
        warn_argument(b, args, "a vector of 2 or 3 finite numbers");
        return;
    }
    for (int i = 0; i < 3; i++)
        out->m[i][3] = v[i];
}

void transform_scale(struct builder *b, const struct args *args, struct affine *out)
{
    double v[3] = {1, 1, 1};
    *out = AFFINE_IDENTITY;
    if (value_number(args->values[0], &v[0]))
        v[1] = v[2] = v[0];
    else if (!value_numbers(args->values[0], v, 2, 3))
        warn_argument(b, args, "a number or a vector of 2 or 3 numbers");
    for (int i = 0; i < 3; i++)
        out->m[i][i] = v[i];
}

void transform_mirror(struct builder *b, const struct args *args, struct affine *out)
{
    double v[3] = {0};
    *out = AFFINE_IDENTITY;
    if (!value_numbers(args->values[0], v, 2, 3)) {
        warn_argument(b, args, "a vector of 2 or 3 numbers");
        return;
    }
    double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (!(square > 0))
        return;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->m[i][j] -= 2 * v[i] * v[j] / square; // exact for diagonals
}

static struct affine rotation_about(struct vec3 axis, double degrees)
{
    double c = cos_degrees(degrees), s = sin_degrees(degrees), t = 1 - c;
    struct vec3 u = axis;
    return (struct affine){{
        {t * u.x * u.x + c, t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y, 0},
        {t * u.x * u.y + s * u.z, t * u.y * u.y + c, t * u.y * u.z - s * u.x, 0},
        {t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, t * u.z * u.z + c, 0},
    }};
}

void transform_rotate(struct builder *b, const struct args *args, struct affine *out)
{
    double angle, v[3] = {0};
    *out = AFFINE_IDENTITY;
    if (value_number(args->values[0], &angle)) {
        struct vec3 axis = {0, 0, 1};
        if (value_numbers(args->values[1], v, 2, 3))
            axis = vec3_normalized((struct vec3){v[0], v[1], v[2]});
        else if (args->values[1] && args->values[1]->kind != CSG_UNDEF)
            builder_warn(b, args->node, "rotate() needs a vector of numbers as axis; z is taken");
        if (axis.x != 0 || axis.y != 0 || axis.z != 0)
            *out = rotation_about(axis, angle);
        return;
    }
    if (!value_numbers(args->values[0], v, 1, 3)) {
        warn_argument(b, args, "a number or a vector of up to 3 numbers");
        return;
    }
    struct affine x = rotation_about((struct vec3){1, 0, 0}, v[0]);
    struct affine y = rotation_about((struct vec3){0, 1, 0}, v[1]);
    struct affine z = rotation_about((struct vec3){0, 0, 1}, v[2]);
    struct affine yx = affine_mul(&y, &x);
    *out = affine_mul(&z, &yx);
}

void transform_multmatrix(struct builder *b, const struct args *args, struct affine *out)
{
    const struct csg_value *m = args->values[0];
    *out = AFFINE_IDENTITY;
    if (!value_is_vector(m)) {
        warn_argument(b, args, "a matrix");
        return;
    }
    double w = 1;
    for (uint32_t i = 0; i < 4 && i < m->count; i++) {
        struct csg_value hold, element;
        const struct csg_value *row = value_item(m, i, &hold);
        if (!value_is_vector(row))
            continue;
        for (uint32_t j = 0; j < 4 && j < row->count; j++)
            if (i < 3)
                value_number(value_item(row, j, &element), &out->m[i][j]);
            else if (j == 3)
                value_number(value_item(row, j, &element), &w);
    }
    if (w != 1)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 4; j++)
                out->m[i][j] /= w;
}
