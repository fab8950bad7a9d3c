// test_reload.c - solids from model to model, deep and wide trees, filter and options.
#include "unit.h"

#include <stdio.h>

static struct model build(const char *text, struct solid_store *store)
{
    struct messages messages = {0};
    struct model m;
    model_of_text(&m, "test.csg", text, store, &messages);
    assert_int_equal(messages.count, 0);
    messages_free(&messages);
    return m;
}

static const char ball[] = "sphere($fn = 12, r = 2);";
static const char balls[] = "sphere($fn = 12, r = 3); sphere($fn = 12, r = 4); cube(1);";
static const char mesh[] = "polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "
                           "[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);";

static void equal_shapes_are_one_solid(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct model m = build(balls, store);
    const struct leaf *leaves = m.bodies[0].leaves;
    assert_int_equal(m.bodies[0].leaf_count, 3);
    assert_ptr_equal(leaves[0].solid, leaves[1].solid);
    assert_int_equal(m.stats.solids, 2);
    model_free(&m);
    model_free(&m);
    solid_store_delete(store);
}

static void solids_survive_a_reload(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct model first = build(ball, store);
    struct model second = build(balls, store); // before the old one goes
    const struct solid *sphere = first.bodies[0].leaves[0].solid;
    assert_ptr_equal(second.bodies[0].leaves[0].solid, sphere);
    model_free(&first);
    model_free(&second);
    struct model third = build(ball, store); // after the old one went
    assert_ptr_equal(third.bodies[0].leaves[0].solid, sphere);
    assert_int_equal(third.stats.solids, 1);
    struct model fourth = build(mesh, store), fifth = build(mesh, store);
    assert_ptr_equal(fourth.bodies[0].leaves[0].solid, fifth.bodies[0].leaves[0].solid);
    solid_store_delete(store); // the models keep it
    model_free(&third);
    model_free(&fifth);
    model_free(&fourth);
}

static void filter_follows_the_extent(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct model m = build("cube([10, 20, 30]);", store);
    assert_true(fabs(model_epsilon(&m, -1) - 3e-4) < 1e-15);
    assert_true(model_epsilon(&m, 0) == 0);
    assert_true(model_epsilon(&m, 0.5) == 0.5);
    model_free(&m);
    m = build("cube([10, 2000, 30]);", store);
    assert_true(fabs(model_epsilon(&m, -1) - 4e-3) < 1e-15);
    model_free(&m);
    m = build("cube([10, 200, 30]);", store);
    assert_true(model_epsilon(&m, -1) == 1e-3);
    model_free(&m);
    m = build("cube([1e-3, 2e-3, 3e-3]);", store); // drawn in metres
    assert_true(fabs(model_epsilon(&m, -1) - 3e-8) < 1e-15);
    model_free(&m);
    m = build("", store);
    assert_true(model_epsilon(&m, -1) == 0);
    assert_int_equal(m.body_count, 1);
    assert_true(box_is_empty(m.bounds));
    model_free(&m);
    solid_store_delete(store);
}

static void options_leave_the_bounds_alone(void **state)
{
    (void)state;
    char text[] = "difference() { cube(2); cube([1, 1, 9]); translate([9, 0, 0]) cube(1); }\0";
    struct messages messages = {0};
    struct csg_tree tree;
    assert_true(csg_parse(&tree, "x.csg", text, sizeof text - 2, &messages));
    struct model_options all = MODEL_DEFAULTS, none = {.epsilon = -1};
    struct solid_store *store = solid_store_new();
    struct model with, without;
    model_build(&with, &tree, store, &all, &messages);
    model_build(&without, &tree, store, &none, &messages);
    csg_free(&tree); // the models need it no longer
    assert_true(with.bounds.max.x == 2 && without.bounds.max.x == 2 && with.bounds.max.z == 2);
    assert_int_equal(with.bodies[0].expr.leaf_node[2], EXPR_NONE);
    assert_int_not_equal(without.bodies[0].expr.leaf_node[2], EXPR_NONE);
    assert_true(with.bodies[0].roi[1].max.z == 2 && without.bodies[0].roi[1].max.z == 9);
    assert_string_equal(with.bodies[0].leaves[0].place.file, "x.csg");
    model_free(&with);
    model_free(&without);
    solid_store_delete(store);
    messages_free(&messages);
}

// `open` and `close` around `count` levels of nesting.
static char *nested(const char *open, const char *middle, const char *close, size_t count)
{
    size_t size = (strlen(open) + strlen(close)) * count + strlen(middle) + 1;
    char *text = mem_alloc(size), *at = text;
    for (size_t i = 0; i < count; i++)
        at = stpcpy(at, open);
    at = stpcpy(at, middle);
    for (size_t i = 0; i < count; i++)
        at = stpcpy(at, close);
    return text;
}

static void deep_trees_need_no_stack(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    char *text = nested("translate([1, 0, 0]) {", "cube(1);", "}", 200000);
    struct model m = build(text, store);
    assert_true(m.bodies[0].leaves[0].box.min.x == 200000);
    model_free(&m);
    free(text);
    text = nested("difference() { cube(1); ", "cube(1);", "}", 200000);
    m = build(text, store);
    assert_int_equal(m.stats.leaves, 200001);
    model_free(&m);
    free(text);
    solid_store_delete(store);
}

static void many_marked_objects_share_bodies(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    char *text = nested("%cube(1); group() {", "cube(2);", "}", 1000);
    struct model m = build(text, store);
    assert_in_range(m.body_count, 2, 100);
    assert_int_equal(m.stats.leaves, 1001);
    assert_int_equal(m.bodies[m.body_count - 1].kind, BODY_BACKGROUND);
    model_free(&m);
    free(text);
    solid_store_delete(store);
}

static void too_many_corners_are_reduced(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct messages messages = {0};
    struct model m;
    model_of_text(&m, "x.csg", "sphere($fn = 1e9); cylinder($fn = 1e9);", store, &messages);
    assert_int_equal(messages.warnings, 2);
    assert_int_equal(m.stats.leaves, 2);
    model_free(&m);
    messages_free(&messages);
    solid_store_delete(store);
}

static void imports_are_told(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct messages messages = {0};
    struct model m;
    model_of_text(&m, "here/a.csg",
                  "import(file = \"none.stl\"); import(file = \"/none.off\");"
                  "cube(1); import(file = \"none.stl\"); import(file = \"x.unknown\");",
                  store, &messages);
    assert_int_equal(m.import_count, 2);
    assert_string_equal(m.imports[0], "here/none.stl");
    assert_string_equal(m.imports[1], "/none.off");
    messages_free(&messages);
    model_free(&m);
    solid_store_delete(store);
}

static void a_cancelled_model_can_be_freed(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct messages messages = {0};
    struct csg_tree tree;
    struct model m;
    struct model_options options = MODEL_DEFAULTS;
    atomic_bool cancelled = true;
    char text[] = "difference() { cube(2); import(file = \"x.stl\"); } #cube(1);\0";
    options.cancelled = &cancelled;
    assert_true(csg_parse(&tree, "x.csg", text, sizeof text - 2, &messages));
    model_build(&m, &tree, store, &options, &messages);
    model_free(&m);
    csg_free(&tree);
    messages_free(&messages);
    solid_store_delete(store);
}

static struct model build_after(const char *text, struct solid_store *store,
                                const struct model *before)
{
    struct messages messages = {0};
    struct csg_tree tree;
    struct model m;
    struct model_options options = MODEL_DEFAULTS;
    size_t size = strlen(text);
    char *copy = mem_zalloc(size + 2);
    memcpy(copy, text, size);
    options.before = before;
    assert_true(csg_parse(&tree, "test.csg", copy, size, &messages));
    model_build(&m, &tree, store, &options, &messages);
    csg_free(&tree);
    free(copy);
    messages_free(&messages);
    return m;
}

static uint64_t value_of(const struct model *m, uint32_t leaf)
{
    const struct sharing *s = &m->bodies[0].sharing;
    return s->classes[s->class_of_leaf[leaf]].value;
}

// A reload goes on with the values and the combinations of the model before.
static void what_is_known_stays_known(void **state)
{
    (void)state;
    struct solid_store *store = solid_store_new();
    struct model m = build("difference() { cube(9); cube(3); sphere(2); } cube(1);", store);
    const struct sharing *s = &m.bodies[0].sharing;
    uint64_t whole = value_of(&m, 0), hole = value_of(&m, 1);
    for (uint32_t k = 1; k <= 2; k++) {
        struct member set[] = {{s->class_of_leaf[0], 1}, {s->class_of_leaf[1], k}};
        struct member one = set[0];
        if (set[0].class_id > set[1].class_id) {
            set[0] = set[1];
            set[1] = one;
        }
        discovery_resolve(m.bodies[0].table, whole + k * hole, set, 2);
        discovery_resolve(m.bodies[0].table, whole, &one, 1);
    }
    // Numbers change, and the lines of all.
    struct model moved =
        build_after("\n\ndifference() { cube(8); cube(2); sphere(1); } cube(1);", store, &m);
    assert_true(value_of(&moved, 0) == whole && value_of(&moved, 2) == hole);
    assert_int_equal(discovery_stats(moved.bodies[0].table).combinations, 3);
    assert_int_equal(discovery_lookup(moved.bodies[0].table, whole + 2 * hole), SET_EMPTY);
    // An object in front.
    struct model more = build_after("difference() { cube(7); sphere(3); } "
                                    "difference() { cube(8); cube(2); sphere(1); } cube(1);",
                                    store, &moved);
    assert_true(value_of(&more, 2) == whole && value_of(&more, 4) == hole);
    assert_true(value_of(&more, 0) != whole && value_of(&more, 1) != hole);
    assert_int_equal(discovery_lookup(more.bodies[0].table, whole), SET_SOLID);
    // Another operation: the same sets mean something else.
    struct model other =
        build_after("\n\nintersection() { cube(8); cube(2); sphere(1); } cube(1);", store, &moved);
    for (uint32_t k = 1; k <= 2; k++)
        assert_int_not_equal(discovery_lookup(other.bodies[0].table, whole + k * hole), SET_SOLID);
    model_free(&m);
    model_free(&moved);
    model_free(&more);
    model_free(&other);
    solid_store_delete(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_shapes_are_one_solid),
        cmocka_unit_test(solids_survive_a_reload),
        cmocka_unit_test(filter_follows_the_extent),
        cmocka_unit_test(options_leave_the_bounds_alone),
        cmocka_unit_test(deep_trees_need_no_stack),
        cmocka_unit_test(many_marked_objects_share_bodies),
        cmocka_unit_test(too_many_corners_are_reduced),
        cmocka_unit_test(imports_are_told),
        cmocka_unit_test(what_is_known_stays_known),
        cmocka_unit_test(a_cancelled_model_can_be_freed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
