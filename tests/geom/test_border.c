// test_border.c - meshes with holes, and with slits.
#include "geom/border.h"
#include "unit.h"

static void borders_are_edges_with_one_side(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (int i = 0; i < 4; i++)
        mesh_add_vertex(&b, (struct vec3){i == 1, i == 2, i == 3});
    assert_false(mesh_has_border(&b.mesh));
    for (int i = 0; i < 4; i++) {
        mesh_add_triangle(&b, faces[i][0], faces[i][1], faces[i][2], mesh_add_face(&b));
        assert_true(mesh_has_border(&b.mesh) == (i < 3));
    }
    uint32_t turned = b.mesh.triangles[3][0];
    b.mesh.triangles[3][0] = b.mesh.triangles[3][1];
    b.mesh.triangles[3][1] = turned;
    assert_true(mesh_has_border(&b.mesh));
    bool as_written[4] = {false, false, false, true};
    b.mesh.turned = mem_zalloc(sizeof as_written);
    memcpy(b.mesh.turned, as_written, sizeof as_written);
    assert_false(mesh_has_border(&b.mesh));
    mesh_free(&b.mesh);
}

// A tetrahedron with a corner in or near the middle of an edge of only one of its faces.
static void holes_have_area(void **state)
{
    (void)state;
    for (int shift = 0; shift < 3; shift++) {
        static const double aside[3] = {0, 1e-6, 0.1}; // of a corner in the middle of an edge
        struct mesh_builder b = {0};
        const uint32_t faces[5][3] = {{0, 2, 1}, {0, 1, 3}, {1, 4, 3}, {4, 2, 3}, {2, 0, 3}};
        for (int i = 0; i < 4; i++)
            mesh_add_vertex(&b, (struct vec3){i == 1, i == 2, i == 3});
        mesh_add_vertex(&b, (struct vec3){0.5 + aside[shift], 0.5, 0});
        for (int i = 0; i < 5; i++)
            mesh_add_triangle(&b, faces[i][0], faces[i][1], faces[i][2], mesh_add_face(&b));
        assert_true(mesh_has_border(&b.mesh) == (shift == 2));
        b.mesh.triangle_count--;
        assert_true(mesh_has_border(&b.mesh));
        mesh_free(&b.mesh);
    }
}

// All holes of a cube without two opposite sides have together no area; nor have the turned faces
// of an octahedron, every other one, whose edges meet in all corners.
static void holes_count_one_by_one(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    for (uint32_t i = 0; i < 8; i++)
        mesh_add_vertex(&b, (struct vec3){i & 1, i >> 1 & 1, i >> 2});
    static const uint32_t ring[4] = {0, 1, 3, 2};
    for (uint32_t i = 0; i < 4; i++)
        mesh_add_convex(
            &b, (uint32_t[4]){ring[i], ring[(i + 1) % 4], ring[(i + 1) % 4] + 4, ring[i] + 4}, 4);
    assert_true(mesh_has_border(&b.mesh));
    mesh_free(&b.mesh);
    b = (struct mesh_builder){0};
    for (int i = 0; i < 3; i++)
        for (int sign = 1; sign > -2; sign -= 2)
            mesh_add_vertex(&b, (struct vec3){sign * (i == 0), sign * (i == 1), sign * (i == 2)});
    for (uint32_t i = 0; i < 8; i++)
        mesh_add_triangle(&b, i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2), mesh_add_face(&b));
    assert_true(mesh_has_border(&b.mesh));
    mesh_free(&b.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(borders_are_edges_with_one_side),
        cmocka_unit_test(holes_have_area),
        cmocka_unit_test(holes_count_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
