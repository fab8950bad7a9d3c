// test_roi.c - regions of interest.
#include "hcsg/roi.h"
#include "unit.h"

#define MAX_LEAVES 40

static struct box cube(double x0, double x1)
{
    return (struct box){{x0, x0, x0}, {x1, x1, x1}};
}

static struct box slab(double x0, double x1)
{
    return (struct box){{x0, 0, 0}, {x1, 1, 1}};
}

static void check_box(struct box a, struct box b)
{
    if (box_is_empty(b)) {
        assert_true(box_is_empty(a));
        return;
    }
    assert_memory_equal(&a, &b, sizeof a);
}

static void check_regions(const struct expr_token *tokens, size_t count, const struct box *boxes,
                          const struct box *expected, uint32_t leaves)
{
    struct expr e;
    struct box roi[MAX_LEAVES];
    expr_build(&e, tokens, count, leaves);
    roi_build(roi, &e, boxes);
    for (uint32_t l = 0; l < leaves; l++)
        check_box(roi[l], expected[l]);
    expr_free(&e);
}

static void subtrahend_matters_in_the_minuend(void **state)
{
    (void)state;
    const struct expr_token t[] = {
        {EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_LEAF, 2}, {EXPR_DIFFERENCE, 3}};
    const struct box boxes[] = {cube(0, 4), cube(3, 9), cube(5, 6)};
    const struct box expected[] = {cube(0, 4), cube(3, 4), BOX_EMPTY};
    check_regions(t, array_count(t), boxes, expected, 3);
}

static void operands_matter_in_the_overlap(void **state)
{
    (void)state;
    const struct expr_token t[] = {
        {EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_LEAF, 2}, {EXPR_INTERSECTION, 3}};
    const struct box boxes[] = {cube(0, 4), cube(2, 9), cube(1, 3)};
    const struct box expected[] = {cube(2, 3), cube(2, 3), cube(2, 3)};
    check_regions(t, array_count(t), boxes, expected, 3);
    const struct box apart[] = {cube(0, 1), cube(2, 3), cube(0, 3)};
    const struct box none[] = {BOX_EMPTY, BOX_EMPTY, BOX_EMPTY};
    check_regions(t, array_count(t), apart, none, 3);
}

static void union_cuts_nothing(void **state)
{
    (void)state;
    const struct expr_token t[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_UNION, 2}};
    const struct box boxes[] = {cube(0, 4), cube(8, 9)};
    check_regions(t, array_count(t), boxes, boxes, 2);
}

// 0 - (1 - 2): 2 matters where both others are.
static void nested_subtrahend(void **state)
{
    (void)state;
    const struct expr_token t[] = {
        {EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_LEAF, 2}, {EXPR_DIFFERENCE, 2}, {EXPR_DIFFERENCE, 2}};
    const struct box boxes[] = {cube(0, 4), cube(3, 6), cube(0, 9)};
    const struct box expected[] = {cube(0, 4), cube(3, 4), cube(3, 4)};
    check_regions(t, array_count(t), boxes, expected, 3);
}

// (0 | 1) * (2 | 3): 1 is cut away by the hull of 2 and 3, after which 3 cannot matter either.
static void second_round_cuts_more(void **state)
{
    (void)state;
    const struct expr_token t[] = {{EXPR_LEAF, 0},        {EXPR_LEAF, 1}, {EXPR_UNION, 2},
                                   {EXPR_LEAF, 2},        {EXPR_LEAF, 3}, {EXPR_UNION, 2},
                                   {EXPR_INTERSECTION, 2}};
    const struct box boxes[] = {slab(0, 3), slab(10, 12), slab(1, 2), slab(5, 6)};
    const struct box expected[] = {slab(1, 2), BOX_EMPTY, slab(1, 2), BOX_EMPTY};
    check_regions(t, array_count(t), boxes, expected, 4);
}

static void leaves_without_a_place(void **state)
{
    (void)state;
    // The second difference is dropped with its leaf; leaf 0 has an empty box.
    const struct expr_token t[] = {
        {EXPR_LEAF, 0}, {EXPR_UNION, 0}, {EXPR_LEAF, 1}, {EXPR_DIFFERENCE, 2}, {EXPR_UNION, 2}};
    const struct box boxes[] = {BOX_EMPTY, cube(0, 1)};
    const struct box expected[] = {BOX_EMPTY, BOX_EMPTY};
    check_regions(t, array_count(t), boxes, expected, 2);
    check_regions(NULL, 0, boxes, expected, 2);
}

static bool box_holds(struct box b, struct vec3 p)
{
    return b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y && b.min.z <= p.z &&
           p.z <= b.max.z;
}

static double some(uint64_t *random) // a multiple of 1/2, so that boxes touch
{
    return 0.5 * random_below(random, 12);
}

static struct box random_box(uint64_t *random)
{
    struct vec3 a = {some(random), some(random), some(random)};
    struct vec3 size = {some(random) + 1, some(random) + 1, some(random) + 1};
    return (struct box){a, vec3_add(a, size)};
}

// Leaves that are their boxes, and leaves that are only a part of them (the half of an even
// `part`).
static void cut_leaves_give_the_same_result(void **state)
{
    (void)state;
    uint64_t random = 4;
    uint32_t cut = 0, samples_solid = 0;
    for (int round = 0; round < 3000; round++) {
        uint32_t leaves = 1 + random_below(&random, MAX_LEAVES);
        struct postfix p = postfix_random(&random, leaves);
        struct box boxes[MAX_LEAVES], roi[MAX_LEAVES];
        for (uint32_t l = 0; l < leaves; l++)
            boxes[l] = random_box(&random);
        struct expr e;
        expr_build(&e, p.tokens, p.count, leaves);
        roi_build(roi, &e, boxes);
        for (uint32_t l = 0; l < leaves; l++)
            cut += memcmp(&roi[l], &boxes[l], sizeof roi[l]) != 0;
        for (int sample = 0; sample < 60; sample++) {
            struct vec3 at = {0.25 * random_below(&random, 50), 0.25 * random_below(&random, 50),
                              0.25 * random_below(&random, 50)};
            bool full[MAX_LEAVES], part[MAX_LEAVES];
            for (uint32_t l = 0; l < leaves; l++) {
                bool there = sample % 2 || random_below(&random, 2);
                full[l] = there && box_holds(boxes[l], at);
                part[l] = full[l] && box_holds(roi[l], at);
            }
            bool solid = postfix_evaluate(&p, full);
            samples_solid += solid;
            assert_int_equal(solid, expr_evaluate(&e, part));
        }
        expr_free(&e);
        free(p.tokens);
    }
    assert_true(cut > 1000 && samples_solid > 1000);
}

// a0 - (a1 - (a2 - ...)) and ((a0 | a1) * a2 | a3) * a4 ...
static void deep_chains(void **state)
{
    (void)state;
    enum { N = 300000 };
    for (int kind = 0; kind < 2; kind++) {
        struct postfix p = {0};
        for (uint32_t i = 0; i < N; i++) {
            postfix_push(&p, EXPR_LEAF, i);
            if (kind == 1 && i > 0)
                postfix_push(&p, i % 2 ? EXPR_UNION : EXPR_INTERSECTION, 2);
        }
        for (uint32_t i = 1; i < N && kind == 0; i++)
            postfix_push(&p, EXPR_DIFFERENCE, 2);
        struct box *boxes = mem_alloc(N * sizeof *boxes), *roi = mem_alloc(N * sizeof *roi);
        for (uint32_t i = 0; i < N; i++)
            boxes[i] = cube(i * 1e-5, 10);
        struct expr e;
        expr_build(&e, p.tokens, p.count, N);
        roi_build(roi, &e, boxes);
        // In a chain of differences a leaf matters where all before it are.
        assert_true(kind == 1 || roi[N - 1].min.x == boxes[N - 1].min.x);
        expr_free(&e);
        free(p.tokens);
        free(boxes);
        free(roi);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(subtrahend_matters_in_the_minuend),
        cmocka_unit_test(operands_matter_in_the_overlap),
        cmocka_unit_test(union_cuts_nothing),
        cmocka_unit_test(nested_subtrahend),
        cmocka_unit_test(second_round_cuts_more),
        cmocka_unit_test(leaves_without_a_place),
        cmocka_unit_test(cut_leaves_give_the_same_result),
        cmocka_unit_test(deep_chains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
