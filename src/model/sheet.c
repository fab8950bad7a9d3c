// sheet.c - matrices that press a shape flat, made invertible.
#include "model/sheet.h"

static struct vec3 column(const struct affine *a, int j)
{
    return (struct vec3){a->m[0][j], a->m[1][j], a->m[2][j]};
}

bool sheet_is_flat(const struct affine *a)
{
    double volume =
        vec3_length(column(a, 0)) * vec3_length(column(a, 1)) * vec3_length(column(a, 2));
    return !(fabs(affine_determinant(a)) > 1e-5 * volume);
}

// One-sided Jacobi: turns the columns of u against each other until they are orthogonal, v along.
static void orthogonalise(struct vec3 u[3], struct vec3 v[3])
{
    for (int sweep = 0; sweep < 30; sweep++) {
        bool done = true;
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                double aa = vec3_dot(u[p], u[p]), bb = vec3_dot(u[q], u[q]);
                double ab = vec3_dot(u[p], u[q]);
                if (fabs(ab) <= 1e-15 * sqrt(aa * bb))
                    continue;
                done = false;
                double tau = (bb - aa) / (2 * ab);
                double t = copysign(1 / (fabs(tau) + sqrt(1 + tau * tau)), tau);
                double c = 1 / sqrt(1 + t * t), s = c * t;
                for (int k = 0; k < 2; k++) {
                    struct vec3 *w = k ? v : u, a = w[p], b = w[q];
                    w[p] = vec3_sub(vec3_scale(a, c), vec3_scale(b, s));
                    w[q] = vec3_add(vec3_scale(a, s), vec3_scale(b, c));
                }
            }
        if (done)
            return;
    }
}

static double extent(double low, double high)
{
    return high > low ? high - low : 1; // a flat mesh has no own extent to keep
}

bool sheet_thicken(struct affine *a, struct box local, double thickness)
{
    double width[3] = {extent(local.min.x, local.max.x), extent(local.min.y, local.max.y),
                       extent(local.min.z, local.max.z)};
    struct vec3 u[3], v[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int j = 0; j < 3; j++)
        u[j] = vec3_scale(column(a, j), width[j]); // singular values in mm
    orthogonalise(u, v);

    int thin = 0, thick = 0;
    for (int j = 1; j < 3; j++) {
        if (vec3_length(u[j]) < vec3_length(u[thin]))
            thin = j;
        if (vec3_length(u[j]) >= vec3_length(u[thick]))
            thick = j;
    }
    int middle = 3 - thin - thick;
    double largest = vec3_length(u[thick]);
    if (thin == thick || !(largest > 1e-30) || vec3_length(u[middle]) <= 1e-6 * largest)
        return false;

    // The part of the map along the thin direction is replaced by one of the wanted length.
    struct vec3 normal = vec3_normalized(vec3_cross(u[thick], u[middle]));
    double now = vec3_dot(u[thin], normal);
    if (fabs(now) >= thickness)
        return true;
    struct vec3 grown = vec3_scale(normal, copysign(thickness, now) - now);
    double along[3] = {v[thin].x / width[0], v[thin].y / width[1], v[thin].z / width[2]};
    struct vec3 centre = vec3_scale(vec3_add(local.min, local.max), 0.5);
    double at_centre = along[0] * centre.x + along[1] * centre.y + along[2] * centre.z;
    const double g[3] = {grown.x, grown.y, grown.z};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            a->m[i][j] += g[i] * along[j];
        a->m[i][3] -= g[i] * at_centre;
    }
    return true;
}
