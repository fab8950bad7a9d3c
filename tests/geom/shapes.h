// shapes.h - meshes to try things on.
#pragma once
#include "geom/primitives.h"
#include "unit.h"

static inline void place(struct mesh *m, struct affine to)
{
    for (uint32_t v = 0; v < m->vertex_count; v++)
        m->vertices[v] = affine_point(&to, m->vertices[v]);
}

static inline void place_sized(struct mesh *m, struct vec3 size, struct vec3 at)
{
    place(m, (struct affine){{{size.x, 0, 0, at.x}, {0, size.y, 0, at.y}, {0, 0, size.z, at.z}}});
}

static inline struct mesh block(double x, double y, double z, double a, double b, double c)
{
    struct mesh m;
    primitive_cube(&m);
    place_sized(&m, (struct vec3){a, b, c}, (struct vec3){x, y, z});
    return m;
}

static inline struct mesh ball(uint32_t n, double r, double x, double y, double z)
{
    struct mesh m;
    primitive_sphere(&m, n);
    place_sized(&m, (struct vec3){r, r, r}, (struct vec3){x, y, z});
    return m;
}

// rotate([x, y, z])
static inline struct affine rotation(double x, double y, double z)
{
    double t = acos(-1) / 180, a = x * t, b = y * t, c = z * t;
    struct affine rx = {{{1, 0, 0, 0}, {0, cos(a), -sin(a), 0}, {0, sin(a), cos(a), 0}}};
    struct affine ry = {{{cos(b), 0, sin(b), 0}, {0, 1, 0, 0}, {-sin(b), 0, cos(b), 0}}};
    struct affine rz = {{{cos(c), -sin(c), 0, 0}, {sin(c), cos(c), 0, 0}, {0, 0, 1, 0}}};
    struct affine rxy = affine_mul(&ry, &rx);
    return affine_mul(&rz, &rxy);
}
