// test_outline.c - flat shapes.
#include "geom/outline.h"
#include "unit.h"

static void add_path(struct outline *o, const struct vec2 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        outline_add(o, points[i]);
    outline_close(o);
}

static const struct vec2 square[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
static const struct vec2 hole[] = {{0.5, 0.5}, {0.5, 1}, {1, 1}, {1, 0.5}};

static void paths_follow_each_other(void **state)
{
    (void)state;
    struct outline o = {0};
    add_path(&o, square, 4);
    add_path(&o, hole, 2); // too short
    outline_close(&o);     // nothing at all
    add_path(&o, hole, 4);
    assert_int_equal(o.path_count, 2);
    assert_int_equal(o.point_count, 8);
    assert_int_equal(o.ends[0], 4);
    assert_int_equal(o.ends[1], 8);
    assert_close(o.points[4].x, 0.5, 0);
    assert_close(outline_area(&o), 4 - 0.25, 1e-15);
    outline_free(&o);
    outline_free(&o);
    assert_null(o.points);
}

static void copies_are_equal_and_apart(void **state)
{
    (void)state;
    struct outline a = {.clean = true}, b, empty = {0};
    add_path(&a, square, 4);
    outline_copy(&b, &a);
    assert_true(b.clean);
    assert_int_equal(outline_hash(&a), outline_hash(&b));
    outline_append(&b, &empty);
    assert_int_equal(outline_hash(&a), outline_hash(&b));
    outline_append(&b, &a);
    assert_int_equal(b.path_count, 2);
    assert_int_equal(b.ends[1], 8);
    assert_true(outline_hash(&a) != outline_hash(&b));
    assert_true(outline_hash(&a) != outline_hash(&empty));
    a.points[2].x = 3;
    assert_close(b.points[2].x, 2, 0);
    assert_close(b.points[6].x, 2, 0);
    outline_free(&a);
    outline_free(&b);

    outline_copy(&b, &empty);
    assert_int_equal(b.path_count, 0);
    assert_true(box_is_empty(outline_bounds(&b)));
    assert_close(outline_area(&b), 0, 0);
    outline_free(&b);
}

static void maps_lose_the_third_coordinate(void **state)
{
    (void)state;
    struct outline o = {.clean = true};
    add_path(&o, square, 4);
    struct affine a = {{{2, 0, 9, 1}, {0, 0.5, 9, -1}, {9, 9, 9, 9}}};
    outline_transform(&o, &a);
    assert_true(o.clean);
    struct box b = outline_bounds(&o);
    assert_close(b.min.x, 1, 0);
    assert_close(b.max.x, 5, 0);
    assert_close(b.min.y, -1, 0);
    assert_close(b.max.y, 0, 0);
    assert_close(b.min.z, 0, 0);
    assert_close(b.max.z, 0, 0);
    assert_close(outline_area(&o), 4, 1e-15);

    struct affine mirror = {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    outline_transform(&o, &mirror);
    assert_false(o.clean);
    assert_close(outline_area(&o), -4, 1e-15);
    outline_free(&o);
}

static bool is_convex(const struct vec2 *points, uint32_t count)
{
    struct outline o = {0};
    add_path(&o, points, count);
    bool convex = outline_is_convex(&o);
    outline_free(&o);
    return convex;
}

static void dents_and_turns_are_not_convex(void **state)
{
    (void)state;
    assert_true(is_convex(square, 4));
    assert_false(is_convex(hole, 4)); // clockwise
    const struct vec2 on_sides[] = {{1, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {1, 0}};
    assert_true(is_convex(on_sides, 7));
    const struct vec2 dart[] = {{0, 0}, {4, 0}, {1, 1}, {0, 4}};
    assert_false(is_convex(dart, 4));
    const struct vec2 spike[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, -1}};
    assert_false(is_convex(spike, 5));
    const struct vec2 flat[] = {{0, 0}, {1, 1}, {2, 2}};
    assert_false(is_convex(flat, 3));
    const struct vec2 point[] = {{1, 1}, {1, 1}, {1, 1}};
    assert_false(is_convex(point, 3));
    const struct vec2 unknown[] = {{0, 0}, {2, 0}, {NAN, 2}, {0, 2}};
    assert_false(is_convex(unknown, 4));

    struct vec2 star[5], circle[1000]; // the star turns left everywhere
    for (int i = 0; i < 5; i++)
        star[i] = (struct vec2){cos(i * 4 * M_PI / 5), sin(i * 4 * M_PI / 5)};
    for (int i = 0; i < 1000; i++)
        circle[i] = (struct vec2){9 + cos(i * M_PI / 500), sin(i * M_PI / 500) - 70};
    assert_false(is_convex(star, 5));
    assert_true(is_convex(circle, 1000));

    struct outline two = {0};
    add_path(&two, square, 4);
    add_path(&two, hole, 4);
    assert_false(outline_is_convex(&two));
    outline_free(&two);
}

static void area_is_exact_far_away(void **state)
{
    (void)state;
    struct outline o = {0};
    add_path(&o, square, 4);
    struct affine far = {{{1, 0, 0, 1e12}, {0, 1, 0, -1e12}, {0, 0, 1, 0}}};
    outline_transform(&o, &far);
    assert_close(outline_area(&o), 4, 0);
    outline_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_follow_each_other),
        cmocka_unit_test(copies_are_equal_and_apart),
        cmocka_unit_test(maps_lose_the_third_coordinate),
        cmocka_unit_test(dents_and_turns_are_not_convex),
        cmocka_unit_test(area_is_exact_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
