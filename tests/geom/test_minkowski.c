// test_minkowski.c - unions of parts hold the points of the sum, all of them and no others.
#include "base/hash.h"
#include "geom/hull.h"
#include "geom/minkowski.h"
#include "geom/primitives.h"
#include "unit.h"

// ---------------------------------------------------------------- where points are

// How far a point is above the highest of the planes around a convex solid.
static double height_above(const struct solid *s, struct vec3 p)
{
    double highest = -INFINITY;
    for (uint32_t f = 0; f < s->planes.count; f++) {
        struct vec3 n = {s->planes.nx[f], s->planes.ny[f], s->planes.nz[f]};
        highest = fmax(highest, vec3_dot(n, p) - s->planes.d[f]);
    }
    return highest;
}

// Crossings of a ray in a direction that no model prefers.
static bool mesh_holds(const struct mesh *m, struct vec3 p)
{
    struct vec3 d = {0.123, 0.4567, 0.789};
    bool inside = false;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        struct vec3 c[3];
        for (int i = 0; i < 3; i++)
            c[i] = vec3_sub(m->vertices[m->triangles[t][i]], p);
        double side[3];
        for (int i = 0; i < 3; i++)
            side[i] = vec3_dot(d, vec3_cross(c[i], c[(i + 1) % 3]));
        bool hit = (side[0] > 0) == (side[1] > 0) && (side[1] > 0) == (side[2] > 0);
        double volume = vec3_dot(c[0], vec3_cross(c[1], c[2]));
        if (hit && volume != 0 && (volume > 0) == (side[0] + side[1] + side[2] > 0))
            inside = !inside;
    }
    return inside;
}

struct parts { // a sum as solids
    struct solid *items;
    uint32_t count;
};

static struct parts take_parts(const struct solid *a, const struct solid *b)
{
    struct minkowski_sum sum;
    assert_true(minkowski_parts(&sum, a, b, 1000000, 2));
    struct parts p = {mem_alloc(sum.count * sizeof *p.items), sum.count};
    for (uint32_t i = 0; i < sum.count; i++) {
        if (sum.parts[i].convex) {
            assert_true(mesh_is_closed(&sum.parts[i].mesh));
            assert_true(mesh_volume(&sum.parts[i].mesh) > 0);
        }
        solid_from_mesh(&p.items[i], &sum.parts[i].mesh, sum.parts[i].convex, 0);
    }
    minkowski_free(&sum);
    return p;
}

static bool parts_hold(const struct parts *p, struct vec3 at)
{
    for (uint32_t i = 0; i < p->count; i++)
        if (p->items[i].convex ? height_above(&p->items[i], at) <= 1e-9
                               : mesh_holds(&p->items[i].mesh, at))
            return true;
    return false;
}

static void free_parts(struct parts *p)
{
    for (uint32_t i = 0; i < p->count; i++)
        solid_free(&p->items[i]);
    free(p->items);
}

static struct box parts_bounds(const struct parts *p)
{
    struct box b = BOX_EMPTY;
    for (uint32_t i = 0; i < p->count; i++)
        b = box_union(b, p->items[i].bounds);
    return b;
}

static struct vec3 random_point(struct box b, uint64_t *random)
{
    struct vec3 size = vec3_sub(b.max, b.min);
    return (struct vec3){b.min.x + size.x * random_unit(random),
                         b.min.y + size.y * random_unit(random),
                         b.min.z + size.z * random_unit(random)};
}

// ---------------------------------------------------------------- solids of cells

enum { SIDE = 3, CELLS = SIDE * SIDE * SIDE };

struct cells {
    bool filled[CELLS];
    struct affine place;
};

static bool is_filled(const struct cells *c, const int *at)
{
    for (int k = 0; k < 3; k++)
        if (at[k] < 0 || at[k] >= SIDE)
            return false;
    return c->filled[at[0] + SIDE * (at[1] + SIDE * at[2])];
}

// The surface between filled and empty cells: closed, with edges of four sides where cells touch.
static void cells_solid(struct solid *out, const struct cells *c)
{
    static const int sides[6][4] = {{2, 0, 4, 6}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {3, 2, 6, 7}, {2, 3, 1, 0}, {4, 5, 7, 6}};
    struct mesh_builder b = {0};
    bool mirrored = affine_determinant(&c->place) < 0;
    for (int i = 0; i < CELLS; i++) {
        int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        for (int s = 0; s < 6 && c->filled[i]; s++) {
            int beside[3] = {at[0], at[1], at[2]};
            beside[s / 2] += s % 2 ? 1 : -1;
            if (is_filled(c, beside))
                continue;
            uint32_t corners[4];
            for (int k = 0; k < 4; k++) {
                int q = sides[s][mirrored ? 3 - k : k];
                struct vec3 p = {at[0] + (q & 1), at[1] + (q >> 1 & 1), at[2] + (q >> 2)};
                corners[k] = mesh_add_vertex(&b, affine_point(&c->place, p));
            }
            mesh_add_convex(&b, corners, 4);
        }
    }
    mesh_weld(&b.mesh);
    assert_true(mesh_volume(&b.mesh) > 0);
    solid_from_mesh(out, &b.mesh, false, 0);
}

// The sum of cell i of a and cell k of b.
static void cell_sum(struct solid *out, const struct cells *a, int i, const struct cells *b, int k)
{
    struct vec3 points[64];
    for (int v = 0; v < 64; v++) {
        struct vec3 p = {i % SIDE + (v & 1), i / SIDE % SIDE + (v >> 1 & 1),
                         i / SIDE / SIDE + (v >> 2 & 1)};
        struct vec3 q = {k % SIDE + (v >> 3 & 1), k / SIDE % SIDE + (v >> 4 & 1),
                         k / SIDE / SIDE + (v >> 5)};
        points[v] = vec3_add(affine_point(&a->place, p), affine_point(&b->place, q));
    }
    struct mesh m;
    assert_true(hull_solid(&m, points, 64));
    solid_from_mesh(out, &m, true, 0);
}

static uint32_t cells_sum(struct solid *out, const struct cells *a, const struct cells *b)
{
    uint32_t count = 0;
    for (int i = 0; i < CELLS; i++)
        for (int k = 0; k < CELLS; k++)
            if (a->filled[i] && b->filled[k])
                cell_sum(&out[count++], a, i, b, k);
    return count;
}

// Points nearer than this to a side are not asked for.
#define MARGIN 1e-7

static uint32_t check_cells(const struct cells *a, const struct cells *b, uint64_t *random,
                            int points)
{
    struct solid s, t, *expected = mem_alloc((size_t)CELLS * CELLS * sizeof *expected);
    cells_solid(&s, a);
    cells_solid(&t, b);
    uint32_t count = cells_sum(expected, a, b);
    struct parts p = take_parts(&s, &t);
    struct box bounds = BOX_EMPTY;
    for (uint32_t i = 0; i < count; i++)
        bounds = box_union(bounds, expected[i].bounds);
    for (int i = 0; i < points; i++) {
        struct vec3 at = random_point(bounds, random);
        double height = INFINITY;
        for (uint32_t k = 0; k < count; k++)
            height = fmin(height, height_above(&expected[k], at));
        if (fabs(height) > MARGIN)
            assert_int_equal(parts_hold(&p, at), height < 0);
    }
    uint32_t part_count = p.count;
    free_parts(&p);
    for (uint32_t i = 0; i < count; i++)
        solid_free(&expected[i]);
    free(expected);
    solid_free(&s);
    solid_free(&t);
    return part_count;
}

static struct cells cells_from(const char *text) // layers from below, 'x' is filled
{
    struct cells c = {.place = AFFINE_IDENTITY};
    for (int i = 0; i < CELLS; i++)
        c.filled[i] = text[i] == 'x';
    return c;
}

static struct cells random_cells(uint64_t *random, double fill)
{
    struct cells c = {.place = AFFINE_IDENTITY};
    for (int i = 0; i < CELLS; i++)
        c.filled[i] = random_unit(random) < fill;
    c.filled[random_next(random) % CELLS] = true;
    return c;
}

static struct affine random_map(uint64_t *random)
{
    struct affine a;
    for (int i = 0; i < 12; i++)
        a.m[i / 4][i % 4] = 2 * random_unit(random) - 1;
    return fabs(affine_determinant(&a)) > 0.05 ? a : AFFINE_IDENTITY;
}

#define SHELL                                                                                      \
    "xxxxxxxxx"                                                                                    \
    "xxxx.xxxx"                                                                                    \
    "xxxxxxxxx"
#define RING                                                                                       \
    "xxxx.xxxx"                                                                                    \
    "........."                                                                                    \
    "........."
#define ELL                                                                                        \
    "xx.x....."                                                                                    \
    "........."                                                                                    \
    "........."
#define CUBE                                                                                       \
    "x........"                                                                                    \
    "........."                                                                                    \
    "........."
#define CUP                                                                                        \
    "xxxxxxxxx"                                                                                    \
    "xxxx.xxxx"                                                                                    \
    "xxxx.xxxx"
#define TOUCH                                                                                      \
    "x...x...."                                                                                    \
    "........."                                                                                    \
    "........."
#define APART                                                                                      \
    "x.x......"                                                                                    \
    "........."                                                                                    \
    "......x.x"

static void shapes_of_cells(void **state)
{
    (void)state;
    static const char *const shapes[] = {SHELL, RING, ELL, CUBE, CUP, TOUCH, APART};
    uint64_t random = 11;
    for (uint32_t i = 0; i < array_count(shapes); i++)
        for (uint32_t k = 0; k < array_count(shapes); k++)
            for (int turn = 0; turn < 3; turn++) {
                struct cells a = cells_from(shapes[i]), b = cells_from(shapes[k]);
                // Of one size, the second small, the second large; turned against each other.
                double scale[] = {1, 0.11, 3.7};
                b.place = random_map(&random);
                for (int m = 0; m < 12; m++)
                    b.place.m[m / 4][m % 4] =
                        scale[turn] * (turn ? b.place.m[m / 4][m % 4] : m % 5 == 0);
                check_cells(&a, &b, &random, 150);
            }
}

static void random_cells_in_random_places(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int round = 0; round < 60; round++) {
        struct cells a = random_cells(&random, 0.7 * random_unit(&random));
        struct cells b = random_cells(&random, 0.4 * random_unit(&random));
        a.place = random_map(&random);
        if (round % 3)
            b.place = random_map(&random);
        check_cells(&a, &b, &random, 150);
    }
}

// ---------------------------------------------------------------- OpenSCAD's results

// One random point in each cell of a grid: the volume within a part in a thousand or two.
static void check_sum(const struct cells *cells, const struct solid *b, struct box bounds,
                      double volume)
{
    enum { FINE = 32 };
    struct solid a;
    cells_solid(&a, cells);
    struct parts p = take_parts(&a, b);
    struct box found = parts_bounds(&p);
    for (int i = 0; i < 8; i += 7)
        assert_close(vec3_length(vec3_sub(box_corner(found, i), box_corner(bounds, i))), 0, 1e-5);
    uint64_t random = 9;
    struct vec3 size = vec3_scale(vec3_sub(bounds.max, bounds.min), 1.0 / FINE);
    uint32_t inside = 0;
    for (int i = 0; i < FINE * FINE * FINE; i++) {
        struct vec3 o = {bounds.min.x + size.x * (i % FINE),
                         bounds.min.y + size.y * (i / FINE % FINE),
                         bounds.min.z + size.z * (i / FINE / FINE)};
        struct box cell = {o, vec3_add(o, size)};
        inside += parts_hold(&p, random_point(cell, &random));
    }
    assert_close(inside * size.x * size.y * size.z / volume, 1, 3e-3);
    free_parts(&p);
    solid_free(&a);
}

static void volumes_are_those_of_openscad(void **state)
{
    (void)state;
    struct solid b;
    struct mesh m;
    // cube(3) without [1, 2] x [1, 2] x [1, 3], and sphere(1, $fn = 8)
    struct cells cup = cells_from(CUP);
    primitive_sphere(&m, 8);
    solid_from_mesh(&b, &m, true, 0);
    double low = -0.923879, high = 3.923879;
    check_sum(&cup, &b, (struct box){{low, low, low}, {high, high, high}}, 104.32954);
    solid_free(&b);
    // cube([10, 10, 5]) without a quarter, and cylinder(r = 5, h = 5)
    struct cells ell = cells_from(ELL);
    ell.place = (struct affine){{{5, 0, 0, 0}, {0, 5, 0, 0}, {0, 0, 5, 0}}};
    primitive_cylinder(&m, 16, 5, 5);
    for (uint32_t v = 0; v < m.vertex_count; v++)
        m.vertices[v].z *= 5;
    solid_from_mesh(&b, &m, true, 0);
    check_sum(&ell, &b, (struct box){{-5, -5, 0}, {15, 15, 10}}, 3456.70646);
    solid_free(&b);
    // Two concave ones, the second under a matrix.
    struct cells turned = ell;
    ell.place = AFFINE_IDENTITY;
    turned.place = (struct affine){{{0, -0.5, 0.2, 0}, {0.5, 0.1, 0, 0}, {0, 0.3, 0.7, 0}}};
    cells_solid(&b, &turned);
    check_sum(&ell, &b, (struct box){{-1, 0, 0}, {2.2, 3.1, 2.3}}, 17.1904287);
    solid_free(&b);
}

// ---------------------------------------------------------------- numbers of parts

static void convex_solids_have_one_part(void **state)
{
    (void)state;
    struct mesh cube, sphere, sum;
    primitive_cube(&cube);
    struct solid a, b;
    solid_from_mesh(&a, &cube, true, 0);
    for (int known = 0; known < 2; known++) {
        primitive_sphere(&sphere, 16);
        solid_from_mesh(&b, &sphere, known, 0); // seen also where nobody says so
        struct minkowski_sum s;
        assert_true(minkowski_parts(&s, &a, &b, 1, 1));
        assert_int_equal(s.count, 1);
        assert_true(s.parts[0].convex);
        struct vec3 all[8 * 128];
        assert_int_equal(b.mesh.vertex_count, 128);
        for (int i = 0; i < 8 * 128; i++)
            all[i] = vec3_add(a.mesh.vertices[i / 128], b.mesh.vertices[i % 128]);
        assert_true(hull_solid(&sum, all, 8 * 128));
        assert_int_equal(sum.vertex_count, s.parts[0].mesh.vertex_count);
        assert_int_equal(sum.face_count, s.parts[0].mesh.face_count);
        assert_close(mesh_volume(&sum), mesh_volume(&s.parts[0].mesh), 1e-12);
        mesh_free(&sum);
        minkowski_free(&s);
        minkowski_free(&s);
        solid_free(&b);
    }
    solid_free(&a);
}

static void few_parts_are_made(void **state)
{
    (void)state;
    struct cells ell = cells_from(ELL), cube = cells_from(CUBE), apart = cells_from(APART);
    uint64_t random = 1;
    // Six sides, two L in two or three pieces, and the ell itself.
    assert_int_equal(check_cells(&ell, &cube, &random, 10), 12);
    assert_int_equal(check_cells(&cube, &ell, &random, 10), 12);
    assert_int_equal(check_cells(&apart, &apart, &random, 10), 16);
    struct solid a;
    cells_solid(&a, &ell);
    struct minkowski_sum s;
    assert_false(minkowski_parts(&s, &a, &a, 3, 1));
    assert_int_equal(s.count, 0);
    struct solid none = {0};
    assert_true(minkowski_parts(&s, &a, &none, 3, 1));
    assert_int_equal(s.count, 0);
    minkowski_free(&s);
    solid_free(&a);
}

static void flawed_meshes_do_no_harm(void **state)
{
    (void)state;
    struct cells ell = cells_from(ELL);
    uint64_t random = 4;
    for (int round = 0; round < 300; round++) {
        struct solid a, b;
        cells_solid(&a, &ell);
        cells_solid(&b, &ell);
        const double odd[] = {NAN, INFINITY, 1e300, -1e300, 0, 1e-300};
        for (int i = 0; i < 6; i++) { // corners elsewhere, faces and corners mistaken for others
            struct mesh *m = &a.mesh;
            uint32_t t = (uint32_t)(random_next(&random) % m->triangle_count);
            uint32_t v = (uint32_t)(random_next(&random) % m->vertex_count);
            m->faces[t] = (uint32_t)(random_next(&random) % m->face_count);
            if (i % 2)
                m->triangles[t][i / 2] = v;
            if (round % 3 == 0 && i == 0)
                m->vertices[v].x = odd[round / 3 % 6];
        }
        struct minkowski_sum s;
        assert_true(minkowski_parts(&s, &a, &b, 100000, 1));
        minkowski_free(&s);
        solid_free(&a);
        solid_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_of_cells),
        cmocka_unit_test(random_cells_in_random_places),
        cmocka_unit_test(volumes_are_those_of_openscad),
        cmocka_unit_test(convex_solids_have_one_part),
        cmocka_unit_test(few_parts_are_made),
        cmocka_unit_test(flawed_meshes_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
