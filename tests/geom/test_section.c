// test_section.c - sections and shadows against OpenSCAD's projection() (openscad -o x.svg).
#include "geom/boolean.h"
#include "geom/section.h"
#include "shapes.h"

static struct mesh drilled_block(void)
{
    struct mesh a = block(0, 0, 0, 10, 10, 10), b = block(3, 3, -1, 2, 2, 20), m;
    struct error err;
    assert_true(boolean_mesh(&m, BOOLEAN_DIFFERENCE, &a, &b, &err));
    mesh_free(&b);
    mesh_free(&a);
    return m;
}

typedef bool flat(struct outline *out, const struct mesh *m);

// Frees the mesh. Points, of which OpenSCAD writes six digits, come in any order.
static void check(flat *project, struct mesh m, uint32_t paths, uint32_t points,
                  const struct vec2 *expected, double area)
{
    struct outline o;
    assert_true(project(&o, &m));
    assert_true(o.clean);
    assert_int_equal(o.path_count, paths);
    assert_int_equal(o.point_count, points);
    assert_close(outline_area(&o), area, 1e-5 * area);
    for (uint32_t i = 0; expected && i < points; i++) {
        bool found = false;
        for (uint32_t j = 0; j < points; j++)
            found |= fabs(o.points[j].x - expected[i].x) < 8e-5 &&
                     fabs(o.points[j].y - expected[i].y) < 8e-5;
        if (!found)
            fail_msg("no point %g, %g", expected[i].x, expected[i].y);
    }
    outline_free(&o);
    mesh_free(&m);
}

static const struct vec2 square[4] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

static void faces_in_the_plane_count_from_both_sides(void **state)
{
    (void)state;
    check(section_cut, block(0, 0, 0, 10, 10, 10), 1, 4, square, 100);
    check(section_cut, block(0, 0, -10, 10, 10, 10), 1, 4, square, 100);
    check(section_cut, block(0, 0, -5, 10, 10, 10), 1, 4, square, 100);
    check(section_cut, block(0, 0, 1, 10, 10, 10), 0, 0, NULL, 0);
}

static void vertices_and_edges_in_the_plane_make_nothing(void **state)
{
    (void)state;
    struct mesh on_edge = block(0, 0, 0, 10, 10, 10), on_corner = block(0, 0, 0, 10, 10, 10);
    place(&on_edge, (struct affine){{{1, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 1, 10}}});
    check(section_cut, on_edge, 0, 0, NULL, 0);
    place(&on_corner, (struct affine){{{1, 0, -1, 0}, {0, 1, -1, 0}, {1, 1, 1, 0}}});
    check(section_cut, on_corner, 0, 0, NULL, 0);
}

static void edges_in_the_plane_are_crossed(void **state)
{
    (void)state;
    static const struct vec2 expected[4] = {{0, 0}, {14.1421, 0}, {14.1421, 10}, {0, 10}};
    struct mesh m = block(0, 0, 0, 10, 10, 10);
    place(&m, rotation(0, 45, 0));
    check(section_cut, m, 1, 4, expected, 141.421);
}

static void sections_keep_holes(void **state)
{
    (void)state;
    static const struct vec2 expected[8] = {{0, 0}, {10, 0}, {10, 10}, {0, 10},
                                            {3, 3}, {5, 3},  {5, 5},   {3, 5}};
    struct mesh m = drilled_block();
    place(&m, (struct affine){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -5}}});
    check(section_cut, m, 2, 8, expected, 96);
    check(section_cut, drilled_block(), 2, 8, expected, 96);
    check(section_shadow, drilled_block(), 2, 8, expected, 96);
}

// OpenSCAD's have more points, almost on straight lines, since it cuts corners off to a grid.
static void sections_of_spheres(void **state)
{
    (void)state;
    check(section_cut, ball(30, 10, 0, 0, 9), 1, 30, NULL, 55.9847);
    check(section_cut, ball(30, 10, 0, 0, 7), 1, 30, NULL, 156.318);
}

static void shadows_of_tilted_solids(void **state)
{
    (void)state;
    static const struct vec2 hexagon[6] = {{7.40842, 1.0504},   {12.3325, 6.91864},
                                           {7.76421, 14.9474},  {0.355774, 13.897},
                                           {-4.56825, 8.02872}, {0, 0}};
    struct mesh m = drilled_block();
    place(&m, rotation(30, 40, 50));
    check(section_shadow, m, 1, 6, hexagon, 168.923);
    static const struct vec2 dodecagon[12] = {
        {5.82962, -6.36516}, {9.36516, -2.82962},  {10.6593, 2},         {9.36516, 6.82962},
        {5.82962, 10.3652},  {1, 11.6593},         {-3.82962, 10.3652},  {-7.36516, 6.82962},
        {-8.65926, 2},       {-7.36516, -2.82962}, {-3.82962, -6.36516}, {1, -7.65926}};
    check(section_shadow, ball(12, 10, 1, 2, 3), 1, 12, dodecagon, 279.904);
}

// OpenSCAD shows the one triangle of projection() polyhedron(..., faces = [[0, 1, 2]]) too.
static void shadows_of_open_meshes_have_both_sides(void **state)
{
    (void)state;
    static const struct vec2 expected[3] = {{0, 0}, {10, 0}, {10, 10}};
    for (int turned = 0; turned < 2; turned++) {
        struct mesh_builder b = {0};
        mesh_add_vertex(&b, (struct vec3){0, 0, 0});
        mesh_add_vertex(&b, (struct vec3){10, 0, 0});
        mesh_add_vertex(&b, (struct vec3){10, 10, 3});
        mesh_add_triangle(&b, 0, turned ? 2 : 1, turned ? 1 : 2, mesh_add_face(&b));
        check(section_shadow, b.mesh, 1, 3, expected, 50);
    }
}

static void open_and_hostile_meshes_have_no_section(void **state)
{
    (void)state;
    struct mesh open = block(0, 0, -5, 10, 10, 10), m = block(0, 0, -5, 10, 10, 10), none = {0};
    open.triangle_count -= 7;
    struct outline o;
    assert_true(section_cut(&o, &open));
    outline_free(&o);
    m.vertices[0].x = 1e300;
    assert_false(section_shadow(&o, &m));
    assert_int_equal(o.point_count, 0);
    m.vertices[0].x = NAN;
    section_cut(&o, &m);
    outline_free(&o);
    check(section_cut, none, 0, 0, NULL, 0);
    check(section_shadow, none, 0, 0, NULL, 0);
    mesh_free(&m);
    mesh_free(&open);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_in_the_plane_count_from_both_sides),
        cmocka_unit_test(vertices_and_edges_in_the_plane_make_nothing),
        cmocka_unit_test(edges_in_the_plane_are_crossed),
        cmocka_unit_test(sections_keep_holes),
        cmocka_unit_test(sections_of_spheres),
        cmocka_unit_test(shadows_of_tilted_solids),
        cmocka_unit_test(shadows_of_open_meshes_have_both_sides),
        cmocka_unit_test(open_and_hostile_meshes_have_no_section),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
