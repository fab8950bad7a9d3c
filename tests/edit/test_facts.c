// test_facts.c - what is told of the nodes of a file.
#include "edit/facts.h"
#include "unit.h"

#include "render/camera.h"
#include "render/cost.h"

#include <math.h>

struct scene {
    struct edit *e;
    const struct source *s;
    struct solid_store *store;
    struct model model;
    struct facts facts;
};

static void make(struct scene *c, const char *text)
{
    struct messages messages = {0};
    struct csg_tree tree;
    *c = (struct scene){.e = edit_of_text(text), .store = solid_store_new()};
    c->s = edit_source(c->e);
    edit_tree(c->e, &tree);
    model_build(&c->model, &tree, c->store, &MODEL_DEFAULTS, &messages);
    csg_free(&tree);
    facts_make(&c->facts, c->s, &c->model);
    messages_free(&messages);
}

static void release(struct scene *c)
{
    facts_free(&c->facts);
    facts_free(&c->facts);
    model_free(&c->model);
    solid_store_delete(c->store);
    edit_delete(c->e);
}

// 0 difference, 1 color, 2 cube, 3 group, 4 sphere, 5 multmatrix, 6 cylinder, 7 hull, 8 cube, 9
// cube
static const char part[] =
    "difference() {\n"
    "  color([1, 0, 0, 1]) cube(size = [9, 9, 9], center = true);\n"
    "  group() { sphere(r = 5, $fn = 8);\n"
    "    multmatrix([[1, 0, 0, 4], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])"
    " cylinder(h = 20, r = 1, center = true); }\n"
    "}\n"
    "hull() { cube(1); cube([2, 1, 1]); }\n";

static void leaves_belong_to_nodes(void **state)
{
    (void)state;
    struct scene c;
    make(&c, part);
    const uint32_t leaves[] = {3, 1, 1, 2, 1, 1, 1, 1, 0, 0};
    assert_int_equal(c.facts.node_count, array_count(leaves));
    for (uint32_t i = 0; i < array_count(leaves); i++)
        assert_int_equal(c.facts.nodes[i].leaves, leaves[i]);
    const uint32_t nodes[] = {2, 4, 6, 7};
    assert_int_equal(c.model.bodies[0].leaf_count, array_count(nodes));
    for (uint32_t i = 0; i < array_count(nodes); i++)
        assert_int_equal(c.facts.node_of_leaf[0][i], nodes[i]);
    assert_true(c.facts.nodes[1].colour[0] == 1 && c.facts.nodes[1].colour[1] == 0);
    assert_true(c.facts.nodes[0].several && c.facts.nodes[0].colour[0] < 0);
    assert_true(!c.facts.nodes[3].several && c.facts.nodes[3].colour[0] < 0);
    release(&c);
}

static void faces_know_what_cut_them(void **state)
{
    (void)state;
    struct scene c;
    struct cut cut;
    make(&c, part);
    assert_true(facts_cut(c.e, 6, &cut));
    assert_int_equal(cut.difference, 0);
    assert_int_equal(cut.tool, 3);
    assert_int_equal(cut.target, 1);
    assert_false(facts_cut(c.e, 2, &cut));
    assert_false(facts_cut(c.e, 7, &cut));
    edit_mark(c.e, 1, CSG_DISABLE); // then the group is what is cut
    assert_false(facts_cut(c.e, 6, &cut));
    struct error err;
    assert_true(edit_set_operation(c.e, 3, "difference", &err));
    assert_true(facts_cut(c.e, 6, &cut));
    assert_int_equal(cut.difference, 3);
    assert_int_equal(cut.tool, 5);
    assert_int_equal(cut.target, 4);
    release(&c);
}

static struct rays view(int size)
{
    struct camera camera = CAMERA_DEFAULTS;
    return camera_rays(&camera, size, size, (struct box){{-10, -10, -10}, {10, 10, 10}});
}

static void drop(void *context, uint32_t worker, const struct span_block *block)
{
    (void)context;
    (void)worker;
    (void)block;
}

static void nodes_have_costs(void **state)
{
    (void)state;
    struct scene c;
    make(&c, part);
    const struct body *body = &c.model.bodies[0];
    struct rays rays = view(100);
    struct render_settings settings = {.epsilon = 1e-4, .threads = 2};
    struct render_stats stats;
    uint64_t crossings[4] = {0}, again[4] = {0}, sum = 0;
    cost_count(body, &rays, &settings, crossings);
    settings.threads = 1;
    settings.memory = 1 << 16;
    cost_count(body, &rays, &settings, again);
    assert_memory_equal(crossings, again, sizeof crossings);
    struct device *d = cpu_device_new();
    device_spans(d, body, &rays, &settings, drop, NULL, &stats);
    device_delete(d);
    for (int i = 0; i < 4; i++) {
        assert_true(crossings[i] > 0 && crossings[i] % 2 == 0);
        sum += crossings[i];
    }
    assert_int_equal(sum, stats.fragments);
    facts_add_crossings(&c.facts, c.s, 0, crossings, 4);
    const struct node_facts *n = c.facts.nodes;
    assert_int_equal(n[4].crossings, crossings[1]);
    assert_int_equal(n[3].crossings, crossings[1] + crossings[2]);
    assert_int_equal(n[0].crossings + n[7].crossings, sum);
    facts_clear_crossings(&c.facts);
    assert_int_equal(n[0].crossings, 0);

    // Known are now: the cube alone, with one of the holes, with both, the small hull in the middle
    // with what is around it there. A hole alone is empty for what it is, yet it was met.
    facts_count_combinations(&c.facts, c.s, &c.model);
    struct discovery_stats known = discovery_stats(body->table);
    assert_true(known.combinations >= 5);
    assert_true(n[0].combinations <= known.combinations);
    assert_true(n[0].combinations >= n[1].combinations && n[1].combinations >= 3);
    assert_int_equal(n[1].combinations, n[2].combinations);
    assert_int_equal(n[4].combinations, n[6].combinations); // one class: both cut
    assert_true(n[7].combinations > 0 && n[8].combinations == 0);
    release(&c);
}

static void holes_are_found(void **state)
{
    (void)state;
    struct scene c;
    make(&c, "polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "
             "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);"
             "group() { multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
             "polyhedron(points = [[0,0,0],[3,0,0],[0,3,0],[0,0,3]], "
             "faces = [[0,3,1],[0,2,3],[1,3,2]]); }");
    facts_find_holes(&c.facts, c.s, &c.model);
    assert_int_equal(c.facts.hole_count, 1);
    assert_int_equal(c.facts.holes[0].node, 3);
    struct vec3 p = c.facts.holes[0].middle;
    assert_true(fabs(p.x - 11) < 1e-9 && fabs(p.y - 1) < 1e-9 && fabs(p.z) < 1e-9);
    const bool open[] = {false, true, true, true};
    for (int i = 0; i < 4; i++)
        assert_int_equal(c.facts.nodes[i].open, open[i]);
    release(&c);
}

static void nodes_are_told_in_a_line(void **state)
{
    (void)state;
    struct error err;
    char line[100], short_line[12];
    struct edit *e =
        edit_of_text("cube ( size=[1,2.50,3],center=true ) ; $fn = 8;"
                     "polyhedron([[0, [1, 2]], [3]], \"\xC3\xA4\xC3\xA4\xC3\xA4\", undef);"
                     "x([1 : 2], [[4, 5], [6, 7]]);");
    facts_line(e, 0, line, sizeof line);
    assert_string_equal(line, "cube(size = [1, 2.5, 3], center = true)");
    assert_true(edit_set_number(e, 0, 0, 1, -7, &err));
    facts_line(e, 0, line, sizeof line);
    assert_string_equal(line, "cube(size = [1, -7, 3], center = true)");
    facts_line(e, 1, line, sizeof line);
    assert_string_equal(line, "$fn = 8");
    facts_line(e, 2, line, sizeof line);
    assert_string_equal(line,
                        "polyhedron([[0, [1, 2]], [3]], \"\xC3\xA4\xC3\xA4\xC3\xA4\", undef)");
    facts_line(e, 3, line, sizeof line);
    assert_string_equal(line, "x([...:...], [[4, 5], [6, 7]])");
    facts_line(e, 0, short_line, sizeof short_line);
    assert_string_equal(short_line, "cube(siz...");
    for (size_t size = 0; size < 40; size++) {
        memset(line, 'x', sizeof line);
        facts_line(e, 2, line, size);
        assert_true(size == 0 || strlen(line) < size);
        assert_true(line[size] == 'x');
    }
    facts_label(e, 0, 0, 2, line, sizeof line);
    assert_string_equal(line, "size[2]");
    facts_label(e, 0, 1, 0, line, sizeof line);
    assert_string_equal(line, "center");
    facts_label(e, 3, 1, 2, line, sizeof line);
    assert_string_equal(line, "[1][0]");
    facts_label(e, 2, 0, 2, line, sizeof line);
    assert_string_equal(line, "[0][1][1]");
    edit_delete(e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaves_belong_to_nodes),   cmocka_unit_test(faces_know_what_cut_them),
        cmocka_unit_test(nodes_have_costs),         cmocka_unit_test(holes_are_found),
        cmocka_unit_test(nodes_are_told_in_a_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
