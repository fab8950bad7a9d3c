// test_evaluate.c - sparse evaluation against plain evaluation.
#include "hcsg/evaluate.h"
#include "unit.h"

// The members of the combination in which the leaf l is around the point counts[l] times.
static uint32_t members_of(const struct sharing *s, uint32_t leaves, const uint32_t *counts,
                           struct member *set)
{
    uint32_t n = 0;
    uint32_t *per_class = mem_zalloc(s->class_count * sizeof *per_class);
    for (uint32_t l = 0; l < leaves; l++)
        if (s->class_of_leaf[l] != EXPR_NONE)
            per_class[s->class_of_leaf[l]] += counts[l];
    for (uint32_t c = 0; c < s->class_count; c++)
        if (per_class[c])
            set[n++] = (struct member){c, per_class[c]};
    free(per_class);
    return n;
}

static void check_random_tree(uint64_t *random, uint32_t leaves, bool share, int samples)
{
    struct postfix p = postfix_random(random, leaves);
    bool *convex = mem_alloc(leaves), *inside = mem_alloc(leaves);
    uint32_t *counts = mem_alloc(leaves * sizeof *counts);
    struct member *set = mem_alloc(leaves * sizeof *set);
    for (uint32_t l = 0; l < leaves; l++)
        convex[l] = random_below(random, 3) > 0;
    struct expr e;
    struct sharing s;
    expr_build(&e, p.tokens, p.count, leaves);
    sharing_build(&s, &e, convex, share);
    for (int i = 0; i < samples; i++) {
        uint32_t rate = 1 + random_below(random, 8);
        for (uint32_t l = 0; l < leaves; l++) {
            inside[l] = random_below(random, 9) < rate;
            counts[l] = inside[l] ? 1 + (convex[l] ? 0 : random_below(random, 3)) : 0;
        }
        uint32_t n = members_of(&s, leaves, counts, set);
        assert_int_equal(evaluate_set(&e, &s, set, n), postfix_evaluate(&p, inside));
    }
    sharing_free(&s);
    expr_free(&e);
    free(convex);
    free(inside);
    free(counts);
    free(set);
    free(p.tokens);
}

static void random_trees_agree(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int round = 0; round < 6000; round++)
        check_random_tree(&random, 1 + random_below(&random, 40), round % 4 > 0, 20);
    for (int round = 0; round < 20; round++)
        check_random_tree(&random, 1000, round % 2, 20);
}

static void ten_thousand_leaves_agree(void **state)
{
    (void)state;
    uint64_t random = 8;
    for (int round = 0; round < 4; round++)
        check_random_tree(&random, 10000, round % 2, 10);
}

// a0 - (a1 - (a2 - ...)): solid when the number of leaves from a0 without a gap is odd.
static void chain_of_ten_thousand_agrees(void **state)
{
    (void)state;
    enum { N = 10000 };
    struct postfix p = {0};
    for (uint32_t i = 0; i < N; i++)
        postfix_push(&p, EXPR_LEAF, i);
    for (uint32_t i = 1; i < N; i++)
        postfix_push(&p, EXPR_DIFFERENCE, 2);
    struct expr e;
    struct sharing s;
    bool *convex = mem_zalloc(N);
    uint32_t *counts = mem_alloc(N * sizeof *counts);
    struct member *set = mem_alloc(N * sizeof *set);
    expr_build(&e, p.tokens, p.count, N);
    sharing_build(&s, &e, convex, true);
    for (uint32_t gap = 0; gap <= N; gap += 1 + gap / 7) {
        for (uint32_t i = 0; i < N; i++)
            counts[i] = i != gap;
        uint32_t n = members_of(&s, N, counts, set);
        assert_int_equal(evaluate_set(&e, &s, set, n), gap % 2);
    }
    sharing_free(&s);
    expr_free(&e);
    free(convex);
    free(counts);
    free(set);
    free(p.tokens);
}

static void empty_set_is_empty(void **state)
{
    (void)state;
    struct expr_token leaf = {EXPR_LEAF, 0};
    struct expr e, nothing;
    struct sharing s, none;
    bool convex = true;
    expr_build(&e, &leaf, 1, 1);
    sharing_build(&s, &e, &convex, true);
    expr_build(&nothing, NULL, 0, 0);
    sharing_build(&none, &nothing, NULL, true);
    assert_false(evaluate_set(&e, &s, NULL, 0));
    assert_false(evaluate_set(&nothing, &none, NULL, 0));
    assert_true(evaluate_set(&e, &s, &(struct member){0, 1}, 1));
    sharing_free(&s);
    sharing_free(&none);
    expr_free(&e);
    expr_free(&nothing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_trees_agree),
        cmocka_unit_test(ten_thousand_leaves_agree),
        cmocka_unit_test(chain_of_ten_thousand_agrees),
        cmocka_unit_test(empty_set_is_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
