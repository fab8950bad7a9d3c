// test_bend.c - parts of bent faces, as many as OpenSCAD's geometry has.
#include "geom/bend.h"
#include "geom/primitives.h"
#include "unit.h"

static const struct vec3 square[4] = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

static void flat_faces_are_one_part(void **state)
{
    (void)state;
    struct bends b = {0};
    struct vec3 nearly[4];
    memcpy(nearly, square, sizeof nearly);
    nearly[2].z += 0x1p-21;
    bend_face(&b, square, 4, false);
    bend_face(&b, nearly, 4, false);
    bend_face(&b, square, 3, false);
    assert_int_equal(b.count, 3);
    const uint32_t ends[] = {4, 8, 11}, corners[] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2};
    assert_memory_equal(b.ends, ends, sizeof ends);
    assert_memory_equal(b.corners, corners, sizeof corners);
    bends_free(&b);
}

// The side of the two triangles that both have.
static void check_diagonal(const struct vec3 *corners, bool clockwise, uint32_t from, uint32_t to)
{
    struct bends b = {0};
    bend_face(&b, corners, 4, clockwise);
    assert_int_equal(b.count, 2);
    assert_int_equal(b.corner_count, 6);
    uint32_t found[4] = {0};
    for (uint32_t i = 0; i < 6; i++)
        found[b.corners[i]]++;
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(found[i], i == from || i == to ? 2 : 1);
    bends_free(&b);
}

static void a_cell_bends_a_face_outwards(void **state)
{
    (void)state;
    struct vec3 bent[4];
    memcpy(bent, square, sizeof bent);
    bent[2].z += 0x1p-20;
    check_diagonal(bent, false, 0, 2);
    check_diagonal(bent, true, 1, 3); // seen from below, it is a valley
}

// In 2021.01 the union of sphere(13) and a cube elsewhere has 820 facets, 6 of them the cube's.
static void spheres_have_the_parts_of_openscad(void **state)
{
    (void)state;
    struct mesh m;
    struct bends b = {0};
    primitive_sphere(&m, 30);
    for (uint32_t t = 0; t + 1 < m.triangle_count; t++) {
        const uint32_t *one = m.triangles[t], *other = m.triangles[t + 1];
        bool quad = m.faces[t] == m.faces[t + 1] && (t == 0 || m.faces[t] != m.faces[t - 1]) &&
                    (t + 2 == m.triangle_count || m.faces[t] != m.faces[t + 2]);
        const uint32_t around[4] = {one[0], one[1], other[1], one[2]};
        struct vec3 corners[4];
        for (int i = 0; i < 4; i++)
            corners[i] = vec3_scale(m.vertices[around[i]], 13);
        if (quad)
            bend_face(&b, corners, 4, false);
    }
    assert_int_equal(b.count + 2, 814); // caps are level
    bends_free(&b);
    mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flat_faces_are_one_part),
                                       cmocka_unit_test(a_cell_bends_a_face_outwards),
                                       cmocka_unit_test(spheres_have_the_parts_of_openscad)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
