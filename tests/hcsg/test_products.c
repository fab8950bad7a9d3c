// test_products.c - expressions as sums of products.
#include "hcsg/products.h"

#include "unit.h"

#include <stdio.h>

enum { LEAVES = 26, MANY = 1 << 20 };

static struct box everywhere[LEAVES];

// Reads "a b - c * |": letters are leaves, the operators take two operands.
static void read_expr(struct expr *out, const char *text)
{
    struct postfix p = {0};
    for (const char *s = text; *s; s++) {
        if (*s >= 'a' && *s <= 'z')
            postfix_push(&p, EXPR_LEAF, (uint32_t)(*s - 'a'));
        else if (*s != ' ')
            postfix_push(&p,
                         *s == '|'   ? EXPR_UNION
                         : *s == '*' ? EXPR_INTERSECTION
                                     : EXPR_DIFFERENCE,
                         2);
    }
    expr_build(out, p.tokens, p.count, LEAVES);
    free(p.tokens);
}

static void expect(const char *text, const struct box *boxes, const char *wanted)
{
    struct expr e;
    struct products p;
    char got[1000] = "";
    read_expr(&e, text);
    assert_true(products_build(&p, &e, e.root, boxes, MANY));
    for (uint32_t i = 0; i < p.count; i++) {
        strcat(got, i ? " + " : "");
        for (uint32_t k = 0; k < p.items[i].added + p.items[i].cut; k++)
            sprintf(got + strlen(got), "%s%c", k >= p.items[i].added ? "-" : "",
                    (char)('a' + p.leaves[p.items[i].first + k]));
    }
    assert_string_equal(got, wanted);
    products_free(&p);
    products_free(&p);
    expr_free(&e);
}

static int setup(void **state)
{
    (void)state;
    for (int i = 0; i < LEAVES; i++)
        everywhere[i] = (struct box){{0, 0, 0}, {1, 1, 1}};
    return 0;
}

// The rules of Goldfeather as OpenSCAD's CSGTreeNormalizer.cc applies them.
static void every_rule(void **state)
{
    (void)state;
    expect("a", everywhere, "a");
    expect("abc||", everywhere, "a + b + c");
    expect("abc|-", everywhere, "a-b-c");
    expect("abc|*", everywhere, "ab + ac");
    expect("abc*-", everywhere, "a-b + a-c");
    expect("abc**", everywhere, "abc");
    expect("abc--", everywhere, "a-b + ac");
    expect("abc-*", everywhere, "ab-c");
    expect("ab-c*", everywhere, "ac-b");
    expect("ab|c-", everywhere, "a-c + b-c");
    expect("ab|c*", everywhere, "ac + bc");
}

static void the_last_factor_changes_slowest(void **state)
{
    (void)state;
    expect("ab|cd|*", everywhere, "ac + bc + ad + bd");
    expect("ab|cd*-", everywhere, "a-c + b-c + a-d + b-d");
    expect("abc*de*|-", everywhere, "a-b-d + a-c-d + a-b-e + a-c-e");
    expect("abcd---", everywhere, "a-b + ac-d");
    expect("abc-d*-", everywhere, "a-b + ac + a-d");
    expect("abcd|-ef|*-", everywhere, "a-b + ac + ad + a-e-f");
    expect("ab|cd*-ef|*", everywhere, "ae-c + be-c + ae-d + be-d + af-c + bf-c + af-d + bf-d");
}

static void boxes_that_do_not_meet(void **state)
{
    (void)state;
    struct box boxes[LEAVES];
    memcpy(boxes, everywhere, sizeof boxes);
    boxes[1] = (struct box){{2, 0, 0}, {3, 1, 1}};
    expect("ab*", boxes, "");
    expect("ab-", boxes, "a");
    expect("ab|c-", boxes, "a-c + b");
    expect("ab|c*", boxes, "ac");
    boxes[1].min.x = 1; // touches
    expect("ab-", boxes, "a-b");
}

static void too_many_are_refused(void **state)
{
    (void)state;
    struct expr e;
    struct products p;
    read_expr(&e, "ab|cd|*ef|*gh|*");
    assert_true(products_build(&p, &e, e.root, everywhere, 200));
    assert_int_equal(p.count, 16);
    products_free(&p);
    assert_false(products_build(&p, &e, e.root, everywhere, 63));
    expr_free(&e);
}

// The sum holds where the expression does.
static void random_expressions(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int round = 0; round < 2000; round++) {
        struct postfix tokens = postfix_random(&random, 1 + random_below(&random, 8));
        struct expr e;
        struct products p;
        expr_build(&e, tokens.tokens, tokens.count, LEAVES);
        if (e.root == EXPR_NONE) {
            expr_free(&e);
            free(tokens.tokens);
            continue;
        }
        assert_true(products_build(&p, &e, e.root, everywhere, MANY));
        for (uint32_t set = 0; set < 256; set++) {
            bool inside[LEAVES] = {0}, any = false;
            for (int i = 0; i < 8; i++)
                inside[i] = set >> i & 1;
            for (uint32_t i = 0; i < p.count; i++) {
                bool all = true;
                for (uint32_t k = 0; k < p.items[i].added + p.items[i].cut; k++)
                    all &= inside[p.leaves[p.items[i].first + k]] == (k < p.items[i].added);
                any |= all;
            }
            assert_int_equal(any, expr_evaluate(&e, inside));
        }
        products_free(&p);
        expr_free(&e);
        free(tokens.tokens);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule),
        cmocka_unit_test(the_last_factor_changes_slowest),
        cmocka_unit_test(boxes_that_do_not_meet),
        cmocka_unit_test(too_many_are_refused),
        cmocka_unit_test(random_expressions),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
