// test_extent.c - boxes of what is solid against what is known of the shapes.
#include "render/extent.h"
#include "unit.h"

#define TURNED      "multmatrix([[0.6,-0.8,0,0],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]]) "
#define AT(x, y, z) "multmatrix([[1,0,0," #x "],[0,1,0," #y "],[0,0,1," #z "],[0,0,0,1]]) "

static struct box extent_of(const char *text, uint32_t threads)
{
    struct stage s;
    stage_make_as(&s, MODEL_RENDER, text);
    s.settings.threads = threads;
    struct box box = extent_find(s.device, &s.model, &s.settings);
    stage_free(&s);
    return box;
}

static void expect(const char *text, struct vec3 min, struct vec3 max)
{
    struct box found = extent_of(text, 2), again = extent_of(text, 1);
    assert_memory_equal(&found, &again, sizeof found);
    double most = EXTENT_TOLERANCE * vec3_length(vec3_sub(max, min));
    double off = fmax(vec3_length(vec3_sub(found.min, min)), vec3_length(vec3_sub(found.max, max)));
    if (!(off <= 2 * most))
        fail_msg("(%.9g %.9g %.9g) - (%.9g %.9g %.9g): %s", found.min.x, found.min.y, found.min.z,
                 found.max.x, found.max.y, found.max.z, text);
}

static void unions_have_the_box_of_their_corners(void **state)
{
    (void)state;
    struct box b = extent_of(TURNED "cube(10); " AT(20, 0, 0) "sphere(1, $fn = 4);", 1);
    assert_true(b.min.x == -8 && b.min.y == -0.7071067811865476 && b.min.z < 0);
    assert_true(b.max.x > 20 && b.max.y == 14 && b.max.z == 10);
}

static void what_is_cut_off_does_not_count(void **state)
{
    (void)state;
    double r = 10 * cos(M_PI / 64); // of the ring next to the equator
    expect(
        "difference() { sphere(10, $fn = 64); " AT(5, 0, 0) "cube([10, 40, 40], center = true);" AT(
            0, 0, 11) "cube([100, 100, 10], center = true); }",
        (struct vec3){-r, -r, -r}, (struct vec3){0, r, 6});
    expect("difference() { cube(10); " AT(7, -1, -1) "cube(20); " AT(-1, 8, -1) "cube(20); }",
           (struct vec3){0, 0, 0}, (struct vec3){7, 8, 10});
    // A cube on its corner, its lower half taken away: the section is a hexagon.
    expect("intersection() { multmatrix([[0.707106781186548,-0.707106781186548,0,0],"
           "[0.408248290463863,0.408248290463863,-0.816496580927726,0],"
           "[0.577350269189626,0.577350269189626,0.577350269189626,0],[0,0,0,1]]) "
           "cube(2, center = true); " AT(-5, -5, 0) "cube(10); }",
           (struct vec3){-sqrt(2), -sqrt(1.5), 0},
           (struct vec3){sqrt(2), 2 * sqrt(2.0 / 3), sqrt(3)});
}

static void tips_are_found(void **state)
{
    (void)state;
    // Needles along all axes, with something taken from them, and a tip that two cones make.
    expect(
        "difference() { cylinder(h = 100, r1 = 2, r2 = 0, $fn = 20); " AT(0, 0, -1) "cube(10); }",
        (struct vec3){-2, -2, 0}, (struct vec3){2, 2, 100});
    expect("difference() { multmatrix([[0,0,1,0],[0,1,0,0],[-1,0,0,0],[0,0,0,1]]) "
           "cylinder(h = 100, r1 = 1, r2 = 0, $fn = 8); " AT(-1, 0, 0) "cube(3); }",
           (struct vec3){0, -1, -1}, (struct vec3){100, 1, 1});
    expect("intersection() { multmatrix([[1,0,0,-1.1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
           "cylinder(h = 10, r1 = 2, r2 = 0, $fn = 4); " AT(
               1.1, 0, 0) "cylinder(h = 10, r1 = 2, r2 = 0, $fn = 4); }",
           (struct vec3){-0.9, -0.9, 0}, (struct vec3){0.9, 0.9, 4.5});
}

static void thin_parts_count(void **state)
{
    (void)state;
    expect("difference() { cube(50); " AT(-1, -1, 1) "cube(60); } " AT(
               300, 20, 0) "intersection() { cube(10); " AT(-9.99, -9.99, 0) "cube(10); }",
           (struct vec3){0, 0, 0}, (struct vec3){300.01, 50, 10});
}

// A row of cubes whose outer ends are cut away, the outermost ones but for a plate.
static void many_parts_are_told_apart(void **state)
{
    (void)state;
    char text[8192];
    size_t used = 0;
    for (int i = 0; i < 30; i++) {
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "difference() { multmatrix([[1,0,0,%d],[0,1,0,%d],[0,0,1,0],"
                                 "[0,0,0,1]]) cube(8); " AT(-1, -1, 0.2) "cube([400, 400, %d]); }",
                                 10 * i, i, i % 10 ? 3 : 20);
        assert_true(used < sizeof text);
    }
    expect(text, (struct vec3){0, 0, 0}, (struct vec3){298, 37, 8});
}

static void nothing_is_empty(void **state)
{
    (void)state;
    assert_true(box_is_empty(extent_of("", 1)));
    assert_true(box_is_empty(extent_of("difference() { cube(1); cube(3, center = true); }", 1)));
    assert_true(box_is_empty(extent_of("intersection() { cube(1); " AT(2, 0, 0) "cube(1); }", 1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unions_have_the_box_of_their_corners),
        cmocka_unit_test(what_is_cut_off_does_not_count),
        cmocka_unit_test(tips_are_found),
        cmocka_unit_test(thin_parts_count),
        cmocka_unit_test(many_parts_are_told_apart),
        cmocka_unit_test(nothing_is_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
