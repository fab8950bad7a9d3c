// test_pace.c - how coarse a picture has to be.
#include "app/pace.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static const double most = 0.033;

// Frames of a machine that needs `fixed` + `each` * pixels seconds, as the viewer asks for them.
static int settle(double fixed, double each)
{
    struct pace p = {0};
    int divisor = 1;
    for (int i = 0; i < 20; i++) {
        double pixels = 1e6 / (divisor * divisor);
        pace_add(&p, pixels, fixed + each * pixels);
        divisor = pace_divisor(&p, 1000, 1000, most);
    }
    return divisor;
}

static void the_first_frame_is_fine(void **state)
{
    (void)state;
    assert_int_equal(pace_divisor(&(struct pace){0}, 4000, 3000, most), 1);
}

static void fast_frames_stay_fine(void **state)
{
    (void)state;
    assert_int_equal(settle(0.001, 10e-9), 1);
    assert_int_equal(settle(0.02, 12e-9), 1);
}

static void slow_frames_become_coarse(void **state)
{
    (void)state;
    assert_int_equal(settle(0, 100e-9), 2);
    assert_int_equal(settle(0.005, 200e-9), 3);
    assert_int_equal(settle(0, 1), PACE_DIVISOR_MOST);
}

static void what_does_not_help_is_not_done(void **state)
{
    (void)state;
    assert_int_equal(settle(0.1, 20e-9), 1);
    assert_in_range(settle(0.1, 200e-9), 2, 3);
}

static void a_change_is_followed(void **state)
{
    (void)state;
    struct pace p = {0};
    for (int i = 0; i < 10; i++)
        pace_add(&p, 1e6, 0.3);
    assert_in_range(pace_divisor(&p, 1000, 1000, most), 4, 4);
    for (int i = 0; i < 10; i++)
        pace_add(&p, 1e6, 0.01);
    assert_int_equal(pace_divisor(&p, 1000, 1000, most), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_frame_is_fine),
        cmocka_unit_test(fast_frames_stay_fine),
        cmocka_unit_test(slow_frames_become_coarse),
        cmocka_unit_test(what_does_not_help_is_not_done),
        cmocka_unit_test(a_change_is_followed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
