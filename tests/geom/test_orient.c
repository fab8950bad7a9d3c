// test_orient.c - meshes with faces that are turned the wrong way.
#include "geom/orient.h"
#include "geom/placed.h"
#include "unit.h"

// A tetrahedron with a corner at `at`; the sign of `size` is that of its volume.
static void add_tetrahedron(struct mesh_builder *b, double at, double size)
{
    uint32_t v[4];
    v[0] = mesh_add_vertex(b, (struct vec3){at, at, at});
    v[1] = mesh_add_vertex(b, (struct vec3){at + fabs(size), at, at});
    v[2] = mesh_add_vertex(b, (struct vec3){at, at + fabs(size), at});
    v[3] = mesh_add_vertex(b, (struct vec3){at, at, at + fabs(size)});
    static const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (int i = 0; i < 4; i++) {
        const int *f = faces[i];
        int p = size > 0 ? 1 : 2;
        mesh_add_triangle(b, v[f[0]], v[f[p]], v[f[3 - p]], mesh_add_face(b));
    }
}

static void turn(struct mesh *m, uint32_t triangle)
{
    uint32_t *t = m->triangles[triangle], swap = t[0];
    t[0] = t[1];
    t[1] = swap;
}

static void turned_faces_are_turned_back(void **state)
{
    (void)state;
    for (uint32_t mask = 1; mask < 15; mask++) {
        struct mesh_builder b = {0};
        add_tetrahedron(&b, 0, 6);
        for (uint32_t i = 0; i < 4; i++)
            if (mask >> i & 1)
                turn(&b.mesh, i);
        mesh_orient(&b.mesh);
        assert_true(mesh_is_closed(&b.mesh));
        assert_close(mesh_volume(&b.mesh), 36, 1e-9);
        mesh_free(&b.mesh);
    }
}

static void what_agrees_stays(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    add_tetrahedron(&b, 0, 6);
    add_tetrahedron(&b, 1, -1); // a hollow
    add_tetrahedron(&b, 9, 3);
    uint32_t before[12][3];
    memcpy(before, b.mesh.triangles, sizeof before);
    mesh_orient(&b.mesh);
    assert_memory_equal(before, b.mesh.triangles, sizeof before);

    turn(&b.mesh, 10); // only its component changes
    mesh_orient(&b.mesh);
    assert_memory_equal(before, b.mesh.triangles, 8 * sizeof before[0]);
    assert_close(mesh_volume(&b.mesh), 36 - 1.0 / 6 + 4.5, 1e-9);
    assert_true(mesh_is_closed(&b.mesh));
    mesh_free(&b.mesh);
}

static void repeated_triangles_are_dropped(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        struct mesh_builder b = {0};
        add_tetrahedron(&b, 0, 6);
        mesh_add_triangle(&b, 2, 3, 1, mesh_add_face(&b));
        if (turned)
            turn(&b.mesh, 4);
        mesh_orient(&b.mesh);
        assert_int_equal(b.mesh.triangle_count, 4);
        assert_int_equal(b.mesh.face_count, 4);
        assert_true(mesh_is_closed(&b.mesh));
        mesh_free(&b.mesh);
    }
}

static void open_meshes_stay(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    add_tetrahedron(&b, 0, 6);
    turn(&b.mesh, 0);
    b.mesh.triangle_count = 3;
    uint32_t before[3][3];
    memcpy(before, b.mesh.triangles, sizeof before);
    mesh_orient(&b.mesh);
    assert_memory_equal(before, b.mesh.triangles, sizeof before);
    mesh_free(&b.mesh);

    struct mesh empty = {0};
    mesh_orient(&empty);
    assert_int_equal(empty.triangle_count, 0);
}

// The projective plane of six vertices: no choice makes all triangles agree.
static void one_sided_meshes_stay(void **state)
{
    (void)state;
    static const uint32_t t[10][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                                      {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
    struct mesh_builder b = {0};
    for (int i = 0; i < 6; i++)
        mesh_add_vertex(&b, (struct vec3){i, i * i, i * i * i});
    for (int i = 0; i < 10; i++)
        mesh_add_triangle(&b, t[i][0], t[i][1], t[i][2], mesh_add_face(&b));
    mesh_orient(&b.mesh);
    assert_memory_equal(t, b.mesh.triangles, sizeof t);
    mesh_free(&b.mesh);
}

static void placed_meshes_have_their_own_marks(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    add_tetrahedron(&b, 0, 6);
    turn(&b.mesh, 1);
    mesh_orient(&b.mesh);
    struct mesh placed;
    mesh_placed(&placed, &b.mesh, &AFFINE_IDENTITY);
    assert_ptr_not_equal(placed.turned, b.mesh.turned);
    mesh_free(&b.mesh);
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(placed.turned[i], i == 1);
    mesh_free(&placed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_faces_are_turned_back),
        cmocka_unit_test(what_agrees_stays),
        cmocka_unit_test(repeated_triangles_are_dropped),
        cmocka_unit_test(open_meshes_stay),
        cmocka_unit_test(one_sided_meshes_stay),
        cmocka_unit_test(placed_meshes_have_their_own_marks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
