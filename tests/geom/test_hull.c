// test_hull.c - hulls hold their points, close up, and have whole faces and true corners only.
#include "base/hash.h"
#include "geom/hull.h"
#include "geom/primitives.h"
#include "unit.h"

static double spread(const struct vec3 *p, uint32_t count)
{
    struct box b = BOX_EMPTY;
    for (uint32_t i = 0; i < count; i++)
        b = box_of_point(b, p[i]);
    return vec3_length(vec3_sub(b.max, b.min));
}

static bool is_input(struct vec3 v, const struct vec3 *p, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (v.x == p[i].x && v.y == p[i].y && v.z == p[i].z)
            return true;
    return false;
}

static uint32_t corners_of_face(const struct mesh *m, uint32_t face)
{
    uint32_t n = 2;
    for (uint32_t t = 0; t < m->triangle_count; t++)
        n += m->faces[t] == face;
    return n;
}

// Everything that is promised of a hull; at most `sample` points and corners are looked at.
static void check_hull(const struct mesh *m, const struct vec3 *p, uint32_t count, uint32_t sample)
{
    assert_true(mesh_is_closed(m));
    assert_true(mesh_volume(m) > 0);
    uint32_t corners = 0;
    for (uint32_t f = 0; f < m->face_count && sample == UINT32_MAX; f++)
        corners += corners_of_face(m, f);
    if (sample == UINT32_MAX) // Euler: one ball
        assert_int_equal(m->vertex_count + m->face_count, corners / 2 + 2);
    double extent = spread(p, count);
    for (uint32_t i = 0; i < m->vertex_count; i += 1 + m->vertex_count / sample)
        assert_true(is_input(m->vertices[i], p, count));
    struct mesh copy = {0};
    assert_true(hull_solid(&copy, m->vertices, m->vertex_count)); // all are corners
    assert_int_equal(copy.vertex_count, m->vertex_count);
    struct solid s;
    solid_from_mesh(&s, &copy, true, 0);
    for (uint32_t i = 0; i < count; i += 1 + count / sample)
        for (uint32_t f = 0; f < s.planes.count; f++) {
            struct vec3 n = {s.planes.nx[f], s.planes.ny[f], s.planes.nz[f]};
            assert_true(vec3_dot(n, p[i]) - s.planes.d[f] <= 1e-9 * extent);
        }
    solid_free(&s);
}

static void check_points(const struct vec3 *p, uint32_t count, uint32_t vertices, uint32_t faces)
{
    struct mesh m;
    assert_true(hull_solid(&m, p, count));
    assert_int_equal(m.vertex_count, vertices);
    assert_int_equal(m.face_count, faces);
    check_hull(&m, p, count, UINT32_MAX);
    mesh_free(&m);
}

static void flat_faces_are_whole(void **state)
{
    (void)state;
    struct vec3 grid[125];
    for (int i = 0; i < 125; i++)
        grid[i] = (struct vec3){i % 5, i / 5 % 5, i / 25};
    check_points(grid, 125, 8, 6); // points within edges and faces are no corners
    struct vec3 cube[8];
    for (int i = 0; i < 8; i++)
        cube[i] = box_corner((struct box){{0, 0, 0}, {1, 1, 1}}, i);
    check_points(cube, 8, 8, 6);
    struct vec3 more[12] = {{0.5, 0, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 0.5}, {1, 1, 1}};
    memcpy(more + 4, cube, sizeof cube);
    check_points(more, 12, 8, 6);
    // Two cubes, as OpenSCAD has them: 7 + 7 corners.
    struct vec3 two[16];
    for (int i = 0; i < 8; i++) {
        two[i] = cube[i];
        two[8 + i] = vec3_add(cube[i], (struct vec3){2, 2, 2});
    }
    check_points(two, 16, 14, 12);
}

// Caps and quads come out whole also where rounding bends them.
static void hulls_of_spheres_have_the_faces_of_spheres(void **state)
{
    (void)state;
    struct mesh sphere, m;
    primitive_sphere(&sphere, 30);
    const struct affine turned = {{{8, -6e-1, 1, 1000}, {5e-1, 7, 2, -2000}, {-1, 3, 9.25, 500}}};
    for (uint32_t v = 0; v < sphere.vertex_count; v++)
        sphere.vertices[v] = affine_point(&turned, sphere.vertices[v]);
    assert_true(hull_solid(&m, sphere.vertices, sphere.vertex_count));
    assert_int_equal(m.vertex_count, sphere.vertex_count);
    assert_int_equal(m.face_count, sphere.face_count);
    check_hull(&m, sphere.vertices, sphere.vertex_count, UINT32_MAX);
    assert_close(mesh_volume(&m), mesh_volume(&sphere), 1e-6);
    mesh_free(&m);
    mesh_free(&sphere);
}

static void random_points_of_all_kinds(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (uint32_t round = 0; round < 3000; round++) {
        uint32_t count = 4 + (uint32_t)(random_next(&random) % (round % 10 ? 20 : 200));
        // A coarse grid makes many coplanar and equal points; odd sizes and places strain rounding.
        uint32_t grid = round % 4 ? 2 + (uint32_t)(random_next(&random) % 4) : 1u << 30;
        double scale = pow(10, 12 * random_unit(&random) - 6), away = round % 3 ? 0 : 1000 * scale;
        double turn = round % 5 ? 0 : 6 * random_unit(&random);
        struct vec3 *p = mem_alloc(count * sizeof *p);
        for (uint32_t i = 0; i < count; i++) {
            double q[3];
            for (int k = 0; k < 3; k++)
                q[k] = (double)(random_next(&random) % grid) / grid * scale;
            p[i] = (struct vec3){cos(turn) * q[0] - sin(turn) * q[1] + away,
                                 sin(turn) * q[0] + cos(turn) * q[1], q[2] - away};
        }
        struct mesh m;
        if (hull_solid(&m, p, count))
            check_hull(&m, p, count, UINT32_MAX);
        else
            assert_true(count < 12 || grid == 2); // by chance in one plane
        mesh_free(&m);
        free(p);
    }
}

static void flat_points_make_sheets(void **state)
{
    (void)state;
    struct vec3 p[7] = {{0, 0, 0}, {4, 0, 4}, {2, 0, 2}, {4, 3, 4},
                        {0, 3, 0}, {2, 1, 2}, {4, 3, 4}};
    struct mesh m = {0};
    assert_false(hull_solid(&m, p, 7));
    assert_int_equal(m.triangle_count, 0);
    assert_true(hull_sheet(&m, p, 7));
    assert_int_equal(m.vertex_count, 4);
    assert_int_equal(m.triangle_count, 4);
    assert_int_equal(m.face_count, 2);
    assert_true(mesh_is_closed(&m));
    mesh_free(&m);
    assert_true(hull_sheet(&m, p + 2, 3));
    assert_int_equal(m.vertex_count, 3);
    assert_true(mesh_is_closed(&m));
    mesh_free(&m);
    assert_false(hull_sheet(&m, p, 3)); // one line
    assert_false(hull_sheet(&m, p, 0));
    assert_false(hull_solid(&m, p, 0));
    // A plane that rounding bends is a plane still.
    struct vec3 oblique[50];
    uint64_t random = 3;
    for (uint32_t i = 0; i < 50; i++) {
        double u = random_unit(&random), v = random_unit(&random);
        oblique[i] = (struct vec3){u / 3 + v / 7 + 11, u / 9 - v, u * 0.7 + v * 0.3};
    }
    assert_false(hull_solid(&m, oblique, 50));
    assert_true(hull_sheet(&m, oblique, 50));
    mesh_free(&m);
}

static void numbers_out_of_this_world_give_nothing(void **state)
{
    (void)state;
    struct vec3 p[20];
    for (int i = 0; i < 20; i++)
        p[i] = box_corner((struct box){{0, 0, 0}, {1, 1, 1}}, i);
    struct mesh m;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (uint32_t count = 8; count <= 20; count += 12)
        for (uint32_t i = 0; i < array_count(bad); i++) {
            p[3].y = bad[i];
            assert_false(hull_solid(&m, p, count));
            assert_false(hull_sheet(&m, p, count));
        }
    for (int exponent = -1060; exponent <= 1020; exponent += 20) {
        for (int i = 0; i < 20; i++)
            p[i] = vec3_scale(box_corner((struct box){{0, 0, 0}, {1, 1, 1}}, i % 8),
                              ldexp(1, exponent));
        for (uint32_t count = 8; count <= 20; count += 12) {
            bool ok = hull_solid(&m, p, count);
            assert_true(ok || exponent < -980);
            assert_true(!ok || (m.vertex_count == 8 && m.face_count == 6));
            mesh_free(&m);
        }
    }
}

static void large_sets(void **state)
{
    (void)state;
    enum { COUNT = 200000 };
    struct vec3 *p = mem_alloc(COUNT * sizeof *p);
    uint64_t random = 5;
    for (uint32_t i = 0; i < COUNT; i++) {
        struct vec3 v = {random_unit(&random) - 0.5, random_unit(&random) - 0.5,
                         random_unit(&random) - 0.5};
        p[i] = i % 100 ? v : vec3_normalized(v);
    }
    struct mesh m;
    assert_true(hull_solid(&m, p, COUNT));
    assert_true(m.vertex_count > 1900);
    check_hull(&m, p, COUNT, 50);
    mesh_free(&m);
    free(p);
}

static void outlines_have_strict_corners(void **state)
{
    (void)state;
    struct vec2 p[] = {{0, 0}, {2, 0}, {1, 0},   {2, 2}, {0, 2}, {1, 1},
                       {0, 1}, {2, 1}, {2, 0.5}, {0, 0}, {2, 2}, {NAN, 9}};
    struct outline o;
    hull_outline(&o, p, array_count(p));
    assert_int_equal(o.path_count, 1);
    assert_int_equal(o.point_count, 4);
    assert_true(o.clean);
    assert_true(outline_area(&o) == 4);
    outline_free(&o);
    hull_outline(&o, p, 3); // one line
    assert_int_equal(o.point_count, 0);
    outline_free(&o);
    hull_outline(&o, NULL, 0);
    assert_int_equal(o.path_count, 0);
    outline_free(&o);

    enum { CIRCLE = 1000000 };
    struct vec2 *circle = mem_alloc(CIRCLE * sizeof *circle);
    for (uint32_t i = 0; i < CIRCLE; i++) {
        double angle = (double)(i * (uint64_t)7919 % CIRCLE) * (2 * M_PI / CIRCLE);
        circle[i] = (struct vec2){cos(angle), sin(angle)};
    }
    hull_outline(&o, circle, CIRCLE);
    assert_true(o.point_count > CIRCLE * 0.99);
    assert_close(outline_area(&o), M_PI, 1e-9);
    outline_free(&o);
    free(circle);
}

// Two circles of thousands of corners are two faces and as many quadrilaterals; points within the
// faces are no corners. Merging faces one by one takes the square of their corners.
static void round_faces_are_quick(void **state)
{
    (void)state;
    enum { CORNERS = 30000, INSIDE = 5000 };
    struct vec3 *points = mem_alloc((2 * CORNERS + INSIDE) * sizeof *points);
    double c = cos(0.5), s = sin(0.5), lean[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (uint32_t i = 0; i < 2 * CORNERS + INSIDE; i++) {
        double angle = 2 * acos(-1) * (i / 2) / CORNERS, r = i < 2 * CORNERS ? 10 : 0.001 * i / 12;
        struct vec3 p = {r * cos(angle), r * sin(angle), i % 2};
        points[i] = (struct vec3){lean[0][0] * p.x + lean[0][2] * p.z, p.y,
                                  lean[2][0] * p.x + lean[2][2] * p.z};
    }
    struct mesh m;
    assert_true(hull_solid(&m, points, 2 * CORNERS + INSIDE));
    assert_int_equal(m.face_count, CORNERS + 2);
    assert_int_equal(m.vertex_count, 2 * CORNERS);
    assert_true(mesh_is_closed(&m));
    assert_close(mesh_volume(&m), CORNERS * 50 * sin(2 * acos(-1) / CORNERS), 1e-8);
    mesh_free(&m);
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_faces_are_whole),
        cmocka_unit_test(hulls_of_spheres_have_the_faces_of_spheres),
        cmocka_unit_test(random_points_of_all_kinds),
        cmocka_unit_test(flat_points_make_sheets),
        cmocka_unit_test(numbers_out_of_this_world_give_nothing),
        cmocka_unit_test(large_sets),
        cmocka_unit_test(outlines_have_strict_corners),
        cmocka_unit_test(round_faces_are_quick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
