// vec.h - vectors, affine maps and boxes in double precision.
#pragma once
#include <math.h>
#include <stdbool.h>

struct vec2 {
    double x, y;
};

struct vec3 {
    double x, y, z;
};

static inline struct vec3 vec3_add(struct vec3 a, struct vec3 b)
{
    return (struct vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline struct vec3 vec3_sub(struct vec3 a, struct vec3 b)
{
    return (struct vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline struct vec3 vec3_scale(struct vec3 a, double s)
{
    return (struct vec3){a.x * s, a.y * s, a.z * s};
}
static inline double vec3_dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline struct vec3 vec3_cross(struct vec3 a, struct vec3 b)
{
    return (struct vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double vec3_length(struct vec3 a)
{
    return sqrt(vec3_dot(a, a));
}
static inline struct vec3 vec3_normalized(struct vec3 a) // the zero vector stays zero
{
    double l = vec3_length(a);
    return l > 0 ? vec3_scale(a, 1 / l) : a;
}

// Affine map, row-major: p' = m[.][0..2] p + m[.][3].
struct affine {
    double m[3][4];
};

#define AFFINE_IDENTITY ((struct affine){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}})

static inline bool affine_is_finite(const struct affine *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!isfinite(a->m[i][j]))
                return false;
    return true;
}

static inline struct vec3 affine_point(const struct affine *a, struct vec3 p)
{
    const double(*m)[4] = a->m;
    return (struct vec3){m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
                         m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
                         m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
}
static inline struct vec3 affine_vector(const struct affine *a, struct vec3 v)
{
    const double(*m)[4] = a->m;
    return (struct vec3){m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
                         m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                         m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}
// The transposed linear part times v: with the inverse map it carries normals.
static inline struct vec3 affine_normal(const struct affine *inverse, struct vec3 v)
{
    const double(*m)[4] = inverse->m;
    return (struct vec3){m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z,
                         m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
                         m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
}
static inline struct affine affine_mul(const struct affine *a, const struct affine *b) // a after b
{
    struct affine r;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            r.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                        a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0);
    return r;
}
static inline double affine_determinant(const struct affine *a)
{
    const double(*m)[4] = a->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
// False when the map is singular (or not finite); then *out is unchanged.
static inline bool affine_inverse(const struct affine *a, struct affine *out)
{
    const double(*m)[4] = a->m;
    double det = affine_determinant(a), s = 1 / det;
    if (!isfinite(s) || !isfinite(det))
        return false;
    struct affine r;
    r.m[0][0] = s * (m[1][1] * m[2][2] - m[1][2] * m[2][1]);
    r.m[0][1] = s * (m[0][2] * m[2][1] - m[0][1] * m[2][2]);
    r.m[0][2] = s * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
    r.m[1][0] = s * (m[1][2] * m[2][0] - m[1][0] * m[2][2]);
    r.m[1][1] = s * (m[0][0] * m[2][2] - m[0][2] * m[2][0]);
    r.m[1][2] = s * (m[0][2] * m[1][0] - m[0][0] * m[1][2]);
    r.m[2][0] = s * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    r.m[2][1] = s * (m[0][1] * m[2][0] - m[0][0] * m[2][1]);
    r.m[2][2] = s * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    struct vec3 t = {m[0][3], m[1][3], m[2][3]};
    struct vec3 moved = affine_vector(&r, t);
    r.m[0][3] = -moved.x;
    r.m[1][3] = -moved.y;
    r.m[2][3] = -moved.z;
    *out = r;
    return true;
}

// Closed box; empty when min exceeds max in any axis.
struct box {
    struct vec3 min, max;
};

#define BOX_EMPTY ((struct box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}})
#define BOX_ALL   ((struct box){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}})

static inline bool box_is_empty(struct box b)
{
    return !(b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z);
}
// fmin and fmax are calls, and a box sees many points. A NaN as b does not count, as there.
static inline double box_least(double a, double b)
{
    return b < a ? b : a;
}
static inline double box_most(double a, double b)
{
    return b > a ? b : a;
}
static inline struct vec3 box_low(struct vec3 a, struct vec3 b)
{
    return (struct vec3){box_least(a.x, b.x), box_least(a.y, b.y), box_least(a.z, b.z)};
}
static inline struct vec3 box_high(struct vec3 a, struct vec3 b)
{
    return (struct vec3){box_most(a.x, b.x), box_most(a.y, b.y), box_most(a.z, b.z)};
}
static inline struct box box_of_point(struct box b, struct vec3 p) // b grown to hold p
{
    return (struct box){box_low(b.min, p), box_high(b.max, p)};
}
static inline struct box box_union(struct box a, struct box b)
{
    return (struct box){box_low(a.min, b.min), box_high(a.max, b.max)};
}
static inline struct box box_intersection(struct box a, struct box b)
{
    return (struct box){box_high(a.min, b.min), box_low(a.max, b.max)};
}
static inline struct vec3 box_corner(struct box b, int i) // i in [0, 8): bit 0 x, 1 y, 2 z
{
    return (struct vec3){i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y,
                         i & 4 ? b.max.z : b.min.z};
}
static inline struct box box_transformed(struct box b, const struct affine *a)
{
    struct box r = BOX_EMPTY;
    if (!box_is_empty(b))
        for (int i = 0; i < 8; i++)
            r = box_of_point(r, affine_point(a, box_corner(b, i)));
    return r;
}
