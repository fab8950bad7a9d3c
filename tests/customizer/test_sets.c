// test_sets.c - files of parameter sets: what is kept, what is refused.
#include "customizer/sets.h"

#include "base/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
// after those
#include <cmocka.h>

static char folder[] = "/tmp/hcsg-sets-XXXXXX", path[64];

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return 1;
    snprintf(path, sizeof path, "%s/x.json", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder); // nothing else is left
}

static struct parameters read_text(const char *text)
{
    struct parameters p;
    parameters_read(&p, text, strlen(text));
    return p;
}

static void put_file(const char *text)
{
    struct error err;
    assert_true(file_write(path, text, strlen(text), &err));
}

static void expect_file(const char *expected)
{
    struct error err;
    char *text;
    size_t size;
    assert_true(file_read(path, 1 << 20, &text, &size, &err));
    assert_string_equal(text, expected);
    free(text);
}

static void the_first_set_makes_the_file(void **state)
{
    struct parameters p = read_text("a = 1; s = \"x\\ty\"; b = true; v = [1, 2];");
    struct error err;
    (void)state;
    unlink(path);
    p.items[0].value.numbers[0] = 0.1;
    assert_true(parameter_set_save(path, "one \"set\"", &p, &err));
    expect_file("{\n"
                "    \"parameterSets\": {\n"
                "        \"one \\\"set\\\"\": {\n"
                "            \"a\": \"0.1\",\n"
                "            \"s\": \"x\\ty\",\n"
                "            \"b\": \"true\",\n"
                "            \"v\": \"[1, 2]\"\n"
                "        }\n"
                "    },\n"
                "    \"fileFormatVersion\": \"1\"\n"
                "}\n");
    parameters_free(&p);
}

static const char theirs[] = "{\n"
                             "    \"more\": [1, {\n"
                             "            \"x\": null\n"
                             "        }],\n"
                             "    \"parameterSets\": {\n"
                             "        \"first\": {\n"
                             "            \"z\": \"1\",\n"
                             "            \"b\": \"2\",\n"
                             "            \"gone\": \"3\",\n"
                             "            \"a\": 4\n"
                             "        },\n"
                             "        \"second\": {\n"
                             "            \"a\": \"5\"\n"
                             "        }\n"
                             "    },\n"
                             "    \"fileFormatVersion\": \"1\"\n"
                             "}\n";

static void all_else_in_the_file_stays(void **state)
{
    struct parameters p = read_text("a = 7; b = 8; c = 9;");
    struct error err;
    (void)state;
    put_file(theirs);
    assert_true(parameter_set_save(path, "first", &p, &err));
    assert_true(parameter_set_delete(path, "second", &err));
    assert_true(parameter_set_save(path, "third", &p, &err));
    expect_file("{\n"
                "    \"more\": [1, {\n"
                "            \"x\": null\n"
                "        }],\n"
                "    \"parameterSets\": {\n"
                "        \"first\": {\n"
                "            \"z\": \"1\",\n"
                "            \"b\": \"8\",\n"
                "            \"gone\": \"3\",\n"
                "            \"a\": \"7\",\n"
                "            \"c\": \"9\"\n"
                "        },\n"
                "        \"third\": {\n"
                "            \"a\": \"7\",\n"
                "            \"b\": \"8\",\n"
                "            \"c\": \"9\"\n"
                "        }\n"
                "    },\n"
                "    \"fileFormatVersion\": \"1\"\n"
                "}\n");
    parameters_free(&p);
}

static void a_file_of_ours_comes_out_the_same(void **state)
{
    struct parameters none = {0};
    struct error err;
    (void)state;
    put_file(theirs);
    assert_true(parameter_set_save(path, "second", &none, &err));
    expect_file(theirs);
}

static void sets_are_named_and_applied(void **state)
{
    struct parameters p = read_text("a = 1; b = 1; c = 1; z = \"x\";");
    struct parameter_sets sets;
    struct error err;
    (void)state;
    put_file(theirs);
    assert_true(parameter_sets_read(&sets, path, &err));
    assert_int_equal(sets.count, 2);
    assert_string_equal(sets.names[0], "first");
    assert_string_equal(sets.names[1], "second");
    assert_false(parameter_sets_has(&sets, "third"));
    p.items[2].value.numbers[0] = 5;
    assert_false(parameter_sets_apply(&sets, "third", &p));
    assert_true(p.items[2].value.numbers[0] == 5);
    assert_true(parameter_sets_apply(&sets, "first", &p));
    assert_true(p.items[0].value.numbers[0] == 4);
    assert_true(p.items[1].value.numbers[0] == 2);
    assert_true(p.items[2].value.numbers[0] == 1); // back to the source
    assert_string_equal(p.items[3].value.text, "1");
    parameter_sets_missing(&sets, "x.json", "third", &err);
    assert_string_equal(err.text, "x.json: no parameter set 'third'; there are: first, second");
    parameter_sets_free(&sets);
    parameter_sets_free(&sets);
    parameters_free(&p);
}

static void broken_files_are_refused_and_left_alone(void **state)
{
    static const char *const texts[] = {
        "",
        "[]",
        "3",
        "{",
        "{\"parameterSets\": 3}",
        "{\"parameterSets\": {\"a\": }}",
        "{\"parameterSets\": {}} {}",
    };
    struct parameters p = read_text("a = 1;");
    (void)state;
    for (size_t i = 0; i < array_count(texts); i++) {
        struct parameter_sets sets = {0};
        struct error err;
        char expected[100];
        snprintf(expected, sizeof expected, "%s: is no JSON file of parameter sets", path);
        put_file(texts[i]);
        assert_false(parameter_sets_read(&sets, path, &err));
        assert_string_equal(err.text, expected);
        assert_null(sets.file);
        assert_false(parameter_set_save(path, "a", &p, &err));
        assert_string_equal(err.text, expected);
        assert_false(parameter_set_delete(path, "a", &err));
        expect_file(texts[i]);
    }
    parameters_free(&p);
}

static void a_set_that_is_not_there_is_not_deleted(void **state)
{
    struct error err;
    (void)state;
    put_file(theirs);
    assert_false(parameter_set_delete(path, "x", &err));
    assert_non_null(strstr(err.text, "no parameter set 'x'; there are: first, second"));
    expect_file(theirs);
    unlink(path);
    assert_false(parameter_set_delete(path, "x", &err));
    assert_int_equal(access(path, F_OK), -1);
}

static void values_that_are_no_values_are_passed_over(void **state)
{
    struct parameters p = read_text("a = 1; b = 2; s = \"x\";");
    struct parameter_sets sets;
    struct error err;
    (void)state;
    put_file("{\"parameterSets\": {\"a\": {\"a\": {\"b\": \"7\"}, \"b\": null, \"s\": [1]},"
             " \"b\": 3, \"b\": \"x\", \"\": {}}}");
    assert_true(parameter_sets_read(&sets, path, &err));
    for (uint32_t i = 0; i < sets.count; i++) {
        assert_true(parameter_sets_apply(&sets, sets.names[i], &p));
        for (uint32_t n = 0; n < p.count; n++)
            assert_false(parameter_is_changed(&p.items[n]));
    }
    parameter_sets_free(&sets);
    assert_true(parameter_set_save(path, "b", &p, &err));
    parameters_free(&p);
}

static void the_file_lies_beside_the_design(void **state)
{
    static const char *const rows[][2] = {
        {"a.scad", "a.json"}, {"/b.c/d", "/b.c/d.json"}, {"../x.y.scad", "../x.y.json"}};
    (void)state;
    for (size_t i = 0; i < array_count(rows); i++) {
        char *made = parameter_sets_path(rows[i][0]);
        assert_string_equal(made, rows[i][1]);
        free(made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_set_makes_the_file),
        cmocka_unit_test(all_else_in_the_file_stays),
        cmocka_unit_test(a_file_of_ours_comes_out_the_same),
        cmocka_unit_test(sets_are_named_and_applied),
        cmocka_unit_test(broken_files_are_refused_and_left_alone),
        cmocka_unit_test(a_set_that_is_not_there_is_not_deleted),
        cmocka_unit_test(values_that_are_no_values_are_passed_over),
        cmocka_unit_test(the_file_lies_beside_the_design),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
