// test_primitives.c - OpenSCAD's numbers of corners, angles, vertices and volumes.
#include "geom/primitives.h"
#include "unit.h"

static void fragments_follow_the_three_rules(void **state)
{
    (void)state;
    assert_int_equal(circle_fragments(10, DETAIL_DEFAULT), 30);
    assert_int_equal(circle_fragments(1, DETAIL_DEFAULT), 5);
    assert_int_equal(circle_fragments(5e-7, DETAIL_DEFAULT), 3);
    assert_int_equal(circle_fragments(10, (struct detail){0, 400, 400}), 5);
    assert_int_equal(circle_fragments(10, (struct detail){3.7, 12, 2}), 3);
    assert_int_equal(circle_fragments(10, (struct detail){1, 12, 2}), 3);
    assert_int_equal(circle_fragments(10, (struct detail){-8, 12, 2}), 30);
    assert_int_equal(circle_fragments(10, (struct detail){INFINITY, 12, 2}), 3);
    assert_int_equal(circle_fragments(10, (struct detail){NAN, 12, 2}), 3);
    assert_int_equal(circle_fragments(10, (struct detail){1e300, 12, 2}), UINT32_MAX);
    assert_int_equal(circle_fragments(1e300, (struct detail){0, 1e-300, 1e-300}), UINT32_MAX);
}

// Closed, outward, and no plane cuts off a corner of the solid.
static void check_solid(struct mesh *m, uint32_t faces)
{
    assert_true(mesh_is_closed(m));
    assert_true(mesh_volume(m) > 0);
    assert_int_equal(m->face_count, faces);
    struct solid s;
    solid_from_mesh(&s, m, true, 0);
    const struct planes *p = &s.planes;
    assert_int_equal(p->count, faces);
    assert_int_equal(p->padded % 8, 0);
    for (uint32_t i = 0; i < p->padded; i++) {
        struct vec3 n = {p->nx[i], p->ny[i], p->nz[i]};
        assert_close(vec3_length(n), 1, 1e-15);
        double outermost = -INFINITY;
        for (uint32_t v = 0; v < s.mesh.vertex_count; v++)
            outermost = fmax(outermost, vec3_dot(n, s.mesh.vertices[v]) - p->d[i]);
        assert_close(outermost, 0, 1e-15);
    }
    solid_free(&s);
}

static void cube_is_six_faces(void **state)
{
    (void)state;
    struct mesh m;
    primitive_cube(&m);
    assert_int_equal(m.vertex_count, 8);
    assert_true(mesh_volume(&m) == 1);
    check_solid(&m, 6);
}

static void spheres_have_no_poles(void **state)
{
    (void)state;
    struct mesh m;
    primitive_sphere(&m, 3);
    assert_int_equal(m.vertex_count, 6);
    assert_true(mesh_has_vertex(&m, 0.707107, 0, 0.707107));
    check_solid(&m, 5); // 8 with OpenSCAD's halves of flat sides
    primitive_sphere(&m, 4);
    assert_int_equal(m.vertex_count, 8);
    assert_true(mesh_has_vertex(&m, 0, -0.707107, -0.707107));
    check_solid(&m, 6);
    primitive_sphere(&m, 5);
    assert_true(mesh_has_vertex(&m, 0.5, 0, 0.866025));
    assert_true(mesh_has_vertex(&m, 1, 0, 0));
    check_solid(&m, 12);
    primitive_sphere(&m, 7);
    assert_close(mesh_volume(&m) * 8, 24.992, 5e-4);
    check_solid(&m, 23);
    primitive_sphere(&m, 30);
    assert_int_equal(m.vertex_count, 450);
    check_solid(&m, 422);
    primitive_sphere(&m, 32);
    check_solid(&m, 482);
    primitive_sphere(&m, 100);
    check_solid(&m, 4902);
}

static void cylinders_and_cones(void **state)
{
    (void)state;
    struct mesh m;
    primitive_cylinder(&m, 5, 0, 1);
    assert_close(mesh_volume(&m) * 8, 6.3406, 1e-3); // 2 * 4 of a unit cone's
    check_solid(&m, 6);
    primitive_cylinder(&m, 4, 1, 0);
    assert_int_equal(m.vertex_count, 5);
    assert_int_equal(m.triangle_count, 6);
    check_solid(&m, 5);
    primitive_cylinder(&m, 32, 1, 1);
    check_solid(&m, 34);
    primitive_cylinder(&m, 17, 1, 0.3);
    check_solid(&m, 19);
    primitive_cylinder(&m, 100, 1e-9, 1);
    check_solid(&m, 102);
    primitive_cylinder(&m, 3, 1, 1e-200);
    assert_int_equal(m.face_count, 5); // caps and sides too small for a normal do no harm
    mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fragments_follow_the_three_rules),
        cmocka_unit_test(cube_is_six_faces),
        cmocka_unit_test(spheres_have_no_poles),
        cmocka_unit_test(cylinders_and_cones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
