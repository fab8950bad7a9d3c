// test_number.c - as few digits as read back.
#include "base/number.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void expect(double number, int least, int most, const char *wanted)
{
    char text[NUMBER_TEXT];
    int length = number_shortest(text, number, least, most);
    assert_string_equal(text, wanted);
    assert_int_equal(text[length], 0);
}

static void digits_are_as_few_as_read_back(void **state)
{
    (void)state;
    expect(0.1, 6, 17, "0.1");
    expect(1234567, 6, 17, "1234567");
    expect(0.1 + 0.2, 6, 17, "0.30000000000000004");
    expect(0.1 + 0.2, 6, 6, "0.3");
    expect(-5e-324, 6, 17, "-4.94066e-324");
    expect(-1.7976931348623157e308, 6, 17, "-1.7976931348623157e+308");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(digits_are_as_few_as_read_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
