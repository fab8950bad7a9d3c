// Texts in whatever fonts the machine has: what may not depend on them.
#include "type/text.h"

#include "base/mem.h"
#include "base/parallel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct text_line plain = {
    .text = "Hamburg", .size = 10, .spacing = 1, .detail = {0, 12, 2}};

static struct messages messages;
static struct outline out;

static bool set(const struct text_line *line)
{
    messages_free(&messages);
    outline_free(&out);
    return text_outline(&out, line, (struct place){"a.csg", 3, 5}, &messages);
}

static int clear(void **state)
{
    (void)state;
    messages_free(&messages);
    outline_free(&out);
    return 0;
}

// A machine without any font can set nothing: said in one line, and the rest is skipped.
static void set_or_skip(const struct text_line *line)
{
    if (!set(line)) {
        assert_non_null(strstr(messages.items[0].text, "no font"));
        skip();
    }
}

static void assert_near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static void letters_are_shapes(void **state)
{
    (void)state;
    set_or_skip(&plain);
    assert_true(out.clean);
    assert_true(out.path_count >= 7);
    assert_true(outline_area(&out) > 0);
    assert_int_equal(messages.count, 0);
    struct box box = outline_bounds(&out);
    assert_true(box.max.x - box.min.x > 30 && box.max.x - box.min.x < 120);
    assert_true(box.max.y > 5 && box.max.y < 20);
}

static void no_text_is_no_shape(void **state)
{
    struct text_line line = plain;

    (void)state;
    line.text = NULL;
    assert_true(set(&line));
    assert_true(out.clean && out.path_count == 0);
    line.text = "";
    assert_true(set(&line));
    assert_true(out.clean && out.path_count == 0);
    line.text = "  ";
    set_or_skip(&line);
    assert_true(out.clean && out.path_count == 0);
}

static void size_scales(void **state)
{
    struct text_line line = plain;

    (void)state;
    line.detail.fn = 16;
    set_or_skip(&line);
    struct box small = outline_bounds(&out);
    line.size = 30;
    assert_true(set(&line));
    struct box large = outline_bounds(&out);
    for (int i = 0; i < 4; i++) {
        assert_near(box_corner(large, i).x, 3 * box_corner(small, i).x, 1e-4);
        assert_near(box_corner(large, i).y, 3 * box_corner(small, i).y, 1e-4);
    }
    line.size = 0;
    assert_true(set(&line));
    assert_int_equal(out.path_count, 0);
}

static void alignment_moves(void **state)
{
    struct text_line line = plain;

    (void)state;
    set_or_skip(&line);
    struct box left = outline_bounds(&out);
    line.halign = "right";
    assert_true(set(&line));
    struct box right = outline_bounds(&out);
    line.halign = "center";
    assert_true(set(&line));
    struct box centre = outline_bounds(&out);
    assert_near(centre.min.x, (left.min.x + right.min.x) / 2, 1e-4);
    assert_near(right.max.x - right.min.x, left.max.x - left.min.x, 1e-4);
    assert_true(right.max.x < 5 && left.min.x > -5);
    line.valign = "bottom";
    assert_true(set(&line));
    assert_true(outline_bounds(&out).min.y > -0.5);
}

// Exports of later versions of OpenSCAD: their letters stand where the font wants them.
static void newer_exports_align_exactly(void **state)
{
    struct text_line line = plain;

    (void)state;
    set_or_skip(&line);
    double width = outline_bounds(&out).max.x;
    line.halign = "default";
    line.valign = "top";
    assert_true(set(&line));
    assert_true(outline_bounds(&out).max.x > width * 1.01);
    assert_near(outline_bounds(&out).max.y, 0, 0.01);
    assert_int_equal(messages.count, 0);
    line.valign = "bottom";
    assert_true(set(&line));
    assert_near(outline_bounds(&out).min.y, 0, 0.01);
    line.direction = "ttb";
    line.halign = "left";
    line.valign = "default";
    assert_true(set(&line));
    assert_near(outline_bounds(&out).min.x, 0, 0.01);
}

static void spacing_stretches(void **state)
{
    struct text_line line = plain;

    (void)state;
    set_or_skip(&line);
    double width = outline_bounds(&out).max.x;
    line.spacing = 2;
    assert_true(set(&line));
    assert_true(outline_bounds(&out).max.x > 1.5 * width);
}

static void columns_go_down(void **state)
{
    struct text_line line = plain;

    (void)state;
    line.direction = "ttb";
    set_or_skip(&line);
    struct box box = outline_bounds(&out);
    assert_true(box.max.y - box.min.y > 2 * (box.max.x - box.min.x) && box.min.y < -40);
}

static void letters_over_each_other_are_one_shape(void **state)
{
    struct text_line line = plain;

    (void)state;
    line.text = "HHHH";
    line.spacing = 0;
    set_or_skip(&line);
    assert_int_equal(out.path_count, 1);
}

static void unknown_words_are_named(void **state)
{
    struct text_line line = plain;

    (void)state;
    line.halign = "middle";
    line.valign = "up";
    set_or_skip(&line);
    assert_int_equal(messages.warnings, 2);
    assert_string_equal(messages.items[0].text,
                        "a.csg:3:5: text: halign = \"middle\" is unknown: it may be "
                        "\"left\", \"center\", \"right\"");
    assert_string_equal(messages.items[1].text,
                        "a.csg:3:5: text: valign = \"up\" is unknown: it may be \"top\", "
                        "\"center\", \"bottom\" or \"baseline\"");
}

static void what_cannot_be_drawn_is_said(void **state)
{
    static const char *const broken[] = {
        "\xff", "a\xc3", "\xc0\x80", "\xed\xa0\x80", "\x80", "\xf4\x90\x80\x80", "\xe0\x80\x80"};
    struct text_line line = plain;

    (void)state;
    for (size_t i = 0; i < array_count(broken); i++) {
        line.text = broken[i];
        assert_false(set(&line));
        assert_true(out.clean && out.path_count == 0);
        assert_string_equal(messages.items[0].text,
                            "a.csg:3:5: text: not drawn: its letters are not UTF-8");
    }
    line = plain;
    line.size = (double)NAN;
    assert_false(set(&line));
    line = plain;
    line.spacing = (double)INFINITY;
    assert_false(set(&line));
    line = plain;
    set_or_skip(&line);
    line.size = 1e300;
    assert_false(set(&line));
    assert_true(out.clean && out.path_count == 0);
    assert_string_equal(messages.items[0].text,
                        "a.csg:3:5: text: not drawn: it is too large, or crosses itself too often");
}

static void any_letter_of_unicode_is_taken(void **state)
{
    struct text_line line = plain;

    (void)state;
    line.text = "\t\n\xc2\xa0\xed\x9f\xbf\xee\x80\x80\xf0\x90\x80\x80\xf4\x8f\xbf\xbf";
    set_or_skip(&line);
    assert_true(out.clean);
}

static void set_number(void *context, uint32_t item, uint32_t worker)
{
    static const char *const fonts[] = {"sans", "serif:bold", "mono"};
    uint64_t *hashes = context;
    struct messages own = {0};
    struct outline shape;
    struct text_line line = plain;
    char text[] = "A0";

    (void)worker;
    text[1] = (char)('0' + item / 3 % 10);
    line.text = text;
    line.font = fonts[item % 3];
    text_outline(&shape, &line, (struct place){0}, &own);
    hashes[item] = outline_hash(&shape);
    outline_free(&shape);
    messages_free(&own);
}

static void threads_share_the_fonts(void **state)
{
    enum { TEXTS = 60 };
    uint64_t together[TEXTS], alone[TEXTS];

    (void)state;
    parallel_for(TEXTS, 8, set_number, together);
    parallel_for(TEXTS, 1, set_number, alone);
    assert_memory_equal(together, alone, sizeof alone);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(letters_are_shapes, clear),
        cmocka_unit_test_teardown(no_text_is_no_shape, clear),
        cmocka_unit_test_teardown(size_scales, clear),
        cmocka_unit_test_teardown(alignment_moves, clear),
        cmocka_unit_test_teardown(newer_exports_align_exactly, clear),
        cmocka_unit_test_teardown(spacing_stretches, clear),
        cmocka_unit_test_teardown(columns_go_down, clear),
        cmocka_unit_test_teardown(letters_over_each_other_are_one_shape, clear),
        cmocka_unit_test_teardown(unknown_words_are_named, clear),
        cmocka_unit_test_teardown(what_cannot_be_drawn_is_said, clear),
        cmocka_unit_test_teardown(any_letter_of_unicode_is_taken, clear),
        cmocka_unit_test(threads_share_the_fonts),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
