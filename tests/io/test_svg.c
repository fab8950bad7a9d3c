// test_svg.c - SVG pictures: shapes, paths, strokes, transforms, the page, and hostile files.
#include "flat.h"
#include "io/read_svg.h"

#define SVG(attributes, body)                                                                      \
    "<svg xmlns=\"http://www.w3.org/2000/svg\" " attributes ">" body "</svg>"
#define PAGE    "viewBox=\"0 0 100 100\" width=\"100mm\" height=\"100mm\""
#define RECT    "<rect x=\"1\" y=\"2\" width=\"10\" height=\"5\"/>"
#define PATH(d) "<path d=\"" d "\"/>"

static const struct svg_options plain = {.dpi = 72, .detail = {0, 12, 2}};

static struct outline read_with(const char *text, struct svg_options options)
{
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    char *copy = exact_copy(text, strlen(text));
    if (!read_svg("a.svg", copy, strlen(text), &options, &o, &messages, &err))
        fail_msg("%s", err.text);
    messages_free(&messages);
    free(copy);
    return o;
}

static struct outline read_text(const char *text)
{
    return read_with(text, plain);
}

static void refuse(const char *text, const char *what)
{
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    char *copy = exact_copy(text, strlen(text));
    assert_false(read_svg("a.svg", copy, strlen(text), &plain, &o, &messages, &err));
    if (!strstr(err.text, what))
        fail_msg("'%s' does not say '%s'", err.text, what);
    messages_free(&messages);
    free(copy);
}

static void shapes_are_drawn(void **state)
{
    (void)state;
    struct outline o = read_text(SVG(PAGE, RECT));
    EXPECT(o, {11, 98}, {1, 98}, {1, 93}, {11, 93});
    o = read_text(SVG(PAGE, "<polygon points=\"1,2 30,2 30,30 1\"/>"));
    EXPECT(o, {30, 98}, {1, 98}, {30, 70});
    o = read_text(SVG(PAGE, "<circle cx=\"5\" cy=\"5\" r=\"3\"/>"));
    assert_int_equal(o.point_count, 40);
    assert_true(has_point(&o, (struct vec2){7.963058, 94.530701}));
    outline_free(&o);
    o = read_text(SVG(PAGE, "<rect x=\"1\" y=\"2\" width=\"10\" height=\"6\" ry=\"2\"/>"));
    assert_int_equal(o.point_count, 40);
    assert_true(has_point(&o, (struct vec2){9.347290, 92.030380}));
    outline_free(&o);
}

static void hidden_parts_are_not_drawn(void **state)
{
    (void)state;
    struct outline o = read_text(SVG(PAGE, "<g><defs><g>" RECT "</g></defs></g>"));
    assert_int_equal(o.point_count, 0);
    outline_free(&o);
    o = read_text(SVG(PAGE, "<unknown>" RECT "</unknown>"));
    EXPECT(o, {11, 98}, {1, 98}, {1, 93}, {11, 93});
}

static void paths_are_filled_after_z(void **state)
{
    (void)state;
    struct outline o = read_text(SVG(PAGE, PATH("m1 1h5v5zl20 20h5v5h-5z")));
    EXPECT(o, {6, 99}, {1, 99}, {6, 94}, {26, 79}, {21, 79}, {21, 74}, {26, 74});
    o = read_text(SVG(PAGE, PATH("M1 1 5 1 5 5z M10 10 L20 10 20 20")));
    EXPECT(o, {5, 99}, {1, 99}, {5, 95}, {20, 90}, {10, 90}, {20, 80});
    o = read_text(SVG(PAGE, PATH("M1,1L5,1,5-5,1 1 foo 3")));
    EXPECT(o, {5, 99}, {1, 99}, {5, 105});
}

static void open_paths_are_lines(void **state)
{
    (void)state;
    struct outline o = read_text(SVG(PAGE, PATH("M1 1 L5 1 5 5")));
    EXPECT(o, {5.5, 99.5}, {0.5, 99.5}, {0.5, 98.5}, {4.5, 98.5}, {4.5, 94.5}, {5.5, 94.5});
    o = read_text(SVG(PAGE, "<path d=\"M1 1H50\" style=\"stroke-width:2;stroke-linecap:butt\" "
                            "stroke-width=\"4\"/>"));
    EXPECT(o, {50, 101}, {1, 101}, {1, 97}, {50, 97});
    o = read_text(SVG(PAGE, "<polyline points=\"1,2 30,2\" stroke-width=\"3px\"/>"));
    EXPECT(o, {30.5, 98.5}, {0.5, 98.5}, {0.5, 97.5}, {30.5, 97.5});
    o = read_text(SVG(PAGE, "<line x1=\"1\" y1=\"2\" x2=\"30\" y2=\"2\" "
                            "transform=\"scale(2,3)\"/>"));
    EXPECT(o, {61, 95.5}, {1, 95.5}, {1, 92.5}, {61, 92.5});
}

static void curves_have_steps(void **state)
{
    (void)state;
    struct outline o = read_text(SVG(PAGE, PATH("M0 0 Q5 5 10 0T20 0z")));
    assert_int_equal(o.point_count, 42);
    assert_true(has_point(&o, (struct vec2){19.5, 100.475}));
    outline_free(&o);
    o = read_text(SVG(PAGE, PATH("M0 0 C0 5 10 5 10 0z")));
    assert_int_equal(o.point_count, 21);
    assert_true(has_point(&o, (struct vec2){5.747498, 96.287506}));
    outline_free(&o);
    o = read_text(SVG(PAGE, PATH("M0 0 A5 2 30 1 0 10 0z")));
    assert_int_equal(o.point_count, 15);
    assert_true(has_point(&o, (struct vec2){10.545242, 95.490952}));
    outline_free(&o);
    o = read_text(SVG(PAGE, PATH("M0 0a1 1 0 0110 0z"))); // flags without blanks
    assert_int_equal(o.point_count, 15);
    outline_free(&o);
}

static void elements_are_united(void **state)
{
    (void)state;
    struct outline o = read_text(SVG(PAGE, PATH("M0 0h10v10h-10z") PATH("M5 5v10h10v-10z")));
    EXPECT(o, {15, 95}, {10, 95}, {10, 100}, {0, 100}, {0, 90}, {5, 90}, {5, 85}, {15, 85});
    o = read_text(SVG(PAGE, PATH("M0 0h10v10h-10z M2 2h6v6h-6z")));
    assert_int_equal(o.path_count, 2);
    assert_true(fabs(outline_area(&o) - 64) < 1e-9);
    outline_free(&o);
}

static void transforms_nest(void **state)
{
    (void)state;
    struct outline o = read_text(
        SVG(PAGE, "<g transform=\"translate(5,5)\"><g transform=\"scale(2)\">" RECT "</g></g>"));
    EXPECT(o, {27, 91}, {7, 91}, {7, 81}, {27, 81});
#define TURNED(list)                                                                               \
    SVG(PAGE, "<rect x=\"1\" y=\"2\" width=\"10\" height=\"5\" transform=\"" list "\"/>")
    o = read_text(TURNED("rotate(90 , 3,4) scale(2)"));
    EXPECT(o, {3, 97}, {-7, 97}, {-7, 77}, {3, 77});
    o = read_text(TURNED("skewX(45) skewY(10) matrix(1,0,0,1,5,6)"));
    EXPECT(o, {26.821228, 89.178757}, {15.057953, 90.942032}, {20.057953, 85.942032},
           {31.821228, 84.178757});
    o = read_text(TURNED("foo(3) translate(5 5)"));
    EXPECT(o, {16, 93}, {6, 93}, {6, 88}, {16, 88});
    o = read_text(TURNED("translate(5 5 5)"));
    EXPECT(o, {11, 98}, {1, 98}, {1, 93}, {11, 93});
}

static void the_page_gives_the_scale(void **state)
{
    (void)state;
    struct outline o = read_text(SVG("", RECT));
    EXPECT(o, {11, -2}, {1, -2}, {1, -7}, {11, -7});
    o = read_text(SVG("width=\"1in\" height=\"1in\"", RECT));
    EXPECT(o, {11, 23.4}, {1, 23.4}, {1, 18.4}, {11, 18.4});
    o = read_text(SVG("viewBox=\"0 0 50 100\" width=\"100mm\"", RECT));
    EXPECT(o, {45.06111, 34.57222}, {41.53333, 34.57222}, {41.53333, 32.80833},
           {45.06111, 32.80833});
    o = read_text(SVG("viewBox=\"-5 10 100 50\" width=\"10mm\" height=\"10mm\" "
                      "preserveAspectRatio=\"xMaxYMax slice\"",
                      RECT));
    EXPECT(o, {-6.8, 7.6}, {-8.8, 7.6}, {-8.8, 6.6}, {-6.8, 6.6});
    struct svg_options fine = plain;
    fine.dpi = 96;
    o = read_with(SVG("viewBox=\"0 0 50 100\"", RECT), fine);
    EXPECT(o, {2.91042, 25.92917}, {0.26457, 25.92917}, {0.26457, 24.60625}, {2.91042, 24.60625});
    struct svg_options centre = plain;
    centre.center = true;
    o = read_with(SVG(PAGE, RECT), centre);
    EXPECT(o, {5, 2.5}, {-5, 2.5}, {-5, -2.5}, {5, -2.5});
}

static void newer_versions_choose_parts(void **state)
{
    (void)state;
    static const char text[] =
        SVG(PAGE, RECT "<g id=\"a\">" PATH(
                      "M1 1h5v5z") "</g>"
                                   "<g inkscape:groupmode=\"layer\" inkscape:label=\"b c\">" PATH(
                                       "M11 1h5v5z") "</g>");
    struct svg_options part = plain;
    part.newer = true;
    part.id = "a";
    struct outline o = read_with(text, part);
    EXPECT(o, {6, 99}, {1, 99}, {6, 94});
    part.id = NULL;
    part.layer = "b c";
    o = read_with(text, part);
    EXPECT(o, {16, 99}, {11, 99}, {16, 94});
}

static void broken_files_are_refused(void **state)
{
    (void)state;
    refuse("", "a.svg:1: no element found");
    refuse("<svg>\n<rect", "a.svg:2: ");
    refuse("<svg></g>", "mismatched tag");
    refuse(SVG(PAGE, "<path d=\"M1 1l1e300 1e300 1e308 1e308 1e308 1e308z\"/>"), "too large");
    static const char bomb[] =
        "<!DOCTYPE svg [<!ENTITY a \"M0 0h1v1zM0 0h1v1zM0 0h1v1zM0 0h1v1zM0 0h1v1z\">\n"
        "<!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">\n"
        "<!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;\">\n"
        "<!ENTITY d \"&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;\">\n"
        "<!ENTITY e \"&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;\">\n"
        "<!ENTITY f \"&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;\">\n"
        "<!ENTITY g \"&f;&f;&f;&f;&f;&f;&f;&f;&f;&f;&f;&f;\">]>\n"
        "<svg><path d=\"&g;&g;\"/></svg>";
    refuse(bomb, "amplification");
}

static void deep_groups_are_refused(void **state)
{
    (void)state;
    enum { DEPTH = 1100000 };
    char *text = mem_alloc(3 * DEPTH + 1);
    for (int i = 0; i < DEPTH; i++)
        memcpy(text + 3 * i, "<g>", 3);
    text[3 * DEPTH] = 0;
    refuse(text, "nested too deeply");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_are_drawn),
        cmocka_unit_test(hidden_parts_are_not_drawn),
        cmocka_unit_test(paths_are_filled_after_z),
        cmocka_unit_test(open_paths_are_lines),
        cmocka_unit_test(curves_have_steps),
        cmocka_unit_test(elements_are_united),
        cmocka_unit_test(transforms_nest),
        cmocka_unit_test(the_page_gives_the_scale),
        cmocka_unit_test(newer_versions_choose_parts),
        cmocka_unit_test(broken_files_are_refused),
        cmocka_unit_test(deep_groups_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
