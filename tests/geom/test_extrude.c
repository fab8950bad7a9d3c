// test_extrude.c - extrusions have OpenSCAD's vertices, slices and volumes, and are closed.
#include "geom/extrude.h"
#include "unit.h"

static void add_path(struct outline *o, const double (*points)[2], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        outline_add(o, (struct vec2){points[i][0], points[i][1]});
    outline_close(o);
    o->clean = true;
}

static struct outline square(double x, double y, double size)
{
    struct outline o = {0};
    add_path(&o, (double[][2]){{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}, 4);
    return o;
}

static struct outline frame(void)
{
    struct outline o = square(0, 0, 4);
    add_path(&o, (double[][2]){{1, 1}, {1, 2}, {2, 2}, {2, 1}}, 4);
    return o;
}

static struct linear_extrusion linear(double height, double twist, double x, double y)
{
    return (struct linear_extrusion){
        .height = height, .twist = twist, .scale_x = x, .scale_y = y, .detail = DETAIL_DEFAULT};
}

// Both take the outline.
static struct mesh raise(struct outline o, struct linear_extrusion how, bool convex)
{
    struct mesh m;
    bool found;
    struct error err;
    assert_true(extrude_linear(&m, &o, &how, &found, &err));
    assert_int_equal(found, convex);
    assert_true(mesh_is_closed(&m));
    outline_free(&o);
    return m;
}

static struct mesh turn(struct outline o, struct rotation_extrusion how)
{
    struct mesh m;
    struct error err;
    assert_true(extrude_rotate(&m, &o, &how, &err));
    outline_free(&o);
    return m;
}

static void check_counts(struct mesh m, uint32_t vertices, uint32_t triangles, uint32_t faces)
{
    assert_int_equal(m.vertex_count, vertices);
    assert_int_equal(m.triangle_count, triangles);
    assert_int_equal(m.face_count, faces);
    mesh_free(&m);
}

static void check_volume(struct mesh m, double volume)
{
    assert_close(mesh_volume(&m), volume, 1e-4 * volume);
    mesh_free(&m);
}

static void prisms_have_whole_faces(void **state)
{
    (void)state;
    check_counts(raise(square(0, 0, 1), linear(2, 0, 1, 1), true), 8, 12, 6);
    check_counts(raise(square(0, 0, 1), linear(2, 0, 0, 0), true), 5, 6, 5);
    struct linear_extrusion how = linear(2, 0, 3, 3);
    how.slices = 3;
    check_counts(raise(square(0, 0, 1), how, true), 16, 28, 6);
    how.center = true;
    struct mesh m = raise(square(0, 0, 1), how, true);
    assert_true(mesh_has_vertex(&m, 3, 3, 1));
    assert_true(mesh_has_vertex(&m, 1, 1, -1));
    mesh_free(&m);
    check_counts(raise(frame(), linear(2, 0, 1, 1), false), 16, 32, 10);
}

static void twisted_and_scaled(void **state)
{
    (void)state;
    struct linear_extrusion how = linear(2, 90, 1, 1);
    how.slices = 1;
    struct mesh m = raise(square(1, 0, 1), how, false);
    assert_true(mesh_has_vertex(&m, 0, -1, 2));
    assert_true(mesh_has_vertex(&m, 1, -2, 2));
    check_counts(m, 8, 12, 10);
    check_volume(raise(frame(), linear(2, 100, 1, 1), false), 32.6391);
    check_volume(raise(square(0, 0, 2), linear(2, 30, 1, 1), false), 8.5993);
    check_volume(raise(square(-2, -2, 4), linear(2, 0, 0, 1), false), 16);
    check_counts(raise(square(0, 0, 1), linear(2, 0, 0, 1), false), 10, 16, 9);
    // OpenSCAD leaves this one open.
    struct outline triangle = {0};
    add_path(&triangle, (double[][2]){{0, 0}, {2, 1}, {1, 3}}, 3);
    m = raise(triangle, linear(2, 0, 0, 1), false);
    assert_int_equal(m.vertex_count, 9);
    mesh_free(&m);
}

static void slices_follow_the_rules(void **state)
{
    (void)state;
    struct linear_extrusion how = linear(10, 90, 1, 1);
    check_counts(raise(square(0, 0, 10), how, false), 36, 68, 66);
    how.detail.fn = 20;
    check_counts(raise(square(0, 0, 10), how, false), 24, 44, 42);
    check_counts(raise(square(0, 0, 10), linear(10, 90, 2, 2), false), 36, 68, 66);
    check_counts(raise(square(0, 0, 10), linear(10, 0, 1, 2), false), 36, 68, 34);
}

static void newer_programs_cut_edges(void **state)
{
    (void)state;
    struct linear_extrusion how = linear(2, 30, 1, 1);
    how.newer = true;
    struct mesh m = raise(square(0, 0, 10), how, false);
    assert_int_equal(m.vertex_count, 80); // five pieces a side, three slices
    assert_true(mesh_has_vertex(&m, 4, 0, 0));
    mesh_free(&m);
    how.segments_given = true;
    m = raise(square(0, 0, 10), how, false);
    assert_int_equal(m.vertex_count, 16);
    mesh_free(&m);
    how = linear(2, 0, 1, 1);
    how.newer = how.segments_given = true;
    how.segments = 11; // all four sides twice, not three times
    m = raise(square(0, 0, 10), how, true);
    assert_int_equal(m.vertex_count, 16);
    mesh_free(&m);
    how = linear(5, 0, 1, 1);
    how.newer = how.has_direction = how.center = true;
    how.direction = (struct vec3){3, 0, 4};
    m = raise(square(0, 0, 1), how, true);
    assert_true(mesh_has_vertex(&m, 2.5, 1, 2));
    assert_true(mesh_has_vertex(&m, -1.5, 0, -2));
    check_volume(m, 4);
}

static void nothing_rises_from_bad_numbers(void **state)
{
    (void)state;
    check_counts(raise(square(0, 0, 1), linear(0, 0, 1, 1), false), 0, 0, 0);
    check_counts(raise(square(0, 0, 1), linear(-1, 0, 1, 1), false), 0, 0, 0);
    check_counts(raise(square(0, 0, 1), linear(1, NAN, 1, 1), false), 0, 0, 0);
    check_counts(raise(square(0, 0, INFINITY), linear(1, 0, 1, 1), false), 0, 0, 0);
    check_counts(raise((struct outline){0}, linear(1, 0, 1, 1), false), 0, 0, 0);
    struct outline o = square(0, 0, 1);
    struct linear_extrusion how = linear(1, 1e12, 1, 1);
    struct mesh m;
    bool convex;
    struct error err;
    assert_false(extrude_linear(&m, &o, &how, &convex, &err));
    how = linear(1, 10, 1, 1);
    how.newer = how.segments_given = true;
    how.segments = UINT32_MAX;
    how.slices = 1000;
    assert_false(extrude_linear(&m, &o, &how, &convex, &err));
    outline_free(&o);
}

static void full_turns(void **state)
{
    (void)state;
    struct rotation_extrusion how = {.angle = 360, .detail = {3, 12, 2}};
    struct mesh m = turn(square(1, 0, 1), how);
    assert_true(mesh_is_closed(&m));
    assert_true(mesh_has_vertex(&m, -1, 0, 0));
    assert_true(mesh_has_vertex(&m, 0.5, 0.8660254, 1));
    check_counts(m, 12, 24, 12);
    how.newer = true; // begins at +x
    m = turn(square(1, 0, 1), how);
    assert_true(mesh_has_vertex(&m, 1, 0, 0));
    mesh_free(&m);
    how = (struct rotation_extrusion){.angle = 360, .detail = {8, 12, 2}};
    check_volume(turn(square(1, 0, 1), how), 8.4853);
    check_volume(turn(square(-2, 0, 1), how), 8.4853);
    m = turn(square(0, 0, 1), how); // on the axis
    assert_true(mesh_is_closed(&m));
    check_counts(m, 18, 32, 24);
}

static void parts_of_a_turn(void **state)
{
    (void)state;
    for (int side = 0; side < 2; side++)
        for (int back = 0; back < 2; back++) {
            struct rotation_extrusion how = {.angle = back ? -90 : 90, .detail = {8, 12, 2}};
            struct mesh m = turn(square(side ? -2 : 1, 0, 1), how);
            assert_true(mesh_is_closed(&m));
            assert_true(mesh_has_vertex(&m, side ? -1 : 1, 0, 0));
            assert_true(mesh_has_vertex(&m, 0, side == back ? 1 : -1, 0));
            check_volume(m, 2.1213);
        }
    struct rotation_extrusion how = {.angle = 90, .detail = {4, 12, 2}};
    check_counts(turn(square(1, 0, 1), how), 8, 12, 6);
    how = (struct rotation_extrusion){.angle = 100, .detail = {10, 12, 2}};
    check_counts(turn(square(1, 0, 1), how), 12, 20, 10); // 2.8 pieces are two ...
    how.newer = true;
    check_counts(turn(square(1, 0, 1), how), 16, 28, 14); // ... or three
}

static void refused_turns(void **state)
{
    (void)state;
    struct rotation_extrusion how = {.angle = 360, .detail = DETAIL_DEFAULT};
    struct mesh m;
    struct error err;
    struct outline o = square(-1, 0, 3);
    assert_false(extrude_rotate(&m, &o, &how, &err));
    outline_free(&o);
    how.detail.fn = 1e12;
    o = square(1, 0, 3);
    assert_false(extrude_rotate(&m, &o, &how, &err));
    outline_free(&o);
    how.angle = 0;
    check_counts(turn(square(1, 0, 3), how), 0, 0, 0);
}

static void plates(void **state)
{
    (void)state;
    struct outline o = square(0, 0, 2), holed = frame();
    struct mesh m;
    bool convex;
    extrude_slab(&m, &o, -0.5, 0.5, &convex);
    assert_true(convex && mesh_is_closed(&m));
    assert_true(mesh_has_vertex(&m, 2, 2, 0.5));
    check_counts(m, 8, 12, 6);
    extrude_slab(&m, &holed, -0.55, 0.55, &convex);
    assert_true(!convex && mesh_is_closed(&m));
    check_volume(m, 16.5);
    outline_free(&o);
    outline_free(&holed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prisms_have_whole_faces),
        cmocka_unit_test(twisted_and_scaled),
        cmocka_unit_test(slices_follow_the_rules),
        cmocka_unit_test(newer_programs_cut_edges),
        cmocka_unit_test(nothing_rises_from_bad_numbers),
        cmocka_unit_test(full_turns),
        cmocka_unit_test(parts_of_a_turn),
        cmocka_unit_test(refused_turns),
        cmocka_unit_test(plates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
