// test_report.c - what the user is told about a load.
#include "app/report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
// cmocka.h wants the four above first
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

static struct scad_result said(const char *log)
{
    static char *files[] = {"/nowhere/part.scad"};
    return (struct scad_result){.log = (char *)(uintptr_t)log, .files = files, .file_count = 1};
}

static void is_line(const struct report *r, uint32_t i, enum report_kind kind, const char *text,
                    const char *place)
{
    assert_true(i < r->count);
    assert_int_equal(r->lines[i].kind, kind);
    assert_string_equal(r->lines[i].text, text);
    assert_int_equal(r->lines[i].place_length, strlen(place));
    assert_memory_equal(r->lines[i].text, place, strlen(place));
}

static void lines_keep_their_order_kind_and_place(void **state)
{
    (void)state;
    struct scad_result result =
        said("ECHO: \"in file part.scad, line 9\"\n"
             "WARNING: Ignoring unknown variable 'x' in file part.scad, line 3\n"
             "Compiling design...\n"
             "DEPRECATED: old\n"
             "ERROR: Assertion 'false' failed in file part.scad, line 4\n"
             "TRACE: called by 'f' in file part.scad, line 12\n");
    struct error err;
    error_set(&err, "not told again");
    struct report r = {0};
    report_scad(&r, &result, &err);
    assert_int_equal(r.count, 5);
    is_line(&r, 0, REPORT_ECHO, "\"in file part.scad, line 9\"", "");
    is_line(&r, 1, REPORT_WARNING, "/nowhere/part.scad:3: Ignoring unknown variable 'x'",
            "/nowhere/part.scad:3");
    is_line(&r, 2, REPORT_WARNING, "old", "");
    is_line(&r, 3, REPORT_ERROR, "/nowhere/part.scad:4: Assertion 'false' failed",
            "/nowhere/part.scad:4");
    is_line(&r, 4, REPORT_TRACE, "/nowhere/part.scad:12: called by 'f'", "/nowhere/part.scad:12");
    assert_ptr_equal(report_first(&r, REPORT_ERROR), &r.lines[3]);
    struct report copy = report_copy(&r);
    report_free(&r);
    is_line(&copy, 2, REPORT_WARNING, "old", "");
    report_free(&copy);
    report_free(&copy);
}

static void a_failure_without_an_error_is_told(void **state)
{
    (void)state;
    struct scad_result result = said("ECHO: 1\n");
    struct error err;
    error_set(&err, "openscad was ended");
    struct report r = {0};
    report_scad(&r, &result, &err);
    is_line(&r, 1, REPORT_ERROR, "openscad was ended", "");
    report_free(&r);
}

static void messages_have_their_place(void **state)
{
    (void)state;
    struct messages m = {0};
    messages_add(&m, MESSAGE_ERROR, (struct place){"a: b.csg", 3, 7}, "odd: %d", 5);
    messages_add(&m, MESSAGE_WARNING, (struct place){"a.csg", 0, 0}, "missing");
    struct report r = {0};
    report_messages(&r, &m);
    is_line(&r, 0, REPORT_ERROR, "a: b.csg:3:7: odd: 5", "a: b.csg:3:7");
    is_line(&r, 1, REPORT_WARNING, "a.csg: missing", "");
    report_free(&r);
    messages_free(&m);
}

static void endless_echoes_hide_no_error(void **state)
{
    (void)state;
    enum { ECHOES = 3000 };
    char *log = malloc(ECHOES * 16 + 100), *end = log;
    for (int i = 0; i < ECHOES; i++)
        end += sprintf(end, "ECHO: %d\n", i);
    strcpy(end, "ERROR: at the end\n");
    struct scad_result result = said(log);
    struct report r = {0};
    report_scad(&r, &result, NULL);
    assert_int_equal(r.kinds[REPORT_ECHO], ECHOES);
    assert_int_equal(r.count, REPORT_KEPT + 1);
    assert_string_equal(report_first(&r, REPORT_ERROR)->text, "at the end");
    report_free(&r);
    free(log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_keep_their_order_kind_and_place),
        cmocka_unit_test(a_failure_without_an_error_is_told),
        cmocka_unit_test(messages_have_their_place),
        cmocka_unit_test(endless_echoes_hide_no_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
