// test_polygon.c - cutting polygons into triangles.
#include "geom/polygon.h"

#include "base/hash.h"
#include "unit.h"

// Cuts the polygon of all given points; the mesh holds the result.
static bool cut(struct mesh_builder *b, const struct vec3 *points, uint32_t count)
{
    struct polygon_cutter *c = polygon_cutter_new();
    uint32_t *corners = mem_alloc(count * sizeof *corners);
    *b = (struct mesh_builder){0};
    for (uint32_t i = 0; i < count; i++)
        corners[i] = mesh_add_vertex(b, points[i]);
    bool ok = polygon_cut(c, b, corners, count);
    free(corners);
    polygon_cutter_delete(c);
    return ok;
}

// Area seen along -z, positive when counter-clockwise.
static double area(const struct mesh *m)
{
    double twice = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        struct vec3 a = m->vertices[m->triangles[t][0]];
        twice += vec3_cross(vec3_sub(m->vertices[m->triangles[t][1]], a),
                            vec3_sub(m->vertices[m->triangles[t][2]], a))
                     .z;
    }
    return twice / 2;
}

static void concave_polygon_keeps_its_area(void **state)
{
    (void)state;
    const struct vec3 arrow[] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
    struct mesh_builder b;
    assert_true(cut(&b, arrow, 5));
    assert_int_equal(b.mesh.triangle_count, 3);
    assert_int_equal(b.mesh.face_count, 1);
    assert_close(area(&b.mesh), 10, 1e-12);
    mesh_free(&b.mesh);

    const struct vec3 dart[] = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}; // a concave quad
    assert_true(cut(&b, dart, 4));
    assert_int_equal(b.mesh.triangle_count, 2);
    assert_close(area(&b.mesh), 4, 1e-12);
    mesh_free(&b.mesh);

    const struct vec3 down[] = {{0, 4, 0}, {2, 1, 0}, {4, 4, 0}, {4, 0, 0}, {0, 0, 0}};
    assert_true(cut(&b, down, 5));
    assert_close(area(&b.mesh), -10, 1e-12);
    mesh_free(&b.mesh);
}

static void crossings_become_vertices(void **state)
{
    (void)state;
    struct vec3 star[5]; // the middle counts twice: outside
    for (int i = 0; i < 5; i++)
        star[i] = (struct vec3){cos(i * 4 * M_PI / 5), sin(i * 4 * M_PI / 5), 3};
    struct mesh_builder b;
    assert_true(cut(&b, star, 5));
    assert_int_equal(b.mesh.vertex_count, 10);
    assert_close(area(&b.mesh), 1.12257 - 0.34694, 1e-4);
    mesh_free(&b.mesh);
}

// The number of the triangle, written from any of its corners, or -1.
static int find_triangle(const struct mesh *m, const uint32_t t[3])
{
    for (uint32_t i = 0; i < m->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            if (m->triangles[i][k] == t[0] && m->triangles[i][(k + 1) % 3] == t[1] &&
                m->triangles[i][(k + 2) % 3] == t[2])
                return (int)i;
    return -1;
}

// Polygons and the triangles that OpenSCAD 2021.01 exports of them.
static const struct {
    struct vec3 points[8];
    uint32_t count, triangles[6][3];
} exported[] = {
    {{{0, 0, 0}, {4, 0, 1}, {4.5, 1, 0}, {0.5, 1, 1}}, 4, {{3, 0, 1}, {3, 1, 2}}},
    {{{0, 0, 0}, {4, 0, 1}, {4.5, 3, 0}, {0.5, 1, 1}}, 4, {{3, 1, 2}, {1, 3, 0}}},
    {{{0, 0, 0}, {4, 0, 1}, {3, 1, 2}, {2, 4, 0}}, 4, {{2, 0, 1}, {0, 2, 3}}},
    {{{0, 0, 0}, {1, 4, 0}, {1, 1, 4}, {2, -1, 3}}, 4, {{2, 0, 1}, {0, 2, 3}}},
    {{{0, 0, 0}, {3, 0, 2}, {5, 2, 0}, {3, 4, 2}, {0, 3, 0}, {1, 1.5, 1}},
     6,
     {{3, 1, 2}, {3, 5, 1}, {5, 3, 4}, {1, 5, 0}}},
    {{{0, 0, 0}, {0, 3, 2}, {1, 5, 2}, {2, 4, 3}, {0, 0, 5}, {1, 1, 3}, {2, 1, 2}},
     7,
     {{3, 1, 2}, {3, 5, 1}, {5, 3, 4}, {6, 1, 5}, {1, 6, 0}}},
    {{{5, 0, 0}, {4, 1, 3}, {0, 1, 5}, {-3, 2, 3}, {-5, 1, 0}, {-3, 0, -4}, {0, 2, -5}, {4, 0, -3}},
     8,
     {{3, 1, 2}, {5, 3, 4}, {3, 0, 1}, {3, 7, 0}, {6, 3, 5}, {3, 6, 7}}},
    // A corner between two others, seen along the normal's main axis.
    {{{0, -20, 20}, {10, -20, 20}, {10, 10, 0}, {10, 0, 0}}, 4, {{0, 1, 3}, {1, 2, 3}}},
};

static void bent_polygons_take_the_diagonals_of_openscad(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof exported / sizeof *exported; i++) {
        struct mesh_builder b;
        uint32_t n = exported[i].count;
        assert_true(cut(&b, exported[i].points, n));
        assert_int_equal(b.mesh.triangle_count, n - 2);
        assert_int_equal(b.mesh.face_count, n - 2);
        for (uint32_t t = 0; t < n - 2; t++)
            assert_int_not_equal(find_triangle(&b.mesh, exported[i].triangles[t]), -1);
        mesh_free(&b.mesh);
    }
}

static void rounded_numbers_stay_one_face(void **state)
{
    (void)state;
    const struct vec3 p[] = {
        {10, 0, 1.23457}, {12, 0, 1.23456}, {12, 5, 1.23457}, {11, 7, 1.23457}, {10, 5, 1.23456}};
    struct mesh_builder b;
    assert_true(cut(&b, p, 5));
    assert_int_equal(b.mesh.face_count, 1);
    mesh_free(&b.mesh);
}

static void corners_on_an_edge_are_kept(void **state)
{
    (void)state;
    const struct vec3 p[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    struct mesh_builder b;
    assert_true(cut(&b, p, 6));
    assert_close(area(&b.mesh), 4, 1e-12);
    bool used[6] = {0};
    for (uint32_t t = 0; t < b.mesh.triangle_count; t++)
        for (int i = 0; i < 3; i++)
            used[b.mesh.triangles[t][i]] = true;
    for (int i = 0; i < 6; i++)
        assert_true(used[i]);
    mesh_free(&b.mesh);
}

static void nonsense_is_refused_or_harmless(void **state)
{
    (void)state;
    struct mesh_builder b;
    const struct vec3 same[] = {{1, 1, 1}, {1, 1, 1}, {2, 1, 1}, {1, 1, 1}};
    assert_false(cut(&b, same, 4));
    assert_int_equal(b.mesh.triangle_count, 0);
    mesh_free(&b.mesh);
    const struct vec3 line[] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1.5, 1.5, 1.5}};
    assert_true(cut(&b, line, 5)); // without area, but it closes a seam
    assert_close(area(&b.mesh), 0, 1e-12);
    mesh_free(&b.mesh);
    const struct vec3 huge[] = {
        {0, 0, 0}, {1e200, 0, 0}, {1e200, 1e200, 0}, {5e199, 1e199, 0}, {0, 1e200, 0}};
    cut(&b, huge, 5);
    mesh_free(&b.mesh);
    struct vec3 noise[60];
    uint64_t seed = 3;
    for (int round = 0; round < 50; round++) {
        for (int i = 0; i < 60; i++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            double z = round % 2 ? (double)(seed >> 52 & 3) : 0;
            noise[i] = (struct vec3){(double)(seed >> 60), (double)(seed >> 56 & 15), z};
        }
        cut(&b, noise, 60);
        mesh_weld(&b.mesh);
        mesh_free(&b.mesh);
    }
}

// Its middle new corners would open the seams to its neighbours.
static void strongly_bent_quads_keep_their_corners(void **state)
{
    (void)state;
    const struct vec3 p[] = {{0.213931, -1.18909, 69.6324},
                             {0.507199, -1.73168, 68.8016},
                             {6.96718, -1.88303, 76.9407},
                             {9.17023, -6.28686, 70.9731}};
    struct mesh_builder b;
    assert_true(cut(&b, p, 4));
    assert_int_equal(b.mesh.triangle_count, 2);
    mesh_weld(&b.mesh);
    assert_int_equal(b.mesh.vertex_count, 4);
    mesh_free(&b.mesh);
}

// Every side of the polygon is one of a triangle, in its direction, and all others meet.
static void bent_polygons_close_their_seams(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int round = 0; round < 200; round++) {
        struct vec3 p[12];
        for (int i = 0; i < 12; i++) {
            double angle = 2 * M_PI * i / 12, r = 1 + random_unit(&seed);
            p[i] = (struct vec3){r * cos(angle), r * sin(angle), 4 * random_unit(&seed)};
        }
        struct mesh_builder b;
        assert_true(cut(&b, p, 12));
        assert_int_equal(b.mesh.vertex_count, 12);
        int balance[12][12] = {0};
        for (uint32_t t = 0; t < b.mesh.triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                uint32_t from = b.mesh.triangles[t][k], to = b.mesh.triangles[t][(k + 1) % 3];
                balance[from][to]++;
                balance[to][from]--;
            }
        for (int i = 0; i < 12; i++)
            for (int k = 0; k < 12; k++)
                assert_int_equal(balance[i][k], (k == (i + 1) % 12) - (i == (k + 1) % 12));
        mesh_free(&b.mesh);
    }
}

static void tangles_are_refused(void **state)
{
    (void)state;
    enum { MANY = 3000 };
    struct vec3 *p = mem_alloc(MANY * sizeof *p);
    uint64_t seed = 1;
    for (int i = 0; i < MANY; i++)
        p[i] = (struct vec3){random_unit(&seed), random_unit(&seed), 1};
    struct mesh_builder b;
    assert_false(cut(&b, p, MANY));
    assert_int_equal(b.mesh.triangle_count, 0);
    mesh_free(&b.mesh);

    for (int i = 0; i < MANY; i++) { // as many corners, but in order
        double angle = 2 * M_PI * i / MANY, r = i % 2 ? 1 : 2;
        p[i] = (struct vec3){r * cos(angle), r * sin(angle), 1};
    }
    assert_true(cut(&b, p, MANY));
    assert_int_equal(b.mesh.triangle_count, MANY - 2);
    mesh_free(&b.mesh);
    free(p);
}

// A star with 10,000 tips of any length, seen from both sides and along each axis.
static void many_corners_are_quick(void **state)
{
    (void)state;
    enum { MANY = 10000 };
    struct vec3 *p = mem_alloc(MANY * sizeof *p);
    for (int side = 0; side < 6; side++) {
        uint64_t seed = 7;
        double expected = 0, before = 1;
        for (int i = 0; i < MANY; i++) {
            double angle = 2 * M_PI * i / MANY * (side % 2 ? -1 : 1);
            double r = i ? 1 + random_unit(&seed) : 1, x = r * cos(angle), y = r * sin(angle);
            p[i] = side / 2 == 0   ? (struct vec3){x, y, 0.1 * x}
                   : side / 2 == 1 ? (struct vec3){0.1 * x, x, y}
                                   : (struct vec3){y, 0.1 * x, x};
            expected += before * r * sin(2 * M_PI / MANY) / 2;
            before = r;
        }
        expected += before * sin(2 * M_PI / MANY) / 2 - sin(2 * M_PI / MANY) / 2;
        struct mesh_builder b;
        assert_true(cut(&b, p, MANY));
        assert_int_equal(b.mesh.triangle_count, MANY - 2);
        assert_int_equal(b.mesh.vertex_count, MANY);
        assert_int_equal(b.mesh.face_count, 1);
        struct vec3 sum = {0};
        for (uint32_t t = 0; t < b.mesh.triangle_count; t++) {
            const uint32_t *c = b.mesh.triangles[t];
            struct vec3 o = b.mesh.vertices[c[0]];
            sum = vec3_add(sum, vec3_cross(vec3_sub(b.mesh.vertices[c[1]], o),
                                           vec3_sub(b.mesh.vertices[c[2]], o)));
        }
        double along = side / 2 == 0 ? sum.z : side / 2 == 1 ? sum.x : sum.y;
        assert_close(along / 2, side % 2 ? -expected : expected, 1e-9);
        mesh_free(&b.mesh);
    }
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(concave_polygon_keeps_its_area),
        cmocka_unit_test(crossings_become_vertices),
        cmocka_unit_test(bent_polygons_take_the_diagonals_of_openscad),
        cmocka_unit_test(rounded_numbers_stay_one_face),
        cmocka_unit_test(corners_on_an_edge_are_kept),
        cmocka_unit_test(strongly_bent_quads_keep_their_corners),
        cmocka_unit_test(bent_polygons_close_their_seams),
        cmocka_unit_test(tangles_are_refused),
        cmocka_unit_test(many_corners_are_quick),
        cmocka_unit_test(nonsense_is_refused_or_harmless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
