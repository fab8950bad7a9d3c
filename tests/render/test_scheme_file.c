// test_scheme_file.c - colour schemes in OpenSCAD's JSON files.
#include "render/scheme_choose.h"
#include "render/scheme_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static char path[] = "/tmp/hcsg-scheme-XXXXXX";

static const char tomorrow[] = "{\n"
                               "    \"name\" : \"Tomorrow\",\n"
                               "    \"index\" : 1800,\n"
                               "    \"show-in-gui\" : true,\n"
                               "    \"colors\" : {\n"
                               "        \"background\" :         \"#f8f8f8\",\n"
                               "        \"axes-color\" :         \"#181818\",\n"
                               "        \"opencsg-face-front\" : \"#4271ae\",\n"
                               "        \"opencsg-face-back\" :  \"#f5871f\",\n"
                               "        \"cgal-face-front\" :    \"#3E999F\",\n"
                               "        \"cgal-face-back\" :     \"#eab700\",\n"
                               "        \"cgal-face-2d\" :       \"#718c00\",\n"
                               "        \"cgal-edge-front\" :    \"#4d4d4c\",\n"
                               "        \"cgal-edge-back\" :     \"#4d4d4c\",\n"
                               "        \"cgal-edge-2d\" :       \"#c82829\",\n"
                               "        \"crosshair\" :          \"#8959a8\"\n"
                               "    }\n"
                               "}\n";

static bool read_bytes(const void *bytes, size_t size, struct scheme *out, struct error *err)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    assert_int_equal(fclose(f), 0);
    return scheme_read(out, path, err);
}

// The scheme above with a piece replaced.
static bool read_changed(const char *piece, const char *by, struct scheme *out, struct error *err)
{
    char text[4096];
    const char *at = strstr(tomorrow, piece);
    assert_non_null(at);
    int n = snprintf(text, sizeof text, "%.*s%s%s", (int)(at - tomorrow), tomorrow, by,
                     at + strlen(piece));
    return read_bytes(text, (size_t)n, out, err);
}

static void expect_error(bool ok, const struct error *err, const char *says)
{
    assert_false(ok);
    if (strncmp(err->text, path, strlen(path)) != 0 || !strstr(err->text, says) ||
        strchr(err->text, '\n'))
        fail_msg("'%s' is not one line with the file and '%s'", err->text, says);
}

static void file_is_the_same_as_the_built_in_one(void **state)
{
    (void)state;
    struct error err = {0};
    struct scheme s;
    const struct scheme *built_in = scheme_find("Tomorrow", &err);
    if (!read_bytes(tomorrow, strlen(tomorrow), &s, &err))
        fail_msg("%s", err.text);
    assert_string_equal(s.name, path);
    size_t first = offsetof(struct scheme, background);
    assert_memory_equal((char *)&s + first, (const char *)built_in + first,
                        offsetof(struct scheme, edge_flat) + sizeof s.edge_flat - first);
}

static void gradient_is_optional(void **state)
{
    (void)state;
    struct error err = {0};
    struct scheme s;
    assert_true(
        read_changed("\"crosshair\"", "\"background-stop\": \"#010203\", \"crosshair\"", &s, &err));
    assert_memory_equal(&s.background, "\xf8\xf8\xf8", 3);
    assert_memory_equal(&s.background_bottom, "\x01\x02\x03", 3);
    expect_error(read_changed("\"crosshair\"", "\"background-stop\": 7, \"crosshair\"", &s, &err),
                 &err, "'background-stop' is not a colour");
}

static void faults_are_named(void **state)
{
    (void)state;
    struct error err = {0};
    struct scheme s;
    expect_error(read_changed("cgal-edge-2d", "cgal-edge-3d", &s, &err), &err,
                 "the colour 'cgal-edge-2d' is missing");
    static const char *const colours[] = {"#4271a",  "#4271aef", "4271aee", "#4271ag",
                                          "#+271ae", "",         "red",     "#\\u0000ffffff"};
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        expect_error(read_changed("#4271ae", colours[i], &s, &err), &err,
                     "'opencsg-face-front' is not a colour");
    expect_error(read_changed("\"#4271ae\"", "[]", &s, &err), &err, "is not a colour");
    expect_error(read_changed("\"colors\"", "\"colours\"", &s, &err), &err, "not a colour scheme");
    expect_error(read_changed("1800,", "1800", &s, &err), &err, ":4:5: not JSON");
}

static void hostile_files_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct scheme s;
    for (size_t n = 0; n < strlen(tomorrow) - 2; n++)
        expect_error(read_bytes(tomorrow, n, &s, &err), &err, "not JSON");
    static const char *const texts[] = {"null", "[]", "\"colors\"", "{}", "{\"colors\": null}",
                                        "1e999"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        expect_error(read_bytes(texts[i], strlen(texts[i]), &s, &err), &err, "not a colour scheme");
    char deep[100000];
    memset(deep, '[', sizeof deep);
    expect_error(read_bytes(deep, sizeof deep, &s, &err), &err, "not JSON");
    memset(deep, 0, sizeof deep);
    expect_error(read_bytes(deep, sizeof deep, &s, &err), &err, "not JSON");
    static char large[(1 << 20) + 1];
    memset(large, ' ', sizeof large);
    expect_error(read_bytes(large, sizeof large, &s, &err), &err, "");
    assert_false(scheme_read(&s, "/tmp", &err));
}

static void paths_are_told_from_names(void **state)
{
    (void)state;
    struct error err = {0};
    struct scheme own;
    assert_true(read_bytes(tomorrow, strlen(tomorrow), &own, &err));
    own = (struct scheme){0};
    assert_ptr_equal(scheme_choose(path, &own, &err), &own);
    assert_memory_equal(&own.front, "\x42\x71\xae", 3);
    assert_string_equal(scheme_choose("Sunset", &own, &err)->name, "Sunset");
    assert_null(scheme_choose("sunset", &own, &err));
    assert_non_null(strstr(err.text, "there are: Cornfield"));
    assert_null(scheme_choose("missing.json", &own, &err));
    assert_non_null(strstr(err.text, "missing.json: No such file"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(file_is_the_same_as_the_built_in_one),
        cmocka_unit_test(gradient_is_optional),
        cmocka_unit_test(faults_are_named),
        cmocka_unit_test(hostile_files_are_refused),
        cmocka_unit_test(paths_are_told_from_names),
    };
    int file = mkstemp(path);
    if (file < 0)
        return 77;
    close(file);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
