// test_choose.c - which device draws, on whatever machine this is.
#include "render/choose.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static void names_are_known(void **state)
{
    (void)state;
    static const char *const wrong[] = {"", "g", "GL", "gpu", "cpu "};
    struct error err;
    enum device_wish wish;
    assert_true(device_wish_parse(&wish, "gl", &err) && wish == DEVICE_GL);
    assert_true(device_wish_parse(&wish, "cpu", &err) && wish == DEVICE_CPU);
    assert_true(device_wish_parse(&wish, "auto", &err) && wish == DEVICE_AUTO);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(device_wish_parse(&wish, wrong[i], &err));
        assert_non_null(strstr(err.text, "expected auto, cpu or gl"));
    }
}

static void the_processor_is_always_there(void **state)
{
    (void)state;
    struct error why;
    struct device *d = device_choose(DEVICE_CPU, NULL, &why);
    assert_non_null(d);
    assert_string_equal(why.text, "cpu");
    device_delete(d);
    d = device_choose(DEVICE_AUTO, NULL, &why);
    assert_non_null(d);
    bool gl = strncmp(why.text, "gl, ", 4) == 0;
    assert_true(gl || strncmp(why.text, "cpu; not gl: ", 13) == 0);
    assert_int_equal(gl, d->description[0] != 0);
    device_delete(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_known),
        cmocka_unit_test(the_processor_is_always_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
