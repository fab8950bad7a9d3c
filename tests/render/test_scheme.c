// test_scheme.c - the table of colour schemes.
#include "render/scheme.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static void default_is_cornfield(void **state)
{
    (void)state;
    uint32_t count;
    const struct scheme *s = scheme_list(&count);
    assert_int_equal(count, 14);
    assert_string_equal(s->name, "Cornfield");
    assert_memory_equal(&s->background, "\xff\xff\xe5", 3);
    assert_memory_equal(&s->front, "\xf9\xd7\x2c", 3);
    assert_memory_equal(&s->back, "\x9d\xcb\x51", 3);
    assert_memory_equal(&s->crosshair, "\x80\x00\x00", 3);
}

static void finds_by_exact_name(void **state)
{
    (void)state;
    struct error err = {0};
    const struct scheme *s = scheme_find("Tomorrow Night", &err);
    assert_non_null(s);
    assert_memory_equal(&s->mesh_back, "\xf0\xc6\x74", 3);
    assert_memory_equal(&s->edge_flat, "\xcc\x66\x66", 3);
    s = scheme_find("ClearSky", &err);
    assert_memory_equal(&s->background, "\x87\xce\xeb", 3);
    assert_memory_equal(&s->background_bottom, "\xc9\xe9\xf6", 3);
}

static void unknown_name_lists_all(void **state)
{
    (void)state;
    uint32_t count;
    const struct scheme *s = scheme_list(&count);
    struct error err = {0};
    assert_null(scheme_find("cornfield", &err));
    for (uint32_t i = 0; i < count; i++)
        assert_non_null(strstr(err.text, s[i].name));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(default_is_cornfield),
        cmocka_unit_test(finds_by_exact_name),
        cmocka_unit_test(unknown_name_lists_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
