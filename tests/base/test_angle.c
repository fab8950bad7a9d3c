// test_angle.c - sines and cosines of degrees.
#include "base/angle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void angles_are_exact(void **state)
{
    (void)state;
    for (int turn = -720; turn <= 720; turn += 360) {
        assert_true(sin_degrees(turn) == 0 && cos_degrees(turn) == 1);
        assert_true(sin_degrees(turn + 30) == 0.5 && cos_degrees(turn + 60) == 0.5);
        assert_true(sin_degrees(turn + 45) == M_SQRT1_2 && cos_degrees(turn + 45) == M_SQRT1_2);
        assert_true(sin_degrees(turn + 90) == 1 && cos_degrees(turn + 90) == 0);
        assert_true(sin_degrees(turn + 150) == 0.5 && cos_degrees(turn + 150) == -sqrt(0.75));
        assert_true(sin_degrees(turn + 180) == 0 && cos_degrees(turn + 180) == -1);
        assert_true(sin_degrees(turn + 210) == -0.5 && cos_degrees(turn + 240) == -0.5);
        assert_true(sin_degrees(turn + 270) == -1 && cos_degrees(turn + 270) == 0);
        assert_true(sin_degrees(turn + 330) == -0.5 && cos_degrees(turn + 300) == 0.5);
    }
    for (double x = -400; x < 800; x += 7.3) {
        assert_true(fabs(sin_degrees(x) - sin(x * M_PI / 180)) <= 3e-15);
        assert_true(fabs(cos_degrees(x) - cos(x * M_PI / 180)) <= 3e-15);
    }
    assert_true(isnan(sin_degrees(INFINITY)) && isnan(cos_degrees(NAN)));
    assert_true(sin_degrees(-1e-20) <= 0 && cos_degrees(-1e-20) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(angles_are_exact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
