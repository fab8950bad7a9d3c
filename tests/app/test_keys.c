// test_keys.c - the table of keys.
#include "app/keys.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
// cmocka.h wants the four above first
#include <cmocka.h>
#include <string.h>

static void names_are_found(void **state)
{
    (void)state;
    assert_int_equal(keys_find("v"), ACTION_VIEW_ALL);
    assert_int_equal(keys_find("Ctrl+Shift+V"), ACTION_VIEW_ALL);
    assert_int_equal(keys_find("Ctrl+4"), ACTION_TOP);
    assert_int_equal(keys_find("0"), ACTION_DIAGONAL);
    assert_int_equal(keys_find("?"), ACTION_HELP);
    assert_int_equal(keys_find(""), ACTION_NONE);
    assert_int_equal(keys_find("Ctrl+"), ACTION_NONE);
    assert_int_equal(keys_find("wheel"), ACTION_NONE);
}

// Else the sheet promises what input does not do.
static void no_key_stands_twice(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < key_row_count; i++) {
        char keys[200];
        if (key_rows[i].action == ACTION_NONE)
            continue;
        strcpy(keys, key_rows[i].keys);
        for (char *key = keys, *next; key; key = next) {
            next = strstr(key, ", ");
            if (next) {
                *next = 0;
                next += 2;
            }
            assert_int_equal(keys_find(key), key_rows[i].action);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_found),
        cmocka_unit_test(no_key_stands_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
