// test_plan.c - the budget is divided without a rest, and slabs end where counts say.
#include "render/gl/plan.h"
#include "render/gl/slabs.h"
#include "shaders/shared.h"
#include "unit.h"

// What all buffers of a plan hold at most.
static size_t bytes_of(const struct gl_plan *p, bool spans, bool linked)
{
    size_t pixels = (size_t)p->rows * (size_t)p->columns;
    size_t bytes = sizeof(struct frame_data) + sizeof(struct counters) + BINS * 4 + p->staging;
    bytes += (size_t)p->pieces * 16 + (size_t)p->miss_words * 4 + (size_t)p->claims * 4;
    bytes += 2 * (pixels + 1) * 4 + pixels * (sizeof(struct pixel_state) + 12);
    bytes += spans ? (pixels + p->fragments / 2) * sizeof(struct span_data) : pixels * 12;
    for (size_t n = p->numbers; n > 1; bytes += n * 4)
        n = (n + SCAN_BLOCK - 1) / SCAN_BLOCK;
    return bytes + p->fragments * (sizeof(struct fragment) + (linked ? 4 : 0));
}

static void plans_stay_within_their_budget(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 5000}, {1024, 1024}, {8192, 8192}, {2000000, 2}};
    struct error err;
    for (size_t budget = GL_MEMORY_LEAST; budget < (size_t)1 << 36; budget += budget / 7)
        for (size_t i = 0; i < 4 * sizeof sizes / sizeof sizes[0]; i++) {
            struct gl_plan p;
            const int *size = sizes[i / 4];
            bool spans = i % 2, linked = i / 2 % 2;
            size_t storage = (size_t)128 << 20;
            assert_true(
                gl_plan_make(&p, budget, storage, size[0], size[1], 999, spans, linked, &err));
            assert_in_range(bytes_of(&p, spans, linked), 1, budget);
            assert_in_range(p.columns, 1, size[0]);
            assert_in_range(p.rows, 1, p.columns < size[0] ? 1 : size[1]);
            assert_in_range(p.fragments, budget / 100 < 1000000 ? budget / 100 : 1000000,
                            UINT32_MAX - 1);
            assert_true(p.fragments <= storage / sizeof(struct fragment));
            assert_true(p.miss_words >= 1024 && p.claims >= 256 && p.pieces >= 512);
            assert_int_equal(p.claims & (p.claims - 1), 0);
        }
}

static void budgets_too_small_are_refused(void **state)
{
    (void)state;
    struct error err;
    struct gl_plan p = {.rows = 77};
    assert_false(gl_plan_make(&p, GL_MEMORY_LEAST - 1, SIZE_MAX, 10, 10, 1, false, false, &err));
    assert_string_equal(err.text, "65535 bytes of memory are too few for the gl device");
    assert_false(gl_plan_make(&p, 1, SIZE_MAX, 10, 10, 1, true, false, &err));
    assert_false(gl_plan_make(&p, GL_MEMORY_LEAST, SIZE_MAX, 10, 10, 10000000, true, false, &err));
    assert_int_equal(p.rows, 77);
}

// Slabs in the order of depth, each with what it holds of bins over [0, BINS].
static uint32_t sums_of(const struct gl_slabs *s, const uint32_t *bins, uint32_t *sums)
{
    uint32_t b = 0;
    for (uint32_t i = 0; i < s->count; i++)
        for (sums[i] = 0; b < BINS && (float)b + 0.5F < s->ends[s->count - 1 - i]; b++)
            sums[i] += bins[b];
    assert_int_equal(b, BINS);
    return s->count;
}

static void slabs_hold_what_fits(void **state)
{
    (void)state;
    struct gl_slabs s = {0};
    uint32_t bins[BINS], sums[BINS + 1];
    for (uint32_t b = 0; b < BINS; b++)
        bins[b] = b % 16 == 3 ? 90 : b % 5;
    gl_slabs_begin(&s, 1000);
    assert_true(gl_slabs_cut(&s, bins, 0, BINS, 100, 0));
    uint32_t n = sums_of(&s, bins, sums);
    assert_true(n >= 2);
    for (uint32_t i = 0; i < n; i++)
        assert_in_range(sums[i], 1, 100);
    assert_true(s.ends[0] == 1000); // the end that was there
    gl_slabs_free(&s);
    gl_slabs_free(&s);
}

static void slabs_are_as_many_as_wanted(void **state)
{
    (void)state;
    struct gl_slabs s = {0};
    uint32_t bins[BINS] = {[100] = 7}, sums[BINS + 1];
    for (uint32_t wanted = 1; wanted <= BINS; wanted += 51) {
        gl_slabs_begin(&s, BINS);
        assert_true(gl_slabs_cut(&s, bins, 0, BINS, 1000, wanted));
        assert_in_range(s.count, wanted, BINS);
        for (uint32_t i = 1; i < s.count; i++)
            assert_true(s.ends[i] < s.ends[i - 1]);
    }
    for (uint32_t b = 0; b < BINS; b++)
        bins[b] = 10;
    gl_slabs_begin(&s, BINS);
    assert_true(gl_slabs_cut(&s, bins, 0, BINS, 10000, 4));
    assert_int_equal(sums_of(&s, bins, sums), 4);
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(sums[i], 640);
    gl_slabs_free(&s);
}

static void one_depth_cannot_be_cut(void **state)
{
    (void)state;
    struct gl_slabs s = {0};
    uint32_t bins[BINS] = {[0] = 5000};
    gl_slabs_begin(&s, 2);
    assert_false(gl_slabs_cut(&s, bins, 1, 1.0000001192F, 100, 0)); // the next number
    assert_int_equal(s.count, 1);
    assert_true(gl_slabs_cut(&s, bins, 1, 1.0000002384F, 100, 0));
    assert_int_equal(s.count, 2);
    assert_true(s.ends[1] > 1 && s.ends[1] < 1.0000002384F);

    // Counts that have run over say nothing is there: still it gets on.
    memset(bins, 0, sizeof bins);
    gl_slabs_begin(&s, 2);
    assert_true(gl_slabs_cut(&s, bins, 0, 2, 100, 0));
    assert_true(s.ends[1] == 1);
    gl_slabs_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_stay_within_their_budget),
        cmocka_unit_test(budgets_too_small_are_refused),
        cmocka_unit_test(slabs_hold_what_fits),
        cmocka_unit_test(slabs_are_as_many_as_wanted),
        cmocka_unit_test(one_depth_cannot_be_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
