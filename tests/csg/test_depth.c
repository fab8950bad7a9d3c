// test_depth.c - files nested a million deep, and small files that ask for much time or memory.
#include "csg/csg.h"

#include <stdlib.h>
#include <string.h>
// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>
// clang-format on

enum { DEEP = 1000000 };

// head, `count` times each, middle, `count` times each2, tail; two zero bytes behind.
static char *repeated(const char *head, const char *each, const char *middle, const char *each2,
                      const char *tail, size_t count, size_t *size)
{
    size_t a = strlen(each), b = strlen(each2), used = 0;
    char *text = mem_zalloc(strlen(head) + strlen(middle) + strlen(tail) + (a + b) * count + 2);

    used = strlen(strcpy(text, head));
    for (size_t i = 0; i < count; i++, used += a)
        memcpy(text + used, each, a);
    used += strlen(strcpy(text + used, middle));
    for (size_t i = 0; i < count; i++, used += b)
        memcpy(text + used, each2, b);
    *size = used + strlen(strcpy(text + used, tail));
    return text;
}

static void deep_trees_parse_and_print(void **state)
{
    static const struct {
        const char *head, *each, *middle, *each2, *tail;
    } cases[] = {
        {"", "group() {", "cube();", "}", ""},
        {"", "group() ", "cube();", "", ""},
        {"", "a(x = 1) { b(); ", "cube();", "}", ""},
        {"a(", "[", "true", "]", ");"},
        {"a(x = ", "[0, ", "1", "]", ");"},
        {"a(", "-", "1", "", ");"},
        {"a(", "-(", "1", ")", ");"},
        {"", "{", "cube();", "}", ""},
    };

    (void)state;
    for (size_t i = 0; i < array_count(cases); i++) {
        struct messages messages = {0};
        struct csg_tree tree;
        size_t size;
        char *text = repeated(cases[i].head, cases[i].each, cases[i].middle, cases[i].each2,
                              cases[i].tail, DEEP, &size);
        assert_true(csg_parse(&tree, "deep.csg", text, size, &messages));
        free(text);
        text = csg_print(&tree, &size);
        assert_true(size > 4);
        free(text);
        csg_free(&tree);
        messages_free(&messages);
    }
}

static void hostile_repetition_ends_soon(void **state)
{
    static const struct {
        const char *head, *each, *tail, *message; // message NULL: accepted
    } cases[] = {
        {"", "{", "", "a.csg:1:1000000: this '{' is never closed: '}' is missing"},
        {"", "a() ", "", "a.csg:1:4000000: expected ';' or '{' before the end of the file"},
        {"", "}", "", "a.csg:1:1: this '}' closes nothing"},
        {"", "\"", "", "a.csg:1:1: unexpected \"\""},
        {"a(x=\"", "\" ", "", "a.csg:1:8: expected ')' before \" \""},
        {"", "\\\"\n", "", "a.csg:1:1: unexpected character '\\'"},
        {"", "/* ", "", "a.csg:1:1: this comment is never closed: '*/' is missing"},
        {"", ";", "", NULL},
        {"", "%", "a();", NULL},
        {"a(", "7", ");", NULL},
        {"a([", "1,", "]);", NULL},
        {"a([", "1,", "x", "a.csg:1:2000004: 'x' is no value"},
        {"a(", "x = 1,", ");", NULL},
        {"", "x", "();", NULL},
        {"", "\n", "", NULL},
        {"a(", "[1,", "", "a.csg:1:3000003: expected a value or ']' before the end of the file"},
    };

    (void)state;
    for (size_t i = 0; i < array_count(cases); i++) {
        struct messages messages = {0};
        struct csg_tree tree;
        size_t size;
        char *text = repeated(cases[i].head, cases[i].each, "", "", cases[i].tail, DEEP, &size);
        bool ok = csg_parse(&tree, "a.csg", text, size, &messages);
        if (cases[i].message) {
            assert_false(ok);
            char first[200];
            snprintf(first, sizeof first, "%.*s", (int)strlen(cases[i].message),
                     messages.items[0].text);
            assert_string_equal(first, cases[i].message);
            assert_null(tree.file);
        }
        assert_true(messages.errors <= 21);
        csg_free(&tree);
        messages_free(&messages);
        free(text);
    }
}

static void too_deep_is_said(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;
    size_t size;
    char *text = repeated("a(", "[", "", "", "", 9 * DEEP, &size);

    (void)state;
    assert_false(csg_parse(&tree, "a.csg", text, size, &messages));
    assert_int_equal(messages.errors, 1);
    assert_non_null(strstr(messages.items[0].text, "nested too deeply"));
    messages_free(&messages);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(deep_trees_parse_and_print),
        cmocka_unit_test(hostile_repetition_ends_soon),
        cmocka_unit_test(too_deep_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
