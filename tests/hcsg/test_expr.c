// test_expr.c - normal form of expressions.
#include "unit.h"

#include <stdio.h>

// Reads "a b - c * 0 |2" into postfix: letters are leaves, 0 is the empty set, |n *n -n operators
// with n operands (2 when no digit follows).
static struct postfix postfix_read(const char *text)
{
    struct postfix p = {0};
    for (const char *s = text; *s; s++) {
        if (*s == ' ')
            continue;
        if (*s >= 'a' && *s <= 'z') {
            postfix_push(&p, EXPR_LEAF, (uint32_t)(*s - 'a'));
            continue;
        }
        if (*s == '0') {
            postfix_push(&p, EXPR_UNION, 0);
            continue;
        }
        enum expr_op op = *s == '|' ? EXPR_UNION : *s == '*' ? EXPR_INTERSECTION : EXPR_DIFFERENCE;
        uint32_t operands = 2;
        if (s[1] >= '0' && s[1] <= '9')
            operands = (uint32_t)(*++s - '0');
        postfix_push(&p, op, operands);
    }
    return p;
}

// "(a|b)", "(a*b-c)".
static void print_node(const struct expr *e, uint32_t i, char *out)
{
    const struct expr_node *n = &e->nodes[i];
    if (n->op == EXPR_LEAF) {
        sprintf(out + strlen(out), "%c", (char)('a' + n->leaf));
        return;
    }
    strcat(out, "(");
    for (uint32_t k = 0; k < n->count; k++) {
        if (k)
            strcat(out, n->op == EXPR_UNION ? "|" : "*");
        print_node(e, e->kids[n->first + k], out);
    }
    if (n->minus != EXPR_NONE) {
        strcat(out, "-");
        print_node(e, n->minus, out);
    }
    strcat(out, ")");
}

static void check_invariants(const struct expr *e)
{
    if (e->root == EXPR_NONE) {
        assert_int_equal(e->node_count, 0);
        return;
    }
    assert_int_equal(e->root, e->node_count - 1);
    assert_int_equal(e->nodes[e->root].parent, EXPR_NONE);
    uint32_t *begin = mem_alloc(e->node_count * sizeof *begin); // of each subtree
    uint32_t leaves = 0;
    for (uint32_t i = 0; i < e->node_count; i++) {
        const struct expr_node *n = &e->nodes[i];
        begin[i] = i;
        if (n->op == EXPR_LEAF) {
            assert_int_equal(e->leaf_node[n->leaf], i);
            leaves++;
            continue;
        }
        bool inter = n->op == EXPR_INTERSECTION;
        if (!inter)
            assert_int_equal(n->op, EXPR_UNION);
        assert_true(n->count >= 2 || (inter && n->count == 1 && n->minus != EXPR_NONE));
        assert_true(inter || n->minus == EXPR_NONE);
        uint32_t end = EXPR_NONE; // one past the subtree before
        for (uint32_t k = 0; k <= n->count; k++) {
            uint32_t kid = k < n->count ? e->kids[n->first + k] : n->minus;
            if (kid == EXPR_NONE)
                continue;
            assert_true(kid < i);
            assert_int_equal(e->nodes[kid].parent, i);
            if (k < n->count)
                assert_int_not_equal(e->nodes[kid].op, n->op);
            if (end == EXPR_NONE)
                begin[i] = begin[kid];
            else
                assert_int_equal(begin[kid], end);
            end = kid + 1;
        }
        assert_int_equal(end, i);
    }
    uint32_t known = 0;
    for (uint32_t l = 0; l < e->leaf_count; l++)
        known += e->leaf_node[l] != EXPR_NONE;
    assert_int_equal(known, leaves);
    free(begin);
}

static void normal_form_of_small_cases(void **state)
{
    (void)state;
    static const struct {
        const char *given, *expected;
    } cases[] = {
        {"", "0"},
        {"0", "0"},
        {"a", "a"},
        {"a |1", "a"},
        {"a *1", "a"},
        {"a -1", "a"},
        {"*0", "0"},
        {"-0", "0"},
        {"a b |", "(a|b)"},
        {"a b | c |", "(a|b|c)"},
        {"a b c | |", "(a|b|c)"},
        {"a b c d e |5", "(a|b|c|d|e)"},
        {"a b * c *", "(a*b*c)"},
        {"a b c * *", "(a*b*c)"},
        {"a b -", "(a-b)"},
        {"a b c -3", "(a-(b|c))"},
        {"a b - c -", "(a-(b|c))"},
        {"a b c | -", "(a-(b|c))"},
        {"a b c | d -3", "(a-(b|c|d))"},
        {"a b c - -", "(a-(b-c))"},
        {"a b - c *", "(a*c-b)"},
        {"a b c - *", "(a*b-c)"},
        {"a b - c d - *", "(a*c-(b|d))"},
        {"a b - c d - * e -", "(a*c-(b|d|e))"},
        {"a b - c d - |", "((a-b)|(c-d))"},
        {"a b | c -", "((a|b)-c)"},
        {"a b | c d | *", "((a|b)*(c|d))"},
        {"a b * c d * |", "((a*b)|(c*d))"},
        {"a 0 |", "a"},
        {"0 a |", "a"},
        {"0 0 |", "0"},
        {"a 0 *", "0"},
        {"a 0 -", "a"},
        {"0 a -", "0"},
        {"a 0 b |3", "(a|b)"},
        {"a 0 b -3", "(a-b)"},
        {"a b 0 * -", "a"},
        {"a b * 0 c - |", "(a*b)"},
        {"a b 0 - *", "(a*b)"},
        {"a b 0 * | c *", "(a*c)"},
        {"a b |1 *1 -", "(a-b)"},
    };
    for (size_t i = 0; i < array_count(cases); i++) {
        struct postfix p = postfix_read(cases[i].given);
        struct expr e;
        char text[256] = "";
        expr_build(&e, p.tokens, p.count, 26);
        check_invariants(&e);
        if (e.root == EXPR_NONE)
            strcpy(text, "0");
        else
            print_node(&e, e.root, text);
        assert_string_equal(text, cases[i].expected);
        expr_free(&e);
        free(p.tokens);
    }
}

static void random_trees_keep_their_meaning(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 3000; round++) {
        uint32_t leaves = 1 + random_below(&random, 24);
        struct postfix p = postfix_random(&random, leaves);
        struct expr e, without;
        expr_build(&e, p.tokens, p.count, leaves);
        check_invariants(&e);
        bool keep[24], inside[24], both[24];
        for (uint32_t l = 0; l < leaves; l++)
            keep[l] = random_below(&random, 4) > 0;
        expr_without(&without, &e, keep);
        check_invariants(&without);
        for (int sample = 0; sample < 20; sample++) {
            for (uint32_t l = 0; l < leaves; l++) {
                inside[l] = random_below(&random, 3) > 0;
                both[l] = inside[l] && keep[l];
            }
            assert_int_equal(expr_evaluate(&e, inside), postfix_evaluate(&p, inside));
            assert_int_equal(expr_evaluate(&without, inside), postfix_evaluate(&p, both));
        }
        expr_free(&e);
        expr_free(&without);
        free(p.tokens);
    }
}

static void without_nothing_is_the_same(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int round = 0; round < 300; round++) {
        struct postfix p = postfix_random(&random, 30);
        struct expr e, same;
        bool keep[30];
        memset(keep, true, sizeof keep);
        expr_build(&e, p.tokens, p.count, 30);
        expr_without(&same, &e, keep);
        assert_int_equal(e.node_count, same.node_count);
        assert_int_equal(e.kid_count, same.kid_count);
        if (e.node_count)
            assert_memory_equal(e.nodes, same.nodes, e.node_count * sizeof *e.nodes);
        if (e.kid_count)
            assert_memory_equal(e.kids, same.kids, e.kid_count * sizeof *e.kids);
        expr_free(&e);
        expr_free(&same);
        free(p.tokens);
    }
}

enum { DEEP = 1000000 };

// ops[i % count] joins leaf i + 1 to what is there, from the right or from the left.
static void check_deep(const enum expr_op *ops, uint32_t count, bool right, uint32_t nodes)
{
    struct postfix p = {0};
    if (right)
        for (uint32_t i = 0; i <= DEEP; i++)
            postfix_push(&p, EXPR_LEAF, i);
    else
        postfix_push(&p, EXPR_LEAF, 0);
    for (uint32_t i = 0; i < DEEP; i++) {
        if (!right)
            postfix_push(&p, EXPR_LEAF, i + 1);
        postfix_push(&p, ops[i % count], 2);
    }
    struct expr e, less;
    expr_build(&e, p.tokens, p.count, DEEP + 1);
    check_invariants(&e);
    assert_int_equal(e.node_count, nodes);
    bool *half = mem_alloc(DEEP + 1);
    for (uint32_t i = 0; i <= DEEP; i++)
        half[i] = i % 2 == 0;
    assert_int_equal(expr_evaluate(&e, half), postfix_evaluate(&p, half));
    expr_without(&less, &e, half);
    check_invariants(&less);
    assert_int_equal(expr_evaluate(&less, half), postfix_evaluate(&p, half));
    expr_free(&e);
    expr_free(&less);
    free(half);
    free(p.tokens);
}

static void depth_of_a_million(void **state)
{
    (void)state;
    const enum expr_op one[] = {EXPR_UNION, EXPR_INTERSECTION, EXPR_DIFFERENCE};
    check_deep(&one[0], 1, false, DEEP + 2);
    check_deep(&one[0], 1, true, DEEP + 2);
    check_deep(&one[1], 1, false, DEEP + 2);
    check_deep(&one[2], 1, false, DEEP + 3);
    check_deep(&one[2], 1, true, 2 * DEEP + 1);
    const enum expr_op mixed[] = {EXPR_UNION, EXPR_INTERSECTION, EXPR_DIFFERENCE};
    // (((a | b) * c - d) | e) ...: a union and an intersection in each three steps.
    check_deep(mixed, 3, false, DEEP + 1 + 2 * (DEEP / 3) + 1);
    const enum expr_op turns[] = {EXPR_UNION, EXPR_DIFFERENCE};
    check_deep(turns, 2, false, 2 * DEEP + 1);
}

static void zero_is_valid(void **state)
{
    (void)state;
    struct expr e = {0};
    assert_false(expr_evaluate(&e, NULL));
    expr_free(&e);
    expr_build(&e, NULL, 0, 0);
    assert_int_equal(e.root, EXPR_NONE);
    struct expr other;
    expr_without(&other, &e, NULL);
    assert_int_equal(other.root, EXPR_NONE);
    expr_free(&other);
    expr_free(&e);
    expr_free(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_form_of_small_cases),
        cmocka_unit_test(random_trees_keep_their_meaning),
        cmocka_unit_test(without_nothing_is_the_same),
        cmocka_unit_test(depth_of_a_million),
        cmocka_unit_test(zero_is_valid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
