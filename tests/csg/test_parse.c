// test_parse.c - what the parser accepts, as printed again, and what it says about the rest.
#include "csg/csg.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>
// clang-format on

static bool parse(struct csg_tree *tree, const char *input, struct messages *messages)
{
    size_t size = strlen(input);
    char *text = mem_zalloc(size + 2);

    memcpy(text, input, size);
    bool ok = csg_parse(tree, "a.csg", text, size, messages);
    assert_memory_equal(text, input, size); // the scanner leaves the text as it was
    free(text);
    return ok;
}

// A text() as OpenSCAD exports it.
#define EXPORTED(text, font)                                                                       \
    "text(text = \"" text "\", size = 10, spacing = 1, font = \"" font "\", direction = \"ltr\", " \
    "language = \"en\", halign = \"left\", valign = \"baseline\");\n"

static void accepted_text_prints(void **state)
{
    static const struct {
        const char *input, *printed;
    } cases[] = {
        {"", "\n"},
        {"\n", "\n"},
        {" \t\r\n// only a comment", "\n"},
        {"cube();", "cube();\n\n"},
        {"\xEF\xBB\xBF"
         "cube(5);\r\nsphere(r=2);\r\n",
         "cube(5);\nsphere(r = 2);\n\n"},
        {"cube\xC2\xA0(5);", "cube(5);\n\n"},
        {"/* a\n * b **/ cube(/**/5 // five\n);", "cube(5);\n\n"},
        {"group() { cube(); }", "group() {\n\tcube();\n}\n\n"},
        {"group() {}", "group();\n\n"},
        {"a() b() c();", "a() {\n\tb() {\n\t\tc();\n\t}\n}\n\n"},
        {";;a() { ; { b(); ; } };", "a() {\n\tb();\n}\n\n"},
        {"{ a(); { b(); } } c();", "a();\nb();\nc();\n\n"},
        {"%\ta();", "%a();\n\n"},
        {"# %\n# a();", "%#a();\n\n"},
        {"*a();!b();", "*a();\n!b();\n\n"},
        {"g() {\n%\ta();\n%#\tb() {\n\t\tc();\n\t}\n}",
         "g() {\n%\ta();\n%#\tb() {\n\t\tc();\n\t}\n}\n\n"},
        {"a() % b();", "a() {\n%\tb();\n}\n\n"},
        {"2cube($fn = 8, 3d = 1);", "2cube($fn = 8, 3d = 1);\n\n"},
        {"$fn = 8; a() { x = [1, 2]; }", "$fn = 8;\na() {\n\tx = [1, 2];\n}\n\n"},
        {"a(2,,$fn=10);", "a(2, $fn = 10);\n\n"},
        {"a([1,2,],);", "a([1, 2]);\n\n"},
        {"a([[1,,2],[3]]);", "a([[1, 2], [3]]);\n\n"},
        {"a([/* empty */]);", "a([]);\n\n"},
        {"a([1.,+.5\n,-1e+2 ,inf,-nan ]);", "a([1, 0.5, -100, inf, -nan]);\n\n"},
        {"a([ [1]\n, [ ] ,[2,3]\t]);", "a([[1], [], [2, 3]]);\n\n"},
        {"a([[1,\n2], [0x1F], [[3]], true]);", "a([[1, 2], [31], [[3]], true]);\n\n"},
        {"a([], [[]], [[], true]);", "a([], [[]], [[], true]);\n\n"},
        {"a([0:2],[0:-1:-5],[1.5 : 2]);", "a([0 : 1 : 2], [0 : -1 : -5], [1.5 : 1 : 2]);\n\n"},
        {"a(-(-4), +5, -5, (7), - 3, [- 1, 2]);", "a(4, 5, -5, 7, -3, [-1, 2]);\n\n"},
        {"a(12, 12., .5, 1e3, 1.5E-3, 0x1F);", "a(12, 12, 0.5, 1000, 0.0015, 31);\n\n"},
        {"a(true, false, undef);", "a(true, false, undef);\n\n"},
        {"a(inf, -inf, nan, -nan, [inf, -inf, nan, -nan, -0], -0);",
         "a(inf, -inf, nan, -nan, [inf, -inf, nan, -nan, -0], -0);\n\n"},
        {"a(1e999, -1e999, 1e-999);", "a(inf, -inf, 0);\n\n"},
        {"a(1000000, 999999, 1e21, 1e-7, 0.0001, 0.00001, 123456789, 0.333333333);",
         "a(1e+06, 999999, 1e+21, 1e-07, 0.0001, 1e-05, 1.23457e+08, 0.333333);\n\n"},
        {"multmatrix([[1000000, 999999, 1e21, 1e-7],[0.0001, 0.00001, 123456789, 0.333333333],"
         "[1234565, 100000.5, -123456.5, 2.5], [-0, inf, -inf, -nan], [-1.5e-5, 1.2e-6, -2e-10, "
         "999999.7]]);",
         "multmatrix([[1e+6, 999999, 1e+21, 1e-7], [0.0001, 0.00001, 1.23457e+8, 0.333333], "
         "[1.23457e+6, 100001, -123457, 2.5], [0, inf, -inf, nan], [-0.000015, 1.2e-6, -2e-10, "
         "1e+6]]);\n\n"},
        {"polygon(points = [[1e6, 0]], paths = undef, convexity = 1234567);",
         "polygon(points = [[1e+6, 0]], paths = undef, convexity = 1234567);\n\n"},
        {"surface(timestamp = 1590623338);", "surface(timestamp = 1590623338);\n\n"},
        {"resize(newsize = [1, 2, 3], auto = [0, 1, 0]);",
         "resize(newsize = [1,2,3], auto = [0,1,0]);\n\n"},
        {"import(file = \"a\\\"b\\\\c\\td\\ne\\r\");",
         "import(file = \"a\\\"b\\\\c\\td\\ne\\r\");\n\n"},
        {"text(text = \"\\x41\\u00e9\\U01F600\\q\\x00\\x80|\");",
         "text(text = \"A\u00e9\U0001F600q x80|\");\n\n"},
        {"text(text = \"a\nb\", size = 1);", "text(text = \"a\nb\", size = 1);\n\n"},
        {"text(\"a\", 5); text(\"b\" , size = 5);", "text(\"a\", 5);\ntext(\"b\", size = 5);\n\n"},
        // OpenSCAD does not escape the strings of text(): the quotes below are part of them
        {"text(text = \"say \"hi\"\", size = 10);", "text(text = \"say \"hi\"\", size = 10);\n\n"},
        {"text(text = \"\"hi\", he said\", size = 10);",
         "text(text = \"\"hi\", he said\", size = 10);\n\n"},
        {"text(text = \"a\", b\", size = 10);", "text(text = \"a\", b\", size = 10);\n\n"},
        {"text(text = \"3\"\", size = 10);", "text(text = \"3\"\", size = 10);\n\n"},
        {"text(text = \"f(\"x\")\", size = 10);", "text(text = \"f(\"x\")\", size = 10);\n\n"},
        {"text(text = \"back\\\", size = 10, font = \"L\");",
         "text(text = \"back\\\", size = 10, font = \"L\");\n\n"},
        {EXPORTED("5\", or 6\"", "L\"M"), EXPORTED("5\", or 6\"", "L\"M") "\n"},
        {EXPORTED("\"", "\""), EXPORTED("\"", "\"") "\n"},
        // nor backslashes: in what is certainly an export they are no escapes
        {EXPORTED("a\\new\\\"b\"\\", "Foo\\-Bar"), EXPORTED("a\\new\\\"b\"\\", "Foo\\-Bar") "\n"},
        {EXPORTED("C:\\x41", ""), EXPORTED("C:\\x41", "") "\n"},
        {"text(text = \"a\\x41\\n\", size = 10, spacing = 1, font = 0);",
         "text(text = \"aA\n\", size = 10, spacing = 1, font = 0);\n\n"},
        {"text(text = \"C:\\\\x\", font = \"a\\-b\");",
         "text(text = \"C:\\x\", font = \"a-b\");\n\n"},
        {"text(size = 10, text = \"\"q\"\") {a();}",
         "text(size = 10, text = \"\"q\"\") {\n\ta();\n}\n\n"},
    };

    (void)state;
    for (size_t i = 0; i < array_count(cases); i++) {
        struct messages messages = {0};
        struct csg_tree tree;
        size_t size;
        bool ok = parse(&tree, cases[i].input, &messages);
        messages_print(&messages, stdout);
        assert_true(ok);
        char *text = csg_print(&tree, &size);
        assert_string_equal(text, cases[i].printed);
        assert_int_equal(size, strlen(text));
        free(text);
        csg_free(&tree);
        messages_free(&messages);
    }
}

#define SOURCE " belongs to OpenSCAD source, not to an exported .csg: open the .scad file itself"
#define VARIABLE                                                                                   \
    " is no value: variables and functions belong to OpenSCAD source, not to an exported .csg: "   \
    "open the .scad file itself"

static void broken_text_is_explained(void **state)
{
    static const struct {
        const char *input;
        const char *messages[4];
    } cases[] = {
        {"cube(5;", {"1:7: expected ')' before ';'"}},
        {"cube(size = [1, 2", {"1:18: expected ',' or ']' before the end of the file"}},
        {"cube([1 2]);", {"1:9: expected ',' or ']' before '2'"}},
        {"cube(size = );", {"1:13: expected a value before ')'"}},
        {"cube(,1);", {"1:6: expected ')' before ','"}},
        {"cube 5;", {"1:6: expected '(' or '=' before '5'"}},
        {"cube(5)", {"1:8: expected ';' or '{' before the end of the file"}},
        {"a([\n[1,\n2],\n[1e]]);",
         {"4:2: '1e' is no value: variables and functions belong to OpenSCAD source, not to an "
          "exported .csg: open the .scad file itself"}},
        {"g() {\n\tcube()\n}\n", {"2:8: expected ';' or '{' at the end of the line"}},
        {"cube(5)\n]", {"1:8: expected ';' or '{' at the end of the line"}},
        {"% ;", {"1:3: expected a name before ';'"}},
        {"x = 5", {"1:6: expected ';' before the end of the file"}},
        {"[1, 2];", {"1:1: unexpected '[1, 2]'"}},
        {"a();\n}\nb();\n}", {"2:1: this '}' closes nothing", "4:1: this '}' closes nothing"}},
        {"a() {\n  b() {\n  }\n", {"1:5: this '{' is never closed: '}' is missing"}},
        {"a() {\n  b() {\n", {"2:7: this '{' is never closed: '}' is missing"}},
        {"a(1;\nb(2;\nc(3);\nd(];",
         {"1:4: expected ')' before ';'", "2:4: expected ')' before ';'",
          "4:3: expected ')' before ']'"}},
        {"a(1 2) { b(; c(); }\nd(;",
         {"1:5: expected ')' before '2'", "1:12: expected ')' before ';'",
          "2:3: expected ')' before ';'"}},
        {"g() { a(] } b(;", {"1:9: expected ')' before ']'", "1:15: expected ')' before ';'"}},
        {"cube(5@);", {"1:7: unexpected character '@'"}},
        {"cube(5\xE2\x80\x9C);", {"1:7: unexpected character '\xE2\x80\x9C'"}},
        {"cube(5\x01\xFF);", {"1:7: unexpected byte 0x01", "1:8: unexpected byte 0xff"}},
        {"a(); /* b", {"1:6: this comment is never closed: '*/' is missing"}},
        {"text(\"abc);\ncube();\n", {"1:6: this string is never closed: '\"' is missing"}},
        {"text(\"abc);\ncube();\ntext(\"d\");sphere(;",
         {"1:6: this string is never closed: '\"' is missing", "3:18: expected ')' before ';'"}},
        {"a(\"b\" \"c\");", {"1:7: expected ')' before \"c\""}},
        {"a(-true); a(-[1]);", {"1:3: '-' needs a number", "1:13: '-' needs a number"}},
        {"a([0 : \"x\"]);", {"1:11: a range [begin : step : end] holds numbers only"}},
        {"a(aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa = =);",
         {"1:51: expected a value before '='"}},
        {"a(1 aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa);",
         {"1:5: expected ')' before 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa...'"}},
        // what only OpenSCAD source holds is told once
        {"for (i = [0 : 3]) cube(i); module a() {}", {"1:1: 'for'" SOURCE}},
        {"use <a.scad>\nb(;", {"1:1: 'use'" SOURCE}},
        {"\n  if (x) cube();", {"2:3: 'if'" SOURCE}},
        {"a([for (i = [1]) i]);", {"1:4: 'for'" SOURCE}},
        {"cube(1 + 2);", {"1:8: a calculation" SOURCE}},
        {"cube([1, 2 * 3]);", {"1:12: a calculation" SOURCE}},
        {"x = 1 == 2;", {"1:7: a calculation" SOURCE}},
        {"a();\ncube(size = w, x);", {"2:13: 'w'" VARIABLE}},
        {"cube(sin(30));", {"1:6: 'sin'" VARIABLE}},
    };

    (void)state;
    for (size_t i = 0; i < array_count(cases); i++) {
        struct messages messages = {0};
        struct csg_tree tree;
        char want[600];
        uint32_t count = 0;
        assert_false(parse(&tree, cases[i].input, &messages));
        for (; count < 4 && cases[i].messages[count]; count++) {
            snprintf(want, sizeof want, "a.csg:%s", cases[i].messages[count]);
            assert_true(messages.count > count);
            assert_string_equal(messages.items[count].text, want);
            assert_non_null(messages.items[count].source);
        }
        assert_int_equal(messages.errors, count);
        assert_null(tree.file);
        assert_null(tree.first);
        csg_free(&tree);
        messages_free(&messages);
    }
}

static void the_line_is_shown(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;

    (void)state;
    assert_false(parse(&tree, "a();\n\tcube(5;\nb();", &messages));
    assert_string_equal(messages.items[0].source, "   cube(5;\n         ^");
    messages_free(&messages);
}

static void errors_are_capped(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;
    char text[40 * 5 + 1] = "";

    (void)state;
    for (int i = 0; i < 40; i++)
        strcat(text, "a(;\n");
    assert_false(parse(&tree, text, &messages));
    assert_int_equal(messages.errors, 21);
    assert_string_equal(messages.items[20].text,
                        "a.csg: too many errors, the rest of the file is not read");
    messages_free(&messages);
}

static void zero_bytes_are_refused(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;
    char text[] = "cube();\0cube();\0";

    (void)state;
    assert_false(csg_parse(&tree, "a.csg", text, 15, &messages));
    assert_int_equal(messages.errors, 1);
    assert_string_equal(messages.items[0].text, "a.csg: not a text file: byte 8 is zero");
    messages_free(&messages);
}

static void missing_files_are_told(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;

    (void)state;
    assert_false(csg_parse_file(&tree, "/nonexistent/a.csg", &messages));
    assert_int_equal(messages.errors, 1);
    assert_null(tree.first);
    csg_free(&tree);
    messages_free(&messages);
}

static void trees_hold_what_was_written(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;

    (void)state;
    assert_true(parse(&tree,
                      "group() {\n  #cube(size = [1, 2, 3], center = true);\n  x = 4;\n}\n"
                      "cube([[1, 2],\n\n [\"a\"]], \"b\");",
                      &messages));
    const struct csg_node *group = tree.first, *cube = group->child, *assign = cube->next;
    assert_int_equal(tree.node_count, 4);
    assert_true(group->block);
    assert_string_equal(group->name, "group");
    assert_int_equal(cube->line, 2);
    assert_int_equal(cube->column, 4);
    assert_int_equal(cube->modifiers, CSG_HIGHLIGHT);
    assert_int_equal(cube->argument_count, 2);
    assert_string_equal(cube->arguments[0].name, "size");
    assert_int_equal(cube->arguments[0].value.kind, CSG_NUMBERS);
    assert_int_equal(cube->arguments[0].value.count, 3);
    assert_true(cube->arguments[0].value.numbers[2] == 3);
    assert_int_equal(cube->arguments[1].value.kind, CSG_BOOL);
    assert_string_equal(assign->name, CSG_ASSIGN);
    assert_string_equal(assign->arguments[0].name, "x");
    assert_true(assign->arguments[0].value.number == 4);
    const struct csg_node *second = group->next;
    assert_ptr_equal(second->name, cube->name);
    assert_null(second->arguments[0].name);
    assert_int_equal(second->arguments[0].value.kind, CSG_VECTOR);
    assert_int_equal(second->arguments[0].value.items[0].kind, CSG_NUMBERS);
    assert_int_equal(second->arguments[0].value.items[1].kind, CSG_VECTOR);
    assert_int_equal(second->arguments[1].value.count, 1);
    assert_null(second->next);
    csg_free(&tree);
    csg_free(&tree);
    messages_free(&messages);
}

static void places_count_lines_everywhere(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;

    (void)state;
    assert_true(parse(&tree,
                      "a(\"1\n2\", [1,\n2,\n3], [[1,\n2],\n[3,4\n]]); /*\n\n*/ //\n"
                      "%\n#\n  b();",
                      &messages));
    assert_int_equal(tree.first->next->line, 12);
    assert_int_equal(tree.first->next->column, 3);
    csg_free(&tree);
    messages_free(&messages);
}

static void check_number(const char *text)
{
    struct messages messages = {0};
    struct csg_tree tree;
    char input[200];

    snprintf(input, sizeof input, "a(%s, [%s]);", text, text);
    assert_true(parse(&tree, input, &messages));
    double want = strtod(text, NULL), got = tree.first->arguments[0].value.number;
    assert_memory_equal(&want, &got, sizeof want);
    assert_memory_equal(&want, tree.first->arguments[1].value.numbers, sizeof want);
    csg_free(&tree);
    messages_free(&messages);
}

static void numbers_are_exact(void **state)
{
    static const char *const special[] = {
        "0",
        "0.1",
        "0.3",
        "1e22",
        "1e23",
        "9007199254740993",
        "1e-22",
        "5e-324",
        "1e-23",
        "1.7976931348623157e308",
        "2.2250738585072011e-308",
        "0.000000000000000000000000000001",
        "123456789012345678901234567890",
        "0.12345678901234567890123456789",
        "1e0000000001",
        "00000000000000000000000001.5",
        "1e-400",
        "1e400",
        "1.e5",
        ".5e-3",
        "9007199254740992e22",
    };
    uint64_t random = 1;

    (void)state;
    for (size_t i = 0; i < array_count(special); i++)
        check_number(special[i]);
    for (int i = 0; i < 2000; i++) {
        char text[64];
        random = random * 6364136223846793005u + 1442695040888963407u;
        double v = ldexp((double)(random >> 11), (int)(random % 140) - 120);
        snprintf(text, sizeof text, i % 2 ? "%.17g" : "%.6g", v);
        check_number(text);
    }
}

// German writes 1,5: neither reading nor printing may listen to that. Skipped where that locale
// is not installed.
static void locales_do_not_matter(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;
    size_t size;

    (void)state;
    if (!setlocale(LC_ALL, "de_DE.UTF-8"))
        skip();
    assert_true(parse(&tree, "a(1.5, 1.2345678901234567890123);", &messages));
    char *text = csg_print(&tree, &size);
    setlocale(LC_ALL, "C");
    assert_string_equal(text, "a(1.5, 1.23457);\n\n");
    free(text);
    csg_free(&tree);
    messages_free(&messages);
}

static void nodes_come_in_order(void **state)
{
    struct messages messages = {0};
    struct csg_tree tree;
    struct csg_iterator it = {0};
    const struct csg_node *n;
    char names[16] = "";

    (void)state;
    assert_true(parse(&tree, "a() { b(); c() { d(); } e(); } f();", &messages));
    csg_enter(&it, tree.first);
    while ((n = csg_next(&it))) {
        strcat(names, n->name);
        csg_enter(&it, n->child);
    }
    assert_string_equal(names, "abcdef");

    names[0] = 0;
    csg_enter(&it, tree.first->child);
    while ((n = csg_next(&it))) // c is not entered, nor are the nodes around a
        strcat(names, n->name);
    assert_string_equal(names, "bce");
    csg_iterator_free(&it);
    csg_iterator_free(&it);
    csg_free(&tree);
    messages_free(&messages);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepted_text_prints),
        cmocka_unit_test(broken_text_is_explained),
        cmocka_unit_test(the_line_is_shown),
        cmocka_unit_test(errors_are_capped),
        cmocka_unit_test(zero_bytes_are_refused),
        cmocka_unit_test(missing_files_are_told),
        cmocka_unit_test(trees_hold_what_was_written),
        cmocka_unit_test(places_count_lines_everywhere),
        cmocka_unit_test(numbers_are_exact),
        cmocka_unit_test(locales_do_not_matter),
        cmocka_unit_test(nodes_come_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
