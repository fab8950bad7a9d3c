// test_passes.c - the device on the graphics processor says what its time went into.
#include "../render/unit.h"
#include "render/gl/device.h"

#include <stdio.h>

static const struct render_pass *pass_of(const struct render_stats *stats, const char *name)
{
    for (int i = 0; i < RENDER_PASSES && stats->passes[i].name; i++)
        if (strcmp(stats->passes[i].name, name) == 0)
            return &stats->passes[i];
    return NULL;
}

static void sink(void *context, uint32_t worker, const struct span_block *block)
{
    (void)context;
    (void)worker;
    (void)block;
}

static void frames_tell_their_passes(void **state)
{
    struct stage s;
    struct render_stats stats;
    struct rays rays = rays_from_above(20);
    stage_make(&s, "difference() { cube(size = [8, 8, 2], center = true);"
                   "cylinder($fn = 8, h = 4, r1 = 2, r2 = 2, center = true); }");
    device_delete(s.device);
    s.device = *state;
    for (int i = 0; i < 2; i++) {
        device_spans(s.device, s.model.bodies, &rays, &s.settings, sink, NULL, &stats);
        const char *const all[] = {"views",   "select",  "count",   "scan",
                                   "scatter", "resolve", "readback"};
        double sum = 0;
        for (size_t k = 0; k < array_count(all); k++) {
            const struct render_pass *p = pass_of(&stats, all[k]);
            assert_non_null(p);
            assert_true(p->seconds >= 0);
            sum += p->seconds;
        }
        assert_true(sum > 0);
        // Numbers of crossings, what rays met, intervals; before, what they did not know.
        assert_int_equal(stats.waits.count, i ? 3 : 5);
        assert_true(stats.waits.longest > 0 && stats.waits.longest <= stats.waits.seconds);
        assert_int_equal(pass_of(&stats, "readback")->count, stats.waits.count);
        assert_int_equal(stats.table_bytes > 0, i == 0);
        assert_int_equal(pass_of(&stats, "scatter")->count, 1); // one band, one slab
        assert_int_equal(pass_of(&stats, "resolve")->count, 1);
        // Only the first picture meets combinations that are unknown.
        assert_true(!pass_of(&stats, "discover") == (i > 0));
        assert_true(!pass_of(&stats, "rewalk") == (i > 0));
        assert_true((stats.misses == 0) == (i > 0));
    }
    s.device = NULL;
    stage_free(&s);
}

int main(void)
{
    struct error err;
    struct device *device = gl_device_new(true, NULL, &err);
    if (!device) {
        printf("skipped: %s\n", err.text);
        return 77;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(frames_tell_their_passes, device),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_delete(device);
    return failed;
}
