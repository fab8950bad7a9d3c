// test_values.c - values of the classes.
#include "hcsg/share.h"
#include "hcsg/values.h"
#include "unit.h"

static int by_number(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void check_primaries(const struct value_class *classes, uint32_t count)
{
    uint32_t *p = mem_alloc(count * sizeof *p);
    for (uint32_t i = 0; i < count; i++)
        p[i] = (uint32_t)classes[i].value;
    qsort(p, count, sizeof *p, by_number);
    assert_true(p[0] != 0);
    for (uint32_t i = 1; i < count; i++)
        assert_true(p[i - 1] != p[i]);
    free(p);
}

static void primaries_are_distinct_and_not_zero(void **state)
{
    (void)state;
    enum { N = 1000000 }; // random numbers alone would give 116 equal pairs
    struct value_class *classes = mem_zalloc(N * sizeof *classes);
    values_fill(classes, N, 1);
    check_primaries(classes, N);
    for (uint32_t i = 0; i < N; i++)
        assert_int_equal(classes[i].value >> VALUE_BITS, 0);
    free(classes);
}

static void every_bit_is_random(void **state)
{
    (void)state;
    enum { N = 10000 };
    struct value_class *classes = mem_zalloc(N * sizeof *classes);
    values_fill(classes, N, 2);
    for (unsigned bit = 0; bit < VALUE_BITS; bit++) {
        uint32_t ones = 0;
        for (uint32_t i = 0; i < N; i++)
            ones += (uint32_t)(classes[i].value >> bit) & 1;
        assert_in_range(ones, N / 2 - 300, N / 2 + 300); // six standard deviations
    }
    free(classes);
}

static void same_seed_gives_the_same_values(void **state)
{
    (void)state;
    struct value_class a[100] = {0}, b[100] = {0};
    values_fill(a, 100, 5);
    values_fill(b, 100, 5);
    assert_memory_equal(a, b, sizeof a);
    values_fill(b, 100, 6);
    assert_memory_not_equal(a, b, sizeof a);
    values_fill(a, 0, 5);
}

static void renewal_keeps_primaries(void **state)
{
    (void)state;
    enum { N = 1000 };
    struct value_class a[N] = {0}, b[N];
    uint64_t stream = 9;
    values_fill(a, N, 5);
    memcpy(b, a, sizeof a);
    values_renew(b, N, &stream);
    uint32_t same = 0;
    for (uint32_t i = 0; i < N; i++) {
        assert_int_equal((uint32_t)a[i].value, (uint32_t)b[i].value);
        assert_int_equal(b[i].value >> VALUE_BITS, 0);
        same += a[i].value == b[i].value;
    }
    assert_true(same <= 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(primaries_are_distinct_and_not_zero),
        cmocka_unit_test(every_bit_is_random),
        cmocka_unit_test(same_seed_gives_the_same_values),
        cmocka_unit_test(renewal_keeps_primaries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
