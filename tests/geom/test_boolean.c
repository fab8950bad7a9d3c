// test_boolean.c - meshes of booleans against OpenSCAD's (openscad --render -o x.off).
#include "base/hash.h"
#include "geom/boolean.h"
#include "shapes.h"

static struct mesh tilted_cube(double size)
{
    struct mesh m = block(-size / 2, -size / 2, -size / 2, size, size, size);
    place(&m, rotation(30, 40, 50));
    return m;
}

static struct mesh drill(double z, double h)
{
    struct mesh m;
    primitive_cylinder(&m, 12, 3, 3);
    place_sized(&m, (struct vec3){1, 1, h}, (struct vec3){5, 5, z});
    return m;
}

// Every edge is run through as often in one direction as in the other; edges may be shared by more
// than two triangles where the solid touches itself.
static void assert_bounds(const struct mesh *m)
{
    size_t count = (size_t)m->triangle_count * 3;
    uint32_t(*edges)[2] = mem_alloc((count + 1) * sizeof *edges);
    uint32_t(*back)[2] = mem_alloc((count + 1) * sizeof *back);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        assert_in_range(m->faces[t], 0, m->face_count - 1);
        for (int i = 0; i < 3; i++) {
            uint32_t from = m->triangles[t][i], to = m->triangles[t][(i + 1) % 3];
            assert_true(from < m->vertex_count && from != to);
            edges[3 * t + (uint32_t)i][0] = back[3 * t + (uint32_t)i][1] = from;
            edges[3 * t + (uint32_t)i][1] = back[3 * t + (uint32_t)i][0] = to;
        }
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    qsort(back, count, sizeof *back, compare_edges);
    assert_memory_equal(edges, back, count * sizeof *edges);
    free(back);
    free(edges);
}

static struct mesh combined(enum boolean_op op, const struct mesh *a, const struct mesh *b)
{
    struct mesh m;
    struct error err = {""};
    if (!boolean_mesh(&m, op, a, b, &err))
        fail_msg("%s", err.text);
    assert_bounds(&m);
    return m;
}

// Frees all; the numbers are OpenSCAD's, which has more corners where cutting them off to a grid
// has bent a face; there the caller says 0.
static void check(enum boolean_op op, struct mesh a, struct mesh b, uint32_t vertices,
                  uint32_t triangles, double volume)
{
    struct mesh m = combined(op, &a, &b);
    assert_close(mesh_volume(&m), volume, 2e-6 * volume);
    if (vertices) {
        assert_int_equal(m.vertex_count, vertices);
        assert_int_equal(m.triangle_count, triangles);
    }
    mesh_free(&m);
    mesh_free(&b);
    mesh_free(&a);
}

static void blocks_that_share_planes(void **state)
{
    (void)state;
    check(BOOLEAN_UNION, block(0, 0, 0, 10, 10, 10), block(10, 2, 3, 5, 5, 5), 16, 28, 1125);
    check(BOOLEAN_DIFFERENCE, block(0, 0, 0, 10, 10, 10), block(2, 2, 5, 5, 5, 5), 16, 28, 875);
    check(BOOLEAN_UNION, block(0, 0, 0, 10, 10, 10), block(5, 0, 0, 10, 10, 10), 8, 12, 1500);
    check(BOOLEAN_UNION, block(0, 0, 0, 10, 10, 10), block(10, 10, 0, 10, 10, 10), 14, 24, 2000);
    check(BOOLEAN_UNION, block(0, 0, 0, 10, 10, 10), block(10, 10, 10, 10, 10, 10), 15, 24, 2000);
    check(BOOLEAN_DIFFERENCE, block(0, 0, 0, 10, 10, 10), block(2, 2, 2, 4, 4, 4), 16, 24, 936);
}

static void cylinders_drill_blocks(void **state)
{
    (void)state;
    check(BOOLEAN_DIFFERENCE, block(0, 0, 0, 10, 10, 10), drill(-1, 12), 32, 64, 729.999606);
    check(BOOLEAN_DIFFERENCE, block(0, 0, 0, 10, 10, 10), drill(0, 10), 32, 64, 729.999606);
}

static void spheres_cross_cubes_and_spheres(void **state)
{
    (void)state;
    check(BOOLEAN_INTERSECTION, ball(24, 6, 0, 0, 0), tilted_cube(10), 0, 0, 784.84011);
    check(BOOLEAN_DIFFERENCE, ball(24, 6, 0, 0, 0), tilted_cube(9), 0, 0, 214.409912);
    check(BOOLEAN_UNION, ball(45, 6, 0, 0, 0), ball(45, 6, 1, 2, 3), 0, 0, 1304.67884);
}

static void flat_faces_have_one_number(void **state)
{
    (void)state;
    struct mesh a = block(0, 0, 0, 10, 10, 10), b = block(5, 0, 0, 10, 10, 10), c = drill(-1, 12);
    struct mesh m = combined(BOOLEAN_UNION, &a, &b);
    assert_int_equal(m.face_count, 6);
    struct mesh drilled = combined(BOOLEAN_DIFFERENCE, &m, &c);
    assert_int_equal(drilled.face_count, 18);
    assert_true(mesh_is_closed(&drilled));
    mesh_free(&drilled);
    mesh_free(&m);
    mesh_free(&c);
    mesh_free(&b);
    mesh_free(&a);
}

static void nothing_is_an_operand_and_a_result(void **state)
{
    (void)state;
    struct mesh a = ball(20, 1, 0, 0, 0), none = {0};
    struct mesh m = combined(BOOLEAN_DIFFERENCE, &a, &a);
    assert_int_equal(m.triangle_count, 0);
    m = combined(BOOLEAN_INTERSECTION, &a, &none);
    assert_int_equal(m.triangle_count, 0);
    m = combined(BOOLEAN_DIFFERENCE, &none, &a);
    assert_int_equal(m.triangle_count, 0);
    m = combined(BOOLEAN_UNION, &none, &none);
    assert_int_equal(m.triangle_count, 0);
    m = combined(BOOLEAN_UNION, &none, &a);
    assert_int_equal(m.vertex_count, a.vertex_count);
    assert_close(mesh_volume(&m), mesh_volume(&a), 1e-12);
    mesh_free(&m);
    mesh_free(&a);
}

static void mirrored_operands_bound_the_same(void **state)
{
    (void)state;
    struct mesh a = block(0, 0, 0, -10, 10, 10), b = block(-7, 2, 2, 8, 4, 4);
    assert_true(mesh_volume(&a) < 0);
    check(BOOLEAN_DIFFERENCE, a, b, 16, 28, 888);
}

static void flip(struct mesh *m, uint32_t t)
{
    uint32_t corner = m->triangles[t][1];
    m->triangles[t][1] = m->triangles[t][2];
    m->triangles[t][2] = corner;
}

static void triangles_may_disagree_on_the_outside(void **state)
{
    (void)state;
    struct mesh a = block(0, 0, 0, 10, 10, 10), b = block(2, 2, 5, 5, 5, 5);
    flip(&a, 3);
    flip(&b, 0);
    flip(&b, 7);
    check(BOOLEAN_DIFFERENCE, a, b, 16, 28, 875);
}

static void open_operands_are_errors(void **state)
{
    (void)state;
    struct mesh a = block(0, 0, 0, 1, 1, 1), b = block(0, 0, 0, 2, 2, 2), m;
    struct error err;
    b.triangle_count--;
    assert_false(boolean_mesh(&m, BOOLEAN_UNION, &a, &b, &err));
    assert_string_equal(err.text, "the second operand is not closed");
    assert_int_equal(m.triangle_count, 0);
    assert_false(boolean_mesh(&m, BOOLEAN_UNION, &b, &a, &err));
    assert_string_equal(err.text, "the first operand is not closed");
    a.vertices[0].x = NAN;
    assert_false(boolean_mesh(&m, BOOLEAN_UNION, &a, &b, &err));
    assert_string_equal(err.text, "the first operand has corners out of range");
    mesh_free(&b);
    mesh_free(&a);
}

// Two blocks as one mesh, that cross each other: inside is what either contains.
static void operands_may_cross_themselves(void **state)
{
    (void)state;
    struct mesh_builder both = {0};
    for (int i = 0; i < 2; i++) {
        struct mesh m = block(i, i, i, 2, 2, 2);
        uint32_t first = both.mesh.vertex_count;
        for (uint32_t v = 0; v < m.vertex_count; v++)
            mesh_add_vertex(&both, m.vertices[v]);
        for (uint32_t t = 0; t < m.triangle_count; t++) {
            const uint32_t *c = m.triangles[t];
            mesh_add_triangle(&both, first + c[0], first + c[1], first + c[2],
                              mesh_add_face(&both));
        }
        mesh_free(&m);
    }
    check(BOOLEAN_DIFFERENCE, both.mesh, block(-1, -1, -1, 2, 5, 5), 0, 0, 15 - 4);
}

enum { SIDE = 6 };

static bool applied(enum boolean_op op, bool a, bool b)
{
    return op == BOOLEAN_UNION ? a || b : op == BOOLEAN_INTERSECTION ? a && b : a && !b;
}

// A chain of booleans of random blocks with whole coordinates against cubes counted one by one;
// turned, so that each step starts from rounded corners, or not, so that all faces coincide.
static void chain(uint64_t *random, const struct affine *turn)
{
    bool filled[SIDE][SIDE][SIDE] = {{{0}}};
    struct mesh m = {0};
    for (int step = 0; step < 9; step++) {
        enum boolean_op op = step < 3 ? BOOLEAN_UNION : (enum boolean_op)(step % 3);
        int low[3], size[3], from = op == BOOLEAN_INTERSECTION ? 2 : SIDE;
        for (int i = 0; i < 3; i++) {
            low[i] = (int)(random_next(random) % (uint64_t)from);
            int most = SIDE - low[i], least = op == BOOLEAN_INTERSECTION ? most - 1 : 1;
            size[i] = least + (int)(random_next(random) % (uint64_t)(most - least + 1));
        }
        struct mesh b = block(low[0], low[1], low[2], size[0], size[1], size[2]);
        place(&b, *turn);
        struct mesh next = combined(op, &m, &b);
        mesh_free(&b);
        mesh_free(&m);
        m = next;
        int count = 0;
        for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
            int at[3] = {i / SIDE / SIDE, i / SIDE % SIDE, i % SIDE};
            bool in = true, *cube = &filled[at[0]][at[1]][at[2]];
            for (int k = 0; k < 3; k++)
                in &= at[k] >= low[k] && at[k] < low[k] + size[k];
            count += *cube = applied(op, *cube, in);
        }
        assert_close(mesh_volume(&m), count, 1e-9);
    }
    mesh_free(&m);
}

static void chains_of_blocks_fill_what_they_should(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int round = 0; round < 30; round++) {
        struct affine turn = rotation(17 + round, 29 * round, 53 * round);
        chain(&random, &AFFINE_IDENTITY);
        if (round % 8 == 0)
            chain(&random, &turn);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_that_share_planes),
        cmocka_unit_test(cylinders_drill_blocks),
        cmocka_unit_test(spheres_cross_cubes_and_spheres),
        cmocka_unit_test(flat_faces_have_one_number),
        cmocka_unit_test(nothing_is_an_operand_and_a_result),
        cmocka_unit_test(mirrored_operands_bound_the_same),
        cmocka_unit_test(triangles_may_disagree_on_the_outside),
        cmocka_unit_test(open_operands_are_errors),
        cmocka_unit_test(operands_may_cross_themselves),
        cmocka_unit_test(chains_of_blocks_fill_what_they_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
