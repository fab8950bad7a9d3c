// test_sheet.c - matrices that press a shape flat.
#include "base/angle.h"
#include "base/hash.h"
#include "model/sheet.h"
#include "unit.h"

static const struct box unit = {{0, 0, 0}, {1, 1, 1}};

static struct affine turned(double degrees, struct affine a)
{
    double c = cos_degrees(degrees), s = sin_degrees(degrees);
    struct affine z = {{{c, -s, 0, 1}, {s, c, 0, 2}, {0, 0, 1, 3}}};
    struct affine x = {{{1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0}}};
    struct affine zx = affine_mul(&z, &x);
    return affine_mul(&zx, &a);
}

static void scaling_is_not_flat(void **state)
{
    (void)state;
    struct affine a = {{{1e3, 0, 0, 5}, {0, 1e-6, 0, 5}, {0, 0, 1, 5}}};
    assert_false(sheet_is_flat(&a));
    a = turned(33, a);
    assert_false(sheet_is_flat(&a));
}

static void sheets_get_the_thickness_around_their_middle(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int turn = 0; turn < 200; turn++) {
        struct affine flat = {0};
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 4; j++)
                flat.m[i][j] = random_unit(&seed) * 8 - 4;
        struct affine a = turned(360 * random_unit(&seed), flat), before = a;
        if (turn & 1) // as exported: six digits
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 4; j++)
                    a.m[i][j] = round(a.m[i][j] * 1e6) / 1e6;
        assert_true(sheet_is_flat(&a));
        assert_true(sheet_thicken(&a, unit, 0.004));
        struct affine inverse;
        assert_true(affine_inverse(&a, &inverse));
        struct vec3 middle = {0.5, 0.5, 0.5};
        struct vec3 moved = vec3_sub(affine_point(&a, middle), affine_point(&before, middle));
        assert_true(vec3_length(moved) < 1e-5);
        for (int i = 0; i < 8; i++) { // no corner moves further than the sheet is thick
            struct vec3 p = box_corner(unit, i);
            struct vec3 way = vec3_sub(affine_point(&a, p), affine_point(&before, p));
            assert_true(vec3_length(way) < 0.0041);
        }
    }
}

static void lines_and_points_are_nothing(void **state)
{
    (void)state;
    struct affine line = {{{1, 2, 3, 0}, {2, 4, 6, 0}, {-1, -2, -3, 0}}};
    assert_true(sheet_is_flat(&line));
    assert_false(sheet_thicken(&line, unit, 0.004));
    struct affine point = {{{0, 0, 0, 7}, {0, 0, 0, 7}, {0, 0, 0, 7}}};
    assert_true(sheet_is_flat(&point));
    assert_false(sheet_thicken(&point, unit, 0.004));
    struct affine tiny = {{{1e-200, 0, 0, 0}, {0, 1e-200, 0, 0}, {0, 0, 1e-200, 0}}};
    assert_true(sheet_is_flat(&tiny));
    assert_false(sheet_thicken(&tiny, unit, 0.004));
}

static void steep_but_thick_shears_stay(void **state)
{
    (void)state;
    struct affine shear = {{{1, 2e5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, before = shear;
    assert_true(sheet_is_flat(&shear));
    assert_true(sheet_thicken(&shear, (struct box){{0, 0, 0}, {1e6, 1e6, 1e6}}, 0.004));
    assert_memory_equal(&shear, &before, sizeof before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scaling_is_not_flat),
        cmocka_unit_test(sheets_get_the_thickness_around_their_middle),
        cmocka_unit_test(lines_and_points_are_nothing),
        cmocka_unit_test(steep_but_thick_shears_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
