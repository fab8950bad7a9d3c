// test_parameters.c - widgets from comments, values in place, what survives a reload, texts.
#include "customizer/parameters.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
// after those
#include <cmocka.h>

static struct parameters read_text(const char *text)
{
    struct parameters p;
    parameters_read(&p, text, strlen(text));
    return p;
}

static struct parameter *get(const struct parameters *p, const char *name)
{
    struct parameter *found = parameters_find(p, name);
    assert_non_null(found);
    return found;
}

// "x=<value>; // <comment>" as one text.
static const struct parameter *one(struct parameters *p, const char *value, const char *comment)
{
    char text[400];
    snprintf(text, sizeof text, "x = %s; %s\n", value, comment);
    *p = read_text(text);
    assert_int_equal(p->count, 1);
    return &p->items[0];
}

static void literals_have_kinds(void **state)
{
    static const struct {
        const char *value;
        enum parameter_kind kind;
        const char *text;
    } rows[] = {
        {"true", PARAMETER_BOOL, "true"},
        {"!1", PARAMETER_BOOL, "false"},
        {"1.50", PARAMETER_NUMBER, "1.5"},
        {"- - 2e3", PARAMETER_NUMBER, "2000"},
        {"(-0.1)", PARAMETER_NUMBER, "-0.1"},
        {"0.1234567890123", PARAMETER_NUMBER, "0.1234567890123"},
        {"\"a\\\"b\\\\\"", PARAMETER_STRING, "a\"b\\"},
        {"[1]", PARAMETER_VECTOR, "[1]"},
        {"[1, -2, 3,, 4,]", PARAMETER_VECTOR, "[1, -2, 3, 4]"},
        {"-[1, 2]", PARAMETER_VECTOR, "[-1, -2]"},
        {"[]", PARAMETER_SOURCE, "[]"},
        {"[1, 2, 3, 4, 5]", PARAMETER_SOURCE, "[1, 2, 3, 4, 5]"},
        {"[[1, \"a\"], true]", PARAMETER_SOURCE, "[[1, \"a\"], true]"},
        {"[0 : 0.5:4]", PARAMETER_SOURCE, "[0 : 0.5 : 4]"},
    };
    (void)state;
    for (size_t i = 0; i < array_count(rows); i++) {
        struct parameters p;
        const struct parameter *x = one(&p, rows[i].value, "");
        char *text = parameter_text(x);
        assert_int_equal(x->kind, rows[i].kind);
        assert_string_equal(text, rows[i].text);
        assert_false(parameter_is_changed(x));
        free(text);
        parameters_free(&p);
    }
}

static void what_is_calculated_is_no_parameter(void **state)
{
    static const char *const texts[] = {
        "x = 1 + 1;",
        "x = y;",
        "x = undef;",
        "x = -\"a\";",
        "x = f(1);",
        "x = [for (i = [0 : 2]) i];",
        "x = [1, y];",
        "x = 1 ? 2 : 3;",
        "x = 1e999;",
        "x = [1",
        "x = 1",
        "x = \"",
        "x = 1; /*",
        "/* x = 1; */",
        "module m() { x = 1; }",
        "x = 1; x = y;",
        "x = 1; { }",
        "x = 1;\nmodule m() { }\nx = 2;",
        "translate(x = 1) cube();",
    };
    (void)state;
    for (size_t i = 0; i < array_count(texts); i++) {
        struct parameters p = read_text(texts[i]);
        if (p.count != (strcmp(texts[i], "x = 1; /*") == 0))
            fail_msg("%s: %u parameters", texts[i], p.count);
        parameters_free(&p);
    }
}

static void numbers_have_ranges_and_steps(void **state)
{
    static const struct {
        const char *value, *comment;
        bool ranged;
        double min, max, step;
    } rows[] = {
        {"5", "", false, 0, 0, 1},
        {"5.25", "", false, 0, 0, 0.01},
        {"1e-3", "", false, 0, 0, 0.001},
        {"5", "// .5", false, 0, 0, 0.5},
        {"5", "// -1", false, 0, 0, 1},
        {"5", "// [100]", true, 0, 100, 1},
        {"-5", "// [-100]", true, -100, 0, 1},
        {"5", "// [-100]", true, -100, 5, 1},
        {"[-1, 50]", "// [0:9]", true, -1, 50, 1},
        {"5", "// [1:10]", true, 1, 10, 1},
        {"0.5", "// [0:1]", true, 0, 1, 0.1},
        {"5", "// [0 : 2 : 9]", true, 0, 9, 2},
        {"0.3", "// [0:0.1:1]", true, 0, 1, 0.1},
        {"5", "// [10:-1:0]", true, 0, 10, 1},
        {"5", "// [3:3]", true, 3, 5, 1},
        {"3", "// [3:3]", false, 3, 3, 1},
        {"5", "// [0:20:10]", true, 0, 10, 20},
        {"5", "// [0:0:10]", true, 0, 10, 1},
        {"[1, 2.5]", "// [0:9]", true, 0, 9, 0.1},
        {"[1, 2]", "// [7]", true, 0, 7, 1},
        {"[1, 2]", "// [7, 8]", false, 0, 0, 1},
    };
    (void)state;
    for (size_t i = 0; i < array_count(rows); i++) {
        struct parameters p;
        const struct parameter *x = one(&p, rows[i].value, rows[i].comment);
        if (x->ranged != rows[i].ranged || x->min != rows[i].min || x->max != rows[i].max ||
            x->step != rows[i].step || x->choice_count)
            fail_msg("%s %s: %d %g %g %g", rows[i].value, rows[i].comment, x->ranged, x->min,
                     x->max, x->step);
        parameters_free(&p);
    }
}

static void lists_are_choices(void **state)
{
    static const struct {
        const char *value, *comment, *choices;
    } rows[] = {
        {"2", "// [1, 2, 3]", "1=1|2=2|3=3|"},
        {"20", "// [10:Low, 20: Very High, 30]", "10=Low|20=Very High|30=30|"},
        {"\"S\"", "// [S:Small, M:Medium]", "S=Small|M=Medium|"},
        {"\"b c\"", "// [a, b  c, \"d, e\"]", "a=a|b c=b c|d, e=d, e|"},
        {"\"1\"", "// [1, 2.50:x]", "1=1|2.5=x|"},
        // The source's value comes first where the list lacks it.
        {"5", "// [1, 2]", "5=5|1=1|2=2|"},
        {"\"z\"", "// [a, b]", "z=z|a=a|b=b|"},
        // Words are no numbers.
        {"1", "// [a, 1]", "1=1|"},
        {"1", "// [a, b]", ""},
        {"1", "// [1, 2,]", ""},
        {"true", "// [1, 2]", ""},
        {"[1, 2, 3, 4, 5]", "// [1, 2]", ""},
    };
    (void)state;
    for (size_t i = 0; i < array_count(rows); i++) {
        struct parameters p;
        char text[200] = "";
        const struct parameter *x = one(&p, rows[i].value, rows[i].comment);
        for (uint32_t n = 0; n < x->choice_count; n++) {
            const struct parameter_choice *c = &x->choices[n];
            if (x->kind == PARAMETER_NUMBER)
                assert_true(strtod(c->text, NULL) == c->number);
            snprintf(text + strlen(text), sizeof text - strlen(text), "%s=%s|", c->text, c->label);
        }
        assert_string_equal(text, rows[i].choices);
        parameters_free(&p);
    }
}

static void strings_have_lengths(void **state)
{
    struct parameters p;
    (void)state;
    assert_int_equal(one(&p, "\"a\"", "// 8")->length_most, 8);
    parameters_free(&p);
    assert_int_equal(one(&p, "\"a\"", "// [9]")->length_most, 9);
    parameters_free(&p);
    assert_int_equal(one(&p, "\"a\"", "// any text")->length_most, 0);
    parameters_free(&p);
    assert_int_equal(one(&p, "\"a\"", "// -3")->length_most, 0);
    parameters_free(&p);
}

static void comments_name_and_describe(void **state)
{
    struct parameters p = read_text("a = 1;\n"
                                    "/* [ Size of it ] */\n"
                                    "//  how wide \n"
                                    "b = 2; // [0:5]\n"
                                    "c = 3;\n"
                                    "/* [Hidden] */\nd = 4;\n"
                                    "/* [Global] */\ne = 5;\n"
                                    "/* just words */\nf = 6;\n");
    (void)state;
    assert_int_equal(p.count, 6);
    assert_string_equal(get(&p, "a")->group, "Parameters");
    assert_string_equal(get(&p, "b")->group, "Size of it");
    assert_string_equal(get(&p, "b")->description, "how wide");
    assert_int_equal(get(&p, "b")->line, 4);
    assert_string_equal(get(&p, "c")->group, "Size of it");
    assert_string_equal(get(&p, "c")->description, "");
    assert_true(get(&p, "d")->hidden);
    assert_true(get(&p, "e")->global);
    assert_false(get(&p, "b")->hidden || get(&p, "b")->global);
    assert_string_equal(get(&p, "f")->group, "Parameters");
    assert_null(parameters_find(&p, "g"));
    parameters_free(&p);
    parameters_free(&p);
}

// Where OpenSCAD 2021.01 loses the rest of the file.
static void windows_lines_and_odd_strings_are_understood(void **state)
{
    struct parameters p = read_text("// width\r\na = 1; // [0:5]\r\n/* [G] */\r\n"
                                    "b = \"C:\\\\\"; // 9\r\nc = \"{\"; // [{, }]\r\nd = 4;");
    (void)state;
    assert_int_equal(p.count, 4);
    assert_string_equal(get(&p, "a")->description, "width");
    assert_true(get(&p, "a")->ranged);
    assert_string_equal(get(&p, "b")->value.text, "C:\\");
    assert_int_equal(get(&p, "b")->length_most, 9);
    assert_int_equal(get(&p, "c")->choice_count, 2);
    assert_string_equal(get(&p, "d")->group, "G");
    parameters_free(&p);
}

static void values_are_set_from_text(void **state)
{
    static const struct {
        const char *source, *text, *result; // result NULL: refused
    } rows[] = {
        {"true", "false", "false"},
        {"true", " 0 ", "false"},
        {"false", "1", "true"},
        {"true", "False", NULL},
        {"true", "", NULL},
        {"1", " 2.5 ", "2.5"},
        {"1", "5mm", NULL},
        {"1", "[5]", NULL},
        {"1", "1 2", NULL},
        {"1", "\"5\"", NULL},
        {"1", "true", NULL},
        {"\"a\"", "b \"c\" \\", "b \"c\" \\"},
        {"\"a\"", "5", "5"},
        {"[1, 2]", "[3,4]", "[3, 4]"},
        {"[1, 2]", "[3, 4, 5]", "[3, 4, 5]"},
        {"[1, 2]", "[3:4]", NULL},
        {"[1, 2]", "3, 4", NULL},
        {"[1, 2]", "[]", NULL},
        {"[0:5]", "[1 : 2 : 9]", "[1 : 2 : 9]"},
        {"[0:5]", "[1, 2]", NULL},
        {"[\"a\", 1]", "[b c, 2]", "[\"b c\", 2]"},
        {"[[1], [2]]", "[[3], []]", "[[3], []]"},
        {"[1, true]", "[undef, false]", "[undef, false]"},
        {"[[1], [2]]", "[1]; cube()", NULL},
        {"[[1], [2]]", "f(1)", NULL},
    };
    (void)state;
    for (size_t i = 0; i < array_count(rows); i++) {
        struct parameters p;
        one(&p, rows[i].source, "");
        struct parameter *x = &p.items[0];
        bool ok = parameter_set(x, rows[i].text);
        if (ok != (rows[i].result != NULL) || parameter_is_changed(x) != ok)
            fail_msg("%s: '%s' is %s", rows[i].source, rows[i].text, ok ? "taken" : "refused");
        char *text = parameter_text(x);
        if (ok)
            assert_string_equal(text, rows[i].result);
        free(text);
        parameter_reset(x);
        assert_false(parameter_is_changed(x));
        parameters_free(&p);
    }
}

static void sliders_snap_to_steps(void **state)
{
    struct parameters p;
    (void)state;
    const struct parameter *x = one(&p, "3", "// [1:2.5:9]");
    assert_true(parameter_snap(x, -5) == 1);
    assert_true(parameter_snap(x, 2) == 1);
    assert_true(parameter_snap(x, 2.3) == 3.5);
    assert_true(parameter_snap(x, 100) == 8.5);
    parameters_free(&p);
    x = one(&p, "0.3", "// [0:0.1:1]");
    assert_true(parameter_snap(x, 0.97) == 1);
    assert_true(parameter_snap(x, 0.33) == 3 * 0.1);
    parameters_free(&p);
    x = one(&p, "3", "// [0:20:10]");
    assert_true(parameter_snap(x, 9) == 0);
    parameters_free(&p);
    x = one(&p, "3", "");
    assert_true(parameter_snap(x, 2.3) == 2.3);
    parameters_free(&p);
}

static void choices_are_chosen(void **state)
{
    struct parameters p = read_text("a = 2; // [1, 2, 3]\nb = \"x\"; // [x, y:Why]\n");
    struct parameter *a = get(&p, "a"), *b = get(&p, "b");
    (void)state;
    assert_int_equal(parameter_choice(a), 1);
    parameter_choose(a, 2);
    parameter_choose(b, 1);
    assert_true(a->value.numbers[0] == 3);
    assert_string_equal(b->value.text, "y");
    assert_int_equal(parameter_choice(b), 1);
    a->value.numbers[0] = 7;
    assert_int_equal(parameter_choice(a), 3);
    parameters_free(&p);
}

static void a_reload_keeps_what_the_user_changed(void **state)
{
    struct parameters old = read_text("a = 1; b = 2; c = true; d = \"x\"; gone = 1; e = [1, 2];"
                                      "f = 1; long = [1, 2, 3, 4, 5];");
    struct parameters new = read_text("f = \"text\"; e = [1, 2]; d = \"x\"; // 20\n"
                                      "c = true; b = 20; a = 1; long = [1, 2, 3, 4, 5]; n = 3;");
    (void)state;
    get(&old, "a")->value.numbers[0] = 10;
    get(&old, "b")->value.numbers[0] = 11;
    get(&old, "c")->value.boolean = false;
    parameter_set(get(&old, "d"), "mine");
    parameter_set(get(&old, "e"), "[7, 8, 9]");
    get(&old, "f")->value.numbers[0] = 12;
    parameter_set(get(&old, "long"), "[5, 4, 3, 2, 1]");
    parameters_carry(&new, &old);
    parameters_free(&old);
    assert_true(get(&new, "a")->value.numbers[0] == 10);
    assert_true(parameter_is_changed(get(&new, "a")));
    assert_true(get(&new, "b")->value.numbers[0] == 20); // the source was changed last
    assert_false(get(&new, "c")->value.boolean);
    assert_string_equal(get(&new, "d")->value.text, "mine");
    assert_int_equal(get(&new, "e")->value.count, 3);
    assert_string_equal(get(&new, "f")->value.text, "text");
    assert_string_equal(get(&new, "long")->value.text, "[5, 4, 3, 2, 1]");
    assert_true(get(&new, "n")->value.numbers[0] == 3);
    parameters_carry(&new, &old); // none
    parameters_free(&new);
}

static void texts_hold_what_differs(void **state)
{
    struct parameters p = read_text("a = 1; b = true; s = \"x\"; v = [1, 2]; r = [0:3];");
    char *flags = parameters_flags(&p), *lines = parameters_source_lines(&p);
    (void)state;
    assert_string_equal(flags, "");
    assert_string_equal(lines, "");
    free(flags);
    free(lines);
    get(&p, "a")->value.numbers[0] = 0.1;
    get(&p, "b")->value.boolean = false;
    parameter_set(get(&p, "s"), "it's \"a\\b\"\n$HOME");
    get(&p, "v")->value.numbers[1] = -1e-9;
    flags = parameters_flags(&p);
    lines = parameters_source_lines(&p);
    assert_string_equal(flags, "-D 'a=0.1' -D 'b=false' "
                               "-D 's=\"it'\\''s \\\"a\\\\b\\\"\\n$HOME\"' -D 'v=[1, -1e-9]'");
    assert_string_equal(lines, "a = 0.1;\nb = false;\ns = \"it's \\\"a\\\\b\\\"\\n$HOME\";\n"
                               "v = [1, -1e-9];\n");
    free(flags);
    free(lines);
    char *definition = parameter_definition(get(&p, "r"));
    assert_string_equal(definition, "r=[0 : 3]");
    free(definition);
    parameters_free(&p);
}

static void json_is_as_newer_versions_write_it(void **state)
{
    struct parameters p = read_text("/* [G] */\n// how many\nn = 2; // [0:5]\ns = \"a\"; // 9\n"
                                    "c = \"x\"; // [x:Ex, y]\nb = true;\nv = [1, 2]; // .5\n"
                                    "l = [1, 2, 3, 4, 5];\n/* [Hidden] */\nh = 1;\n");
    char *json = parameters_json(&p, "part"), *to = json;
    (void)state;
    for (const char *at = json; *at; at++) // blanks are of no interest
        if (*at != '\t' && *at != '\n' && *at != ' ')
            *to++ = *at;
    *to = 0;
    assert_string_equal(
        json,
        "{\"parameters\":[{\"caption\":\"howmany\",\"group\":\"G\",\"initial\":2,\"max\":5,"
        "\"min\":0,\"name\":\"n\",\"step\":1,\"type\":\"number\"},"
        "{\"group\":\"G\",\"initial\":\"a\",\"maxLength\":9,\"name\":\"s\","
        "\"type\":\"string\"},"
        "{\"group\":\"G\",\"initial\":\"x\",\"name\":\"c\",\"options\":["
        "{\"name\":\"Ex\",\"value\":\"x\"},{\"name\":\"y\",\"value\":\"y\"}],\"type\":\"string\"},"
        "{\"group\":\"G\",\"initial\":true,\"name\":\"b\",\"type\":\"boolean\"},"
        "{\"group\":\"G\",\"initial\":[1,2],\"name\":\"v\","
        "\"type\":\"number\"}],\"title\":\"part\"}");
    free(json);
    parameters_free(&p);
}

// A text of a repeated piece.
static char *many(const char *head, const char *piece, size_t count, const char *tail)
{
    size_t length = strlen(piece);
    char *text = mem_alloc(strlen(head) + length * count + strlen(tail) + 1), *to = text;
    to = stpcpy(to, head);
    for (size_t i = 0; i < count; i++)
        to = stpcpy(to, piece);
    strcpy(to, tail);
    return text;
}

static void hostile_text_is_bounded(void **state)
{
    static const struct {
        const char *head, *piece, *tail;
        uint32_t count; // of parameters
    } rows[] = {
        {"x = ", "[", ";\ny = 1;", 0}, {"x = ", "(", "1;", 0},
        {"x = ", "-", "1;", 1},        {"x = 1; // [", "a,", "b]", 1},
        {"x = 1; // ", "a ", "", 1},   {"x = 1; // [", "[", "", 1},
        {"x = \"", "\\", "", 0},       {"", "/* [g] */ ", "\nx = 1;", 1},
        {"/*", "[", "*/\nx = 1;", 1},  {"", "{", "", 0},
        {"", "}", "x = 1;", 1},        {"x = [", "1,", "];", 1},
        {"", "x=1;", "", 1},           {"", "error", "; x = 1;", 1},
    };
    (void)state;
    for (size_t i = 0; i < array_count(rows); i++) {
        char *text = many(rows[i].head, rows[i].piece, 200000, rows[i].tail);
        struct parameters p = read_text(text);
        if (p.count != rows[i].count)
            fail_msg("%s%s...: %u parameters", rows[i].head, rows[i].piece, p.count);
        parameters_free(&p);
        free(text);
    }
}

static void many_names_are_quick(void **state)
{
    enum { COUNT = 50000 };
    char *text = mem_alloc((size_t)COUNT * 40), *to = text;
    (void)state;
    for (int i = 0; i < COUNT; i++)
        to += sprintf(to, "n%d = %d; // [0:9]\n", i, i % 10);
    struct parameters p, again;
    parameters_read(&p, text, (size_t)(to - text));
    parameters_read(&again, text, (size_t)(to - text));
    assert_int_equal(p.count, COUNT);
    assert_string_equal(p.items[COUNT - 1].name, "n49999");
    p.items[7].value.numbers[0] = 3.5;
    parameters_carry(&again, &p);
    assert_true(again.items[7].value.numbers[0] == 3.5);
    parameters_free(&p);
    parameters_free(&again);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(literals_have_kinds),
        cmocka_unit_test(what_is_calculated_is_no_parameter),
        cmocka_unit_test(numbers_have_ranges_and_steps),
        cmocka_unit_test(lists_are_choices),
        cmocka_unit_test(strings_have_lengths),
        cmocka_unit_test(comments_name_and_describe),
        cmocka_unit_test(windows_lines_and_odd_strings_are_understood),
        cmocka_unit_test(values_are_set_from_text),
        cmocka_unit_test(sliders_snap_to_steps),
        cmocka_unit_test(choices_are_chosen),
        cmocka_unit_test(a_reload_keeps_what_the_user_changed),
        cmocka_unit_test(texts_hold_what_differs),
        cmocka_unit_test(json_is_as_newer_versions_write_it),
        cmocka_unit_test(hostile_text_is_bounded),
        cmocka_unit_test(many_names_are_quick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
