// test_modes.c - what models of the modes hold, compared with what OpenSCAD shows and warns of.
#include "unit.h"

#define FAR(x) "multmatrix([[1,0,0," #x "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "

struct subject {
    struct model model;
    struct solid_store *store;
    struct messages messages;
};

static void make(struct subject *s, enum model_mode mode, const char *text)
{
    *s = (struct subject){.store = solid_store_new()};
    model_of_text_as(&s->model, mode, "m.csg", text, s->store, &s->messages);
}

static void drop(struct subject *s)
{
    model_free(&s->model);
    solid_store_delete(s->store);
    messages_free(&s->messages);
}

// ---------------------------------------------------------------- thrown together

// The leaves of the body as their x extents' lower ends, with - for subtracted and # for marked.
static void leaves_text(char *out, size_t size, const struct body *body)
{
    size_t used = 0;
    *out = 0;
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        const struct leaf *l = &body->leaves[i];
        if (body->expr.leaf_node[i] == EXPR_NONE)
            continue;
        used +=
            (size_t)snprintf(out + used, size - used, "%s%s%s%g", used ? " " : "",
                             l->subtracted ? "-" : "+", l->highlighted ? "#" : "", l->box.min.x);
        assert_true(used < size);
    }
}

static void expect_leaves(const char *text, uint32_t body, const char *expected)
{
    struct subject s;
    char found[256];
    make(&s, MODEL_THROWN_TOGETHER, text);
    assert_true(body < s.model.body_count);
    leaves_text(found, sizeof found, &s.model.bodies[body]);
    assert_string_equal(found, expected);
    if (s.model.bodies[body].expr.node_count > 1)
        assert_int_equal(s.model.bodies[body].expr.nodes[s.model.bodies[body].expr.root].op,
                         EXPR_UNION);
    drop(&s);
}

static void shapes_stand_in_their_first_role(void **state)
{
    (void)state;
    expect_leaves("difference() { cube(10); " FAR(1) "cube(2); " FAR(5) "cube(9); }", 0,
                  "+0 -1 -5");
    // x - (y - z) is (x - y) + x * z
    expect_leaves(
        "difference() { cube(10); difference() { " FAR(1) "cube(9);" FAR(2) "cube(3); } }", 0,
        "+0 -1 +2");
    // x - y * z is (x - y) + (x - z)
    expect_leaves(
        "difference() { cube(10); intersection() { " FAR(1) "cube(9);" FAR(2) "cube(3); } }", 0,
        "+0 -1 -2");
    expect_leaves("intersection() { union() { cube(3); " FAR(4) "cube(3); } " FAR(2) "cube(9); }",
                  0, "+0 +4 +2");
}

static void boxes_decide_what_takes_part(void **state)
{
    (void)state;
    expect_leaves("difference() { cube(10); " FAR(11) "cube(2); }", 0, "+0");
    expect_leaves("difference() { cube(10); " FAR(10) "cube(2); }", 0, "+0 -10"); // they touch
    // In the gap of a union: in the box of the whole, in that of no product.
    expect_leaves("difference() { union() { cube(2); " FAR(8) "cube(2); } " FAR(4) "cube(2); }", 0,
                  "+0 +8");
    // Cut by the box of what follows: (x - y) * z is x * z - y.
    expect_leaves(
        "intersection() { difference() { cube(10); " FAR(1) "cube(1); } " FAR(5) "cube(9); }", 0,
        "+0 +5");
    expect_leaves("intersection() { cube(2); " FAR(5) "cube(2); }", 0, "");
}

static void marks_stay_with_shapes(void **state)
{
    (void)state;
    expect_leaves("difference() { cube(10); #" FAR(1) "cube(2); }", 0, "+0 -#1");
    expect_leaves("#difference() { cube(10); " FAR(1) "cube(2); }", 0, "+#0 -#1");
    // Operations that are multiplied out lose theirs.
    expect_leaves("#difference() { cube(10); union() { " FAR(1) "cube(2); " FAR(7) "cube(2); } }",
                  0, "+0 -1 -7");
    expect_leaves(
        "difference() { cube(10); #difference() { " FAR(1) "cube(9);" FAR(2) "cube(3); } }", 0,
        "+0 -1 +2");
    expect_leaves("%difference() { cube(10); " FAR(1) "cube(2); }", 1, "+0 -1");
}

static void rendered_objects_are_one_shape(void **state)
{
    (void)state;
    struct subject s;
    make(&s, MODEL_THROWN_TOGETHER,
         "difference() { cube(10); render() difference() { cube(5); sphere(2); } }");
    const struct body *b = &s.model.bodies[0];
    assert_int_equal(b->leaf_count, 3);
    assert_true(b->leaves[1].subtracted && b->leaves[2].subtracted);
    const struct expr_node *part = &b->expr.nodes[b->expr.leaf_node[1]];
    assert_int_equal(b->expr.nodes[part->parent].op, EXPR_INTERSECTION);
    drop(&s);
}

// ---------------------------------------------------------------- geometry

static void expect_render(const char *text, uint32_t leaves, bool single, bool flat,
                          uint32_t warnings)
{
    struct subject s;
    make(&s, MODEL_RENDER, text);
    const struct body *b = &s.model.bodies[0];
    uint32_t count = 0;
    for (uint32_t i = 0; i < b->leaf_count; i++) {
        count += b->expr.leaf_node[i] != EXPR_NONE;
        for (int k = 0; k < 4; k++)
            assert_true(b->leaves[i].colour[k] < 0);
        assert_string_equal(b->leaves[i].place.file, "m.csg");
    }
    assert_int_equal(s.model.body_count, 1);
    assert_int_equal(count, leaves);
    assert_int_equal(s.model.single, single);
    assert_int_equal(s.model.flat != NULL, flat);
    assert_int_equal(s.messages.warnings, warnings);
    drop(&s);
}

static void geometry_has_no_colours_and_marks(void **state)
{
    (void)state;
    expect_render("color([1,0,0]) cube(1);", 1, true, false, 0);
    expect_render("%cube(5); #sphere(1);", 1, true, false, 0);
    expect_render("group() { cube(1); group(); }", 1, true, false, 0);
    expect_render("cube(1); cube(2);", 2, false, false, 0);
    expect_render("hull() { cube(1); sphere(3); } render() difference() { cube(4); sphere(1); }", 3,
                  false, false, 0);
    expect_render("", 0, false, false, 0);
    expect_render("cube(4); !sphere(1); cube(3);", 1, true, false, 0);
}

static void the_first_object_decides_the_dimension(void **state)
{
    (void)state;
    expect_render("square(3); cube(1);", 1, true, true, 1);
    expect_render("cube(1); square(3);", 1, true, false, 1);
    expect_render("%cube(1); square(3);", 1, true, true, 0);
    expect_render("square(10); group() { sphere(8); circle(2); }", 1, true, true, 2);
    expect_render("group(); intersection() { square(2); }", 1, true, true, 0);
}

#define POINTS "polyhedron([[0,0,0],[9,0,0],[0,9,0],[0,0,9]], "
#define OPEN   POINTS "[[0,1,2],[0,3,1],[1,3,2]]);"
#define MIXED  POINTS "[[0,1,2],[0,3,1],[1,3,2],[0,3,2]]);"
#define TURNED POINTS "[[0,2,1],[0,1,3],[1,2,3],[0,3,2]]);"

// Each is what openscad says and keeps.
static void meshes_that_bound_nothing_stand_alone(void **state)
{
    (void)state;
    expect_render(OPEN, 1, true, false, 0);
    expect_render(MIXED, 1, true, false, 0);
    expect_render(MIXED "group(); %cube(1); square(1);", 1, true, false, 1);
    expect_render("resize([5,5,5]) render() " OPEN, 1, true, false, 0);
    expect_render(OPEN FAR(20) "cube(1);", 1, true, false, 1);
    expect_render(OPEN MIXED, 0, false, false, 2);
    expect_render(TURNED FAR(20) "cube(1);", 2, false, false, 0);
    expect_render("difference() { cube(20); " FAR(1) MIXED "}", 1, true, false, 1);
    expect_render("difference() { " MIXED " group(); }", 0, false, false, 1);
    expect_render("intersection() { cube(20); " OPEN "}", 0, false, false, 1);
    expect_render("render() " MIXED FAR(20) "cube(1);", 1, true, false, 1);
    expect_render("minkowski() { cube(1); " MIXED "}", 0, false, false, 1);
    expect_render("hull() { " OPEN FAR(20) "cube(1); }", 1, true, false, 0);
    expect_render("hull() { union() { " OPEN FAR(20) "cube(1); } }", 1, true, false, 1);
}

// The preview evaluates render() and nothing else.
static void render_leaves_out_what_bounds_nothing(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint32_t leaves, warnings;
    } cases[] = {{MIXED "cube(1);", 2, 0},
                 {"render() { " MIXED "}", 1, 0},
                 {"render() { " MIXED "cube(1); }", 1, 1},
                 {"render() { " MIXED "%cube(1); }", 1, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct subject s;
        make(&s, MODEL_PREVIEW, cases[i].text);
        assert_int_equal(s.model.bodies[0].leaf_count, cases[i].leaves);
        assert_int_equal(s.messages.warnings, cases[i].warnings);
        drop(&s);
    }
}

static void flat_models_are_one_outline(void **state)
{
    (void)state;
    struct subject s;
    make(&s, MODEL_RENDER,
         "difference() { square(10); " FAR(2) "square(3); } " FAR(10) "square(2);");
    assert_non_null(s.model.flat);
    assert_int_equal(s.model.flat->path_count, 1); // it reaches the border at the bottom
    assert_true(fabs(outline_area(s.model.flat) - (100 - 9 + 4)) < 1e-9);
    assert_true(s.model.bounds.min.z == 0 && s.model.bounds.max.z == 0);
    assert_true(s.model.bounds.max.x == 12 && s.model.bounds.max.y == 10);
    drop(&s);
}

static void a_single_shape_may_count_as_several(void **state)
{
    (void)state;
    for (int united = 0; united < 2; united++) {
        struct model_options options = MODEL_DEFAULTS;
        struct solid_store *store = solid_store_new();
        struct messages messages = {0};
        struct csg_tree tree;
        struct model m;
        char text[] = "cube(1);\0";
        assert_true(csg_parse(&tree, "m.csg", text, strlen(text), &messages));
        options.mode = MODEL_RENDER;
        options.united = united;
        model_build(&m, &tree, store, &options, &messages);
        assert_int_equal(m.single, !united);
        model_free(&m);
        csg_free(&tree);
        solid_store_delete(store);
    }
}

// One store serves models of all modes: none takes over what is another's.
static void modes_share_a_store(void **state)
{
    (void)state;
    static const char text[] = "difference() { linear_extrude(2) square(5); polyhedron(points = "
                               "[[0,0,0],[9,0,0],[0,9,0],[0,0,9]], faces = [[0,1,2],[0,1,3],"
                               "[1,2,3],[2,0,3]]); } offset(1) square(3);";
    static const enum model_mode modes[] = {MODEL_PREVIEW, MODEL_RENDER, MODEL_THROWN_TOGETHER,
                                            MODEL_PREVIEW};
    struct solid_store *store = solid_store_new();
    struct model models[4];
    uint32_t leaves[4];
    for (int i = 0; i < 4; i++) {
        struct messages messages = {0};
        model_of_text_as(&models[i], modes[i], "m.csg", text, store, &messages);
        leaves[i] = models[i].bodies[0].leaf_count;
        messages_free(&messages);
    }
    assert_int_equal(leaves[0], 3);
    assert_int_equal(leaves[1], 1); // left out: the polyhedron, partly inside out, the flat one
    assert_int_equal(leaves[2], 3);
    assert_int_equal(leaves[3], 3);
    assert_true(models[0].bodies[0].leaves[0].solid == models[1].bodies[0].leaves[0].solid);
    for (int i = 0; i < 4; i++)
        model_free(&models[i]);
    solid_store_delete(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_stand_in_their_first_role),
        cmocka_unit_test(boxes_decide_what_takes_part),
        cmocka_unit_test(marks_stay_with_shapes),
        cmocka_unit_test(rendered_objects_are_one_shape),
        cmocka_unit_test(geometry_has_no_colours_and_marks),
        cmocka_unit_test(the_first_object_decides_the_dimension),
        cmocka_unit_test(meshes_that_bound_nothing_stand_alone),
        cmocka_unit_test(render_leaves_out_what_bounds_nothing),
        cmocka_unit_test(flat_models_are_one_outline),
        cmocka_unit_test(a_single_shape_may_count_as_several),
        cmocka_unit_test(modes_share_a_store),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
