// test_share.c - which leaves share a value.
#include "hcsg/share.h"
#include "unit.h"

struct given {
    struct expr e;
    struct sharing s;
};

static struct given build(const struct expr_token *tokens, size_t count, uint32_t leaves,
                          const bool *convex, bool share)
{
    struct given g;
    expr_build(&g.e, tokens, count, leaves);
    sharing_build(&g.s, &g.e, convex, share);
    return g;
}

static void release(struct given *g)
{
    expr_free(&g->e);
    sharing_free(&g->s);
}

static const struct value_class *class_of(const struct given *g, uint32_t leaf)
{
    return &g->s.classes[g->s.class_of_leaf[leaf]];
}

static const bool all_convex[8] = {true, true, true, true, true, true, true, true};
static const bool none_convex[8] = {false};

static void check_lone(const struct given *g, uint32_t leaf)
{
    assert_int_equal(class_of(g, leaf)->rule, CLASS_ANY);
    assert_int_equal(class_of(g, leaf)->members, 1);
    assert_int_equal(class_of(g, leaf)->node, g->e.leaf_node[leaf]);
}

static void union_leaves_share(void **state)
{
    (void)state;
    // (0 | 1 | (2 - 3))
    const struct expr_token t[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1},       {EXPR_LEAF, 2},
                                   {EXPR_LEAF, 3}, {EXPR_DIFFERENCE, 2}, {EXPR_UNION, 3}};
    struct given g = build(t, array_count(t), 4, none_convex, true);
    assert_int_equal(g.s.class_count, 3);
    assert_int_equal(g.s.class_of_leaf[0], g.s.class_of_leaf[1]);
    assert_int_equal(class_of(&g, 0)->rule, CLASS_ANY);
    assert_int_equal(class_of(&g, 0)->members, 2);
    assert_int_equal(class_of(&g, 0)->node, g.e.root);
    check_lone(&g, 2);
    check_lone(&g, 3);
    release(&g);
}

static void subtracted_leaves_share(void **state)
{
    (void)state;
    const struct expr_token t[] = {
        {EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_LEAF, 2}, {EXPR_DIFFERENCE, 3}};
    struct given g = build(t, array_count(t), 3, all_convex, true);
    assert_int_equal(g.s.class_count, 2);
    check_lone(&g, 0);
    assert_int_equal(g.s.class_of_leaf[1], g.s.class_of_leaf[2]);
    assert_int_equal(class_of(&g, 1)->rule, CLASS_ANY);
    release(&g);
}

static void convex_leaves_of_an_intersection_share(void **state)
{
    (void)state;
    // 0 * 1 * 2 * 3 - 4, 1 being of any shape
    const struct expr_token t[] = {{EXPR_LEAF, 0},      {EXPR_LEAF, 1},         {EXPR_LEAF, 2},
                                   {EXPR_LEAF, 3},      {EXPR_INTERSECTION, 4}, {EXPR_LEAF, 4},
                                   {EXPR_DIFFERENCE, 2}};
    const bool convex[] = {true, false, true, true, true};
    struct given g = build(t, array_count(t), 5, convex, true);
    assert_int_equal(g.s.class_count, 3);
    assert_int_equal(class_of(&g, 0)->rule, CLASS_ALL);
    assert_int_equal(class_of(&g, 0)->members, 3);
    assert_int_equal(class_of(&g, 0)->node, g.e.root);
    assert_int_equal(g.s.class_of_leaf[2], g.s.class_of_leaf[0]);
    assert_int_equal(g.s.class_of_leaf[3], g.s.class_of_leaf[0]);
    check_lone(&g, 1);
    check_lone(&g, 4);
    release(&g);
}

static void one_convex_leaf_is_alone(void **state)
{
    (void)state;
    const struct expr_token t[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_INTERSECTION, 2}};
    const bool convex[] = {true, false};
    struct given g = build(t, array_count(t), 2, convex, true);
    assert_int_equal(g.s.class_count, 2);
    check_lone(&g, 0);
    check_lone(&g, 1);
    release(&g);
}

static void no_sharing_when_not_asked(void **state)
{
    (void)state;
    const struct expr_token t[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_LEAF, 2}, {EXPR_UNION, 3}};
    struct given g = build(t, array_count(t), 3, all_convex, false);
    assert_int_equal(g.s.class_count, 3);
    for (uint32_t l = 0; l < 3; l++)
        check_lone(&g, l);
    release(&g);
}

static void dropped_leaves_have_no_class(void **state)
{
    (void)state;
    const struct expr_token t[] = {
        {EXPR_LEAF, 0}, {EXPR_UNION, 0}, {EXPR_LEAF, 1}, {EXPR_DIFFERENCE, 2}, {EXPR_UNION, 2}};
    struct given g = build(t, array_count(t), 2, all_convex, true);
    assert_int_equal(g.s.class_count, 1);
    assert_int_equal(g.s.class_of_leaf[1], EXPR_NONE);
    check_lone(&g, 0);
    release(&g);
}

// Each leaf is in one class, sizes are right, classes are in the order of their nodes.
static void random_trees_are_consistent(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int round = 0; round < 500; round++) {
        enum { N = 60 };
        struct postfix p = postfix_random(&random, N);
        bool convex[N];
        for (uint32_t l = 0; l < N; l++)
            convex[l] = random_below(&random, 2);
        struct given g = build(p.tokens, p.count, N, convex, true);
        uint32_t members[N] = {0};
        for (uint32_t l = 0; l < N; l++) {
            assert_int_equal(g.e.leaf_node[l] == EXPR_NONE, g.s.class_of_leaf[l] == EXPR_NONE);
            if (g.s.class_of_leaf[l] == EXPR_NONE)
                continue;
            members[g.s.class_of_leaf[l]]++;
            if (class_of(&g, l)->rule == CLASS_ALL)
                assert_true(convex[l]);
        }
        for (uint32_t c = 0; c < g.s.class_count; c++) {
            assert_int_equal(g.s.classes[c].members, members[c]);
            assert_true(members[c] > 0);
            assert_true(c == 0 || g.s.classes[c - 1].node < g.s.classes[c].node);
        }
        release(&g);
        free(p.tokens);
    }
}

static void expression_over_classes(void **state)
{
    (void)state;
    // (0 | 1 | (2 * 3 - (4 | 5))) with convex leaves: three classes in four nodes and the root.
    const struct expr_token t[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1},         {EXPR_LEAF, 2},
                                   {EXPR_LEAF, 3}, {EXPR_INTERSECTION, 2}, {EXPR_LEAF, 4},
                                   {EXPR_LEAF, 5}, {EXPR_UNION, 2},        {EXPR_DIFFERENCE, 2},
                                   {EXPR_UNION, 3}};
    struct given g = build(t, array_count(t), 6, all_convex, true);
    struct expr e;
    sharing_expr(&e, &g.e, &g.s);
    assert_int_equal(g.s.class_count, 3);
    assert_int_equal(e.leaf_count, 3);
    assert_int_equal(e.node_count, 5);
    const struct expr_node *root = &e.nodes[e.root];
    assert_int_equal(root->op, EXPR_UNION);
    assert_int_equal(root->count, 2);
    const struct expr_node *any = &e.nodes[e.kids[root->first]];
    const struct expr_node *part = &e.nodes[e.kids[root->first + 1]];
    assert_int_equal(any->leaf, g.s.class_of_leaf[0]);
    assert_int_equal(part->op, EXPR_INTERSECTION);
    assert_int_equal(part->count, 1);
    assert_int_equal(e.nodes[e.kids[part->first]].leaf, g.s.class_of_leaf[3]);
    assert_int_equal(e.nodes[part->minus].leaf, g.s.class_of_leaf[5]);
    expr_free(&e);
    release(&g);

    // Nothing shared: the same expression, but for the numbers.
    g = build(t, array_count(t), 6, all_convex, false);
    sharing_expr(&e, &g.e, &g.s);
    assert_int_equal(e.node_count, g.e.node_count);
    for (uint32_t i = 0; i < e.node_count; i++) {
        assert_int_equal(e.nodes[i].op, g.e.nodes[i].op);
        if (e.nodes[i].op == EXPR_LEAF)
            assert_int_equal(e.nodes[i].leaf, g.s.class_of_leaf[g.e.nodes[i].leaf]);
    }
    expr_free(&e);
    release(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(union_leaves_share),
        cmocka_unit_test(subtracted_leaves_share),
        cmocka_unit_test(convex_leaves_of_an_intersection_share),
        cmocka_unit_test(one_convex_leaf_is_alone),
        cmocka_unit_test(no_sharing_when_not_asked),
        cmocka_unit_test(dropped_leaves_have_no_class),
        cmocka_unit_test(random_trees_are_consistent),
        cmocka_unit_test(expression_over_classes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
