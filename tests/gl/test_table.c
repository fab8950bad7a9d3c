// test_table.c - the copy of the table that shaders see is the table, and little is sent.
#include "render/gl/discover.h"
#include "render/gl/readback.h"
#include "unit.h"

static struct error err;

// (a1 - a2) | (a3 - a4) ...: no two leaves share a value.
struct model_of_pairs {
    struct expr e;
    struct sharing s;
    struct discovery *d;
};

static void model_make(struct model_of_pairs *m)
{
    enum { PAIRS = 50 };
    struct expr_token tokens[3 * PAIRS + 1];
    uint32_t n = 0;
    bool convex[2 * PAIRS] = {0};
    for (uint32_t i = 0; i < PAIRS; i++) {
        tokens[n++] = (struct expr_token){EXPR_LEAF, 2 * i};
        tokens[n++] = (struct expr_token){EXPR_LEAF, 2 * i + 1};
        tokens[n++] = (struct expr_token){EXPR_DIFFERENCE, 2};
    }
    tokens[n++] = (struct expr_token){EXPR_UNION, PAIRS};
    expr_build(&m->e, tokens, n, 2 * PAIRS);
    sharing_build(&m->s, &m->e, convex, false);
    m->d = discovery_new(&m->e, &m->s);
}

// Makes a combination of two members known.
static void learn(struct model_of_pairs *m, uint32_t i)
{
    uint32_t n = m->s.class_count, a = i % n, b = (a + 1 + i / n % (n - 1)) % n;
    struct class_step steps[2] = {{a, 1}, {b, 1}};
    uint64_t key = m->s.classes[a].value + m->s.classes[b].value;
    assert_true(discovery_extend(m->d, 0, steps, 2, key & VALUE_MASK));
}

static void assert_is_table(const struct gl_table *t, const struct discovery *d)
{
    struct gl_memory memory = {.budget = SIZE_MAX};
    struct gl_readback r = {0};
    const struct table *table = d->table;
    size_t size = (size_t)table_capacity(table) * 8;
    const struct gl_part all = {gl_table_records(t), 0, size, NULL};
    assert_int_equal(t->shift, table->shift);
    assert_true(gl_readback_start(&r, &memory, "read", &all, 1, &err));
    const void *back = gl_readback_wait(&r, &err);
    assert_non_null(back);
    assert_memory_equal(back, (const void *)table->records, size);
    gl_readback_free(&r);
}

static void copies_follow(void **state)
{
    (void)state;
    struct model_of_pairs m;
    struct gl_table t = {0};
    struct gl_memory memory = {.budget = SIZE_MAX};
    model_make(&m);
    uint64_t whole = 0; // what copies of the whole table would have sent
    for (uint32_t i = 0; i < 3000; i++) {
        learn(&m, i);
        if (i % 10 && i < 2990)
            continue;
        assert_true(gl_table_upload(&t, &memory, m.d, &err));
        whole += (uint64_t)table_capacity(m.d->table) * 8;
        if (i % 100 == 0)
            assert_is_table(&t, m.d);
    }
    assert_is_table(&t, m.d);
    assert_in_range(t.uploaded, 1, whole / 2);

    uint64_t before = t.uploaded;
    assert_true(gl_table_upload(&t, &memory, m.d, &err)); // nothing is new
    assert_int_equal(t.uploaded, before);
    learn(&m, 3000);
    assert_true(gl_table_upload(&t, &memory, m.d, &err));
    assert_in_range(t.uploaded - before, 1, 8192);
    assert_is_table(&t, m.d);

    uint64_t random = 1;
    values_renew(m.s.classes, m.s.class_count, &random);
    discovery_renew(m.d);
    assert_true(gl_table_upload(&t, &memory, m.d, &err));
    assert_is_table(&t, m.d);

    discovery_clear(m.d); // smaller than before
    learn(&m, 0);
    assert_true(gl_table_upload(&t, &memory, m.d, &err));
    assert_is_table(&t, m.d);
    gl_table_free(&t);
    assert_int_equal(memory.used, 0);
    discovery_delete(m.d);
    sharing_free(&m.s);
    expr_free(&m.e);
}

int main(void)
{
    struct gl_context *context = unit_context();
    struct error failure;
    assert_true(gl_context_enter(context, &failure));
    const struct CMUnitTest tests[] = {cmocka_unit_test(copies_follow)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    gl_context_leave(context);
    gl_context_delete(context);
    return failed + unit_said;
}
