// test_settings.c - what is remembered from window to window.
#include "app/settings.h"
#include "base/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
// cmocka.h wants the four above first
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/hcsg-settings-XXXXXX";

static void in_the_file(const char *text)
{
    assert_true(file_write("hcsg/view.json", text, strlen(text), NULL));
}

static void written_settings_come_back(void **state)
{
    (void)state;
    struct settings s, back;
    struct error err;
    assert_true(settings_read(&s, &err)); // no file
    assert_true(settings_equal(&s, &SETTINGS_DEFAULTS));
    s = (struct settings){.width = 640,
                          .height = 480,
                          .orthographic = true,
                          .scheme = "Daylight \"Gem\"",
                          .view = {.axes = true, .edges = true}};
    assert_false(settings_equal(&s, &SETTINGS_DEFAULTS));
    assert_true(settings_write(&s, &err));
    assert_true(settings_read(&back, &err));
    assert_true(settings_equal(&s, &back));
    assert_false(back.status);
}

static void what_is_wrong_has_its_default(void **state)
{
    (void)state;
    struct settings s;
    struct error err;
    in_the_file(
        "{\"width\": 1e300, \"height\": \"5\", \"axes\": 1, \"edges\": true, \"scheme\": null}");
    assert_true(settings_read(&s, &err));
    assert_true(s.view.edges && !s.view.axes && s.width == 1024 && s.height == 768);
    assert_string_equal(s.scheme, "Cornfield");
    static const char *const broken[] = {"", "[]", "{\"edges\": true", "nonsense"};
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        in_the_file(broken[i]);
        assert_false(settings_read(&s, &err));
        assert_true(settings_equal(&s, &SETTINGS_DEFAULTS));
        assert_non_null(strstr(err.text, "hcsg/view.json: "));
    }
}

static void what_others_wrote_stays(void **state)
{
    (void)state;
    struct settings s = SETTINGS_DEFAULTS;
    struct error err;
    char *text;
    size_t size;
    in_the_file("{\"later\": [1, 2], \"axes\": false}");
    s.view.axes = true;
    assert_true(settings_write(&s, &err));
    assert_true(file_read("hcsg/view.json", 10000, &text, &size, &err));
    assert_non_null(strstr(text, "\"later\":"));
    free(text);
    assert_true(settings_read(&s, &err));
    assert_true(s.view.axes);
}

static int enter(void **state)
{
    (void)state;
    return !mkdtemp(folder) || chdir(folder) != 0 || setenv("XDG_CONFIG_HOME", folder, 1) != 0;
}

static int leave(void **state)
{
    (void)state;
    unlink("hcsg/view.json");
    rmdir("hcsg");
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(written_settings_come_back),
        cmocka_unit_test(what_is_wrong_has_its_default),
        cmocka_unit_test(what_others_wrote_stays),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
