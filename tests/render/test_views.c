// test_views.c - named views, sheets of several, and pictures compared.
#include "render/compare.h"
#include "render/views.h"
#include "unit.h"

static void names_are_rotations(void **state)
{
    (void)state;
    struct view_list list;
    struct error err;
    assert_true(views_parse(&list, "top,left,iso", &err));
    assert_int_equal(list.count, 3);
    assert_string_equal(list.items[1].name, "left");
    assert_true(list.items[1].rotation.x == 90 && list.items[1].rotation.z == 270);
    // all axes are as long
    struct camera c = CAMERA_DEFAULTS;
    c.orthographic = true;
    c.rotation = list.items[2].rotation;
    struct rays r = camera_rays(&c, 10, 10, BOX_EMPTY);
    assert_float_equal(fabs(r.forward.x), fabs(r.forward.y), 1e-12);
    assert_float_equal(fabs(r.forward.x), fabs(r.forward.z), 1e-12);
    assert_true(r.forward.z < 0 && r.forward.y > 0);
}

static void wrong_names_are_told(void **state)
{
    (void)state;
    static const char many[] = "top,top,top,top,top,top,top,top,"
                               "top,top,top,top,top,top,top,top,top";
    static const char *const wrong[] = {"", "top,", ",top", "up", "top, left", "Top", many};
    for (size_t i = 0; i < array_count(wrong); i++) {
        struct view_list list = {0};
        struct error err = {0};
        assert_false(views_parse(&list, wrong[i], &err));
        assert_int_equal(strncmp(err.text, "--views: expected ", 18), 0);
        assert_int_equal(list.count, 0);
    }
}

static void sheets_waste_little(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        uint32_t count;
        struct sheet_layout layout;
    } expected[] = {
        {512, 512, 1, {1, 1, 512, 512}}, {512, 512, 2, {2, 1, 256, 512}},
        {512, 512, 3, {2, 2, 256, 256}}, {512, 512, 4, {2, 2, 256, 256}},
        {512, 512, 7, {3, 3, 170, 170}}, {800, 200, 4, {4, 1, 200, 200}},
        {200, 800, 4, {1, 4, 200, 200}}, {900, 600, 6, {3, 2, 300, 300}},
        {1, 1, 2, {0, 0, 0, 0}},
    };
    for (size_t i = 0; i < array_count(expected); i++) {
        struct sheet_layout l =
            sheet_layout(expected[i].width, expected[i].height, expected[i].count);
        if (memcmp(&l, &expected[i].layout, sizeof l) != 0)
            fail_msg("case %zu: %d x %d of %d x %d", i, l.columns, l.rows, l.width, l.height);
    }
}

static void differences_are_counted(void **state)
{
    (void)state;
    static const uint8_t a[24] = {1, 2, 3, 255, 9, 9, 9, 0,   10, 20, 30, 255,
                                  0, 0, 0, 255, 5, 5, 5, 255, 7,  7,  7,  255};
    static const uint8_t b[24] = {1, 2, 3, 255, 0, 0, 0, 0,   10, 23, 30, 255,
                                  0, 0, 9, 255, 5, 5, 5, 246, 7,  7,  7,  255};
    struct comparison c = pictures_compare(a, b, 3, 2, 0);
    assert_int_equal(c.differing, 3);
    assert_int_equal(c.largest, 9);
    assert_int_equal(c.x, 0);
    assert_int_equal(c.y, 1);
    assert_int_equal(pictures_compare(a, b, 3, 2, 3).differing, 2);
    assert_int_equal(pictures_compare(a, b, 3, 2, 9).differing, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_rotations),
        cmocka_unit_test(wrong_names_are_told),
        cmocka_unit_test(sheets_waste_little),
        cmocka_unit_test(differences_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
