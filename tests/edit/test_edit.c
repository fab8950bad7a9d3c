// test_edit.c - numbers and operations of a file, changed, undone, and written back.
#include "unit.h"

#include <math.h>

static void check_text(const struct edit *e, const char *expected)
{
    struct error err;
    char *text;
    size_t size;
    if (!edit_text(e, &text, &size, &err))
        fail_msg("%s", err.text);
    assert_string_equal(text, expected);
    assert_int_equal(size, strlen(expected));
    free(text);
}

static double number_at(const struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar)
{
    struct csg_value v;
    assert_true(edit_scalar(e, node, argument, scalar, &v));
    assert_int_equal(v.kind, CSG_NUMBER);
    return v.number;
}

static void numbers_change_and_nothing_else(void **state)
{
    (void)state;
    struct error err;
    struct edit *e = edit_of_text(
        "// a part\n\tdifference ( ) {\n"
        "multmatrix([[1, 0, 0, 5],\n\t[0,1,0,-2.50], [0,0,1,0], [0,0,0,1]]) /* 7 */ {\n"
        "cube(size = [ 1 , /* 2 */ 2e0, +3], center=true);}\n"
        "  sphere($fn = 0, $fa=12, r = -(-4)); } \r\n$fn = 8 ;\n");
    assert_true(edit_set_number(e, 1, 0, 3, 7.25, &err));
    assert_true(edit_set_number(e, 1, 0, 7, 0.1, &err));
    assert_true(edit_set_number(e, 2, 0, 1, -1e-7, &err));
    assert_true(edit_set_number(e, 2, 0, 2, 1e300, &err));
    assert_true(edit_set_boolean(e, 2, 1, 0, false, &err));
    assert_true(edit_set_number(e, 3, 2, 0, 1.0 / 3, &err));
    assert_true(edit_set_number(e, 4, 0, 0, 12, &err));
    assert_true(edit_set_operation(e, 0, "intersection", &err));
    const char changed[] =
        "// a part\n\tintersection ( ) {\n"
        "multmatrix([[1, 0, 0, 7.25],\n\t[0,1,0,0.1], [0,0,1,0], [0,0,0,1]]) /* 7 */ {\n"
        "cube(size = [ 1 , /* 2 */ -1e-07, +1e+300], center=false);}\n"
        "  sphere($fn = 0, $fa=12, r = -(-0.3333333333333333)); } \r\n$fn = 12 ;\n";
    check_text(e, changed);
    assert_true(number_at(e, 1, 0, 7) == 0.1);
    assert_true(edit_is_changed(e));
    edit_delete(e);
}

static void strings_are_passed_over(void **state)
{
    (void)state;
    struct error err;
    struct edit *e =
        edit_of_text("text(text = \"a\\\", size = 9, b\", size = 10, spacing = 1, font = \"\");"
                     "import(file = \"x, [(.stl\", layer = \"\\\"\", origin = [0, 0], scale = 1);");
    assert_true(edit_set_number(e, 0, 1, 0, 11, &err));
    assert_true(edit_set_number(e, 0, 2, 0, 2, &err));
    assert_true(edit_set_number(e, 1, 2, 1, -1, &err));
    assert_true(edit_set_number(e, 1, 3, 0, 3, &err));
    check_text(e, "text(text = \"a\\\", size = 9, b\", size = 11, spacing = 2, font = \"\");"
                  "import(file = \"x, [(.stl\", layer = \"\\\"\", origin = [0, -1], scale = 3);");
    edit_delete(e);
    // As OpenSCAD exports a text that holds a quote.
    const char raw[] =
        "text(text = \"2\" \\\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", "
        "language = \"en\", script = \"latin\", halign = \"left\", valign = \"b\", "
        "$fn = 0, $fa = 12, $fs = 2);";
    e = edit_of_text(raw);
    struct csg_value v;
    assert_true(edit_scalar(e, 0, 0, 0, &v));
    assert_string_equal(v.string, "2\" \\");
    assert_true(edit_set_number(e, 0, 9, 0, 5, &err));
    char expected[sizeof raw];
    strcpy(expected, raw);
    *strrchr(expected, '0') = '0';
    char *fn = strstr(expected, "$fn = 0");
    fn[6] = '5';
    check_text(e, expected);
    edit_delete(e);
}

static void what_cannot_be_changed(void **state)
{
    (void)state;
    struct error err;
    struct edit *e = edit_of_text("cube([1, 2], [1 : 5], true); hull() sphere(\"a\");");
    assert_false(edit_set_number(e, 0, 0, 2, 1, &err));        // there are two
    assert_false(edit_set_number(e, 0, 1, 0, 1, &err));        // a range
    assert_false(edit_set_number(e, 0, 2, 0, 1, &err));        // a boolean
    assert_false(edit_set_number(e, 0, 3, 0, 1, &err));        // no argument
    assert_false(edit_set_number(e, 9, 0, 0, 1, &err));        // no node
    assert_false(edit_set_number(e, 2, 0, 0, 1, &err));        // a string
    assert_false(edit_set_number(e, 0, 0, 0, NAN, &err));      //
    assert_false(edit_set_number(e, 0, 0, 0, INFINITY, &err)); //
    assert_false(edit_set_boolean(e, 0, 0, 0, true, &err));    // a number
    assert_false(edit_set_operation(e, 0, "union", &err));     // a cube
    assert_false(edit_set_operation(e, 1, "cube", &err));
    assert_false(edit_set_operation(e, 9, "union", &err));
    assert_false(edit_is_changed(e));
    assert_true(edit_set_boolean(e, 0, 2, 0, false, &err)); // behind the range
    char *text;
    size_t size;
    assert_false(edit_text(e, &text, &size, &err)); // says so, and writes nothing
    edit_delete(e);
}

static void steps_go_back_and_forth(void **state)
{
    (void)state;
    struct error err;
    const char text[] = "union() { cube(1.0); cube(2); }";
    struct edit *e = edit_of_text(text);
    assert_false(edit_undo(e));
    assert_false(edit_redo(e));
    for (int i = 2; i <= 9; i++) // a slider
        assert_true(edit_set_number(e, 1, 0, 0, i, &err));
    assert_true(edit_set_number(e, 2, 0, 0, 5, &err));
    edit_end_step(e);
    assert_true(edit_set_number(e, 2, 0, 0, 6, &err));
    assert_true(edit_set_operation(e, 0, "difference", &err));
    check_text(e, "difference() { cube(9); cube(6); }");
    uint64_t version = edit_version(e);
    assert_true(edit_undo(e));
    assert_int_not_equal(edit_version(e), version);
    check_text(e, "union() { cube(9); cube(6); }");
    assert_true(edit_undo(e));
    check_text(e, "union() { cube(9); cube(5); }");
    assert_true(edit_undo(e) && edit_undo(e));
    assert_false(edit_undo(e));
    assert_false(edit_is_changed(e));
    check_text(e, text); // 1.0 as it was
    assert_true(edit_redo(e) && edit_redo(e));
    check_text(e, "union() { cube(9); cube(5); }");
    assert_true(edit_set_number(e, 1, 0, 0, 1, &err)); // what was undone is gone
    assert_false(edit_redo(e));
    check_text(e, "union() { cube(1.0); cube(5); }");
    edit_delete(e);
}

// Each scalar of a tree can be found in the text, whatever the way it is written.
static void every_number_has_its_place(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "polyhedron(points = [[0, 0, 0], [1,0,0],[0,1,0] , [0,0,1]], faces = [[0,1,2],[0,3,1]]);",
        "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])cube([1e1,2.e-3,.5],true);",
        "a(1,,2,b=(3),c=-(4),d=- 5,e=--6,f=[],g=[[],[7,[8]]],h=[-9,undef,0x1F,true],);",
        "\xEF\xBB\xBF\n\n// 1\n color([0.1, /*,]*/ 0.2, 3, 1]) /* ( */ sphere(r=/* 8 */\n9);",
        "x = 3; $fa = -1; { cube(y = + 4); } group() {} *%cube([1, [2, \"],[3\", 4], 5]);",
    };
    for (size_t t = 0; t < array_count(texts); t++) {
        struct edit *e = edit_of_text(texts[t]);
        struct error err;
        struct csg_value v;
        const struct source *s = edit_source(e);
        double next = 1000.5;
        uint32_t changed = 0;
        for (uint32_t n = 0; n < s->node_count; n++)
            for (uint32_t a = 0; a < s->nodes[n]->argument_count; a++)
                for (uint32_t i = 0; edit_scalar(e, n, a, i, &v); i++) {
                    if (v.kind != CSG_NUMBER)
                        continue;
                    if (changed % 2)
                        next = -next;
                    assert_true(edit_set_number(e, n, a, i, next++, &err));
                    changed++;
                }
        char *text;
        size_t size;
        assert_true(changed >= 5);
        if (!edit_text(e, &text, &size, &err)) // reads it back
            fail_msg("%s: %s", texts[t], err.text);
        while (edit_undo(e))
            ;
        free(text);
        check_text(e, texts[t]);
        edit_delete(e);
    }
}

static void marks_are_not_saved(void **state)
{
    (void)state;
    struct csg_tree tree;
    const char text[] = "!cube(1); group() { #cube(2); cube(3); }";
    struct edit *e = edit_of_text(text);
    assert_int_equal(edit_marks(e, 2), CSG_HIGHLIGHT);
    edit_mark(e, 2, CSG_DISABLE);
    edit_mark(e, 3, CSG_ROOT);
    edit_mark(e, 1, CSG_ROOT | CSG_BACKGROUND);
    edit_tree(e, &tree);
    assert_int_equal(tree.first->modifiers, 0); // one at a time is shown alone
    assert_int_equal(tree.first->next->modifiers, CSG_ROOT | CSG_BACKGROUND);
    assert_int_equal(tree.first->next->child->modifiers, CSG_DISABLE);
    assert_int_equal(tree.first->next->child->next->modifiers, 0);
    csg_free(&tree);
    assert_false(edit_is_changed(e));
    assert_false(edit_undo(e));
    check_text(e, text);
    edit_unmark_all(e);
    edit_tree(e, &tree);
    assert_int_equal(tree.first->modifiers, CSG_ROOT);
    csg_free(&tree);
    edit_delete(e);
}

static void nodes_have_places(void **state)
{
    (void)state;
    struct edit *e = edit_of_text("\na() { b(); c() d(); }\n\n  e();");
    const struct source *s = edit_source(e);
    assert_int_equal(s->node_count, 5);
    for (uint32_t i = 0; i < s->node_count; i++)
        assert_int_equal(source_node_at(s, s->nodes[i]->line, s->nodes[i]->column), i);
    assert_int_equal(source_node_at(s, 2, 2), SOURCE_NONE);
    assert_int_equal(source_node_from(s, 1), 0);
    assert_int_equal(source_node_from(s, 3), 4);
    assert_int_equal(source_node_from(s, 5), SOURCE_NONE);
    const uint32_t parents[] = {SOURCE_NONE, 0, 0, 2, SOURCE_NONE}, spans[] = {4, 1, 2, 1, 1};
    for (uint32_t i = 0; i < 5; i++) {
        assert_int_equal(s->parent[i], parents[i]);
        assert_int_equal(s->span[i], spans[i]);
    }
    edit_delete(e);
    e = edit_of_text("");
    assert_int_equal(edit_source(e)->node_count, 0);
    check_text(e, "");
    edit_delete(e);
    edit_delete(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_change_and_nothing_else),
        cmocka_unit_test(strings_are_passed_over),
        cmocka_unit_test(what_cannot_be_changed),
        cmocka_unit_test(steps_go_back_and_forth),
        cmocka_unit_test(every_number_has_its_place),
        cmocka_unit_test(marks_are_not_saved),
        cmocka_unit_test(nodes_have_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
