// test_mesh.c - welding, bounds, volume and planes.
#include "unit.h"

static void weld_merges_equal_vertices_and_keeps_order(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    struct vec3 p[6] = {{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -0.0, 0}, {0, 0, 1}};
    for (int i = 0; i < 6; i++)
        mesh_add_vertex(&b, p[i]); // the first is in no triangle, the fifth equals the third
    mesh_add_triangle(&b, 1, 2, 4, mesh_add_face(&b)); // collapses, and its face with it
    mesh_add_triangle(&b, 1, 4, 3, mesh_add_face(&b));
    mesh_add_triangle(&b, 2, 5, 3, mesh_add_face(&b));
    mesh_weld(&b.mesh);
    assert_int_equal(b.mesh.vertex_count, 4);
    assert_int_equal(b.mesh.triangle_count, 2);
    assert_int_equal(b.mesh.face_count, 2);
    const uint32_t expected[2][3] = {{0, 1, 2}, {1, 3, 2}};
    assert_memory_equal(b.mesh.triangles, expected, sizeof expected);
    assert_true(b.mesh.vertices[3].z == 1);
    assert_int_equal(b.mesh.faces[0], 0);
    assert_int_equal(b.mesh.faces[1], 1);
    mesh_free(&b.mesh);
    mesh_free(&b.mesh);
}

static void empty_mesh_is_a_solid(void **state)
{
    (void)state;
    struct mesh m = {0};
    mesh_weld(&m);
    assert_true(mesh_volume(&m) == 0);
    struct solid s;
    solid_from_mesh(&s, &m, true, 7);
    assert_true(box_is_empty(s.bounds));
    assert_int_equal(s.planes.count, 0);
    solid_free(&s);
    solid_free(&s);
}

static void needle_faces_get_planes_that_cut_nothing(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    struct vec3 p[4] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 3, 1}};
    for (int i = 0; i < 4; i++)
        mesh_add_vertex(&b, p[i]);
    mesh_add_triangle(&b, 0, 1, 2, mesh_add_face(&b)); // no area
    mesh_add_triangle(&b, 0, 2, 3, mesh_add_face(&b));
    struct solid s;
    solid_from_mesh(&s, &b.mesh, true, 1);
    assert_int_equal(s.planes.count, 2);
    assert_int_equal(s.planes.padded, 8);
    assert_true(s.planes.nz[0] == 1 && s.planes.d[0] == 1);
    for (uint32_t i = 2; i < 8; i++)
        assert_true(s.planes.nz[i] == s.planes.nz[0] && s.planes.d[i] == s.planes.d[0]);
    assert_int_equal((uintptr_t)s.planes.nx % 64, 0);
    assert_int_equal((uintptr_t)s.planes.d % 64, 0);
    solid_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weld_merges_equal_vertices_and_keeps_order),
        cmocka_unit_test(empty_mesh_is_a_solid),
        cmocka_unit_test(needle_faces_get_planes_that_cut_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
