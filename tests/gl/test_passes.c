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

static void draw(struct device *d, const struct model *m, struct surface_image *out,
                 struct render_stats *stats)
{
    struct rays rays = rays_from_above(20);
    struct render_settings settings = {.epsilon = 1e-4, .threads = 1};
    memset(out->face, 0, 400 * sizeof *out->face);
    device_first_surface(d, &m->bodies[0], &rays, &settings, out, NULL, NULL, stats);
}

static void build(struct model *out, const char *text, struct solid_store *store,
                  const struct model *before)
{
    struct messages messages = {0};
    struct csg_tree tree;
    struct model_options options = MODEL_DEFAULTS;
    size_t size = strlen(text);
    char *copy = mem_zalloc(size + 2);
    memcpy(copy, text, size);
    options.before = before;
    assert_true(csg_parse(&tree, "unit.csg", copy, size, &messages));
    model_build(out, &tree, store, &options, &messages);
    csg_free(&tree);
    free(copy);
    messages_free(&messages);
}

// A model that takes the place of another shows what it shows on its own, and brings no meshes
// along that are there.
static void edits_leave_meshes_where_they_are(void **state)
{
    static const char first[] = "difference() { sphere($fn = 60, r = 8); cube(5); cube(2); }";
    static const char moved[] = "difference() { sphere($fn = 60, r = 7); cube(6); }";
    struct device *d = *state;
    struct solid_store *store = solid_store_new(), *other = solid_store_new();
    struct model before, now, alone;
    float depth[2][400];
    uint32_t leaf[2][400], face[2][400];
    struct surface_image a = {20, 20, depth[0], leaf[0], face[0]};
    struct surface_image b = {20, 20, depth[1], leaf[1], face[1]};
    struct render_stats once, shared, whole;
    build(&before, first, store, NULL);
    build(&now, moved, store, &before);
    build(&alone, moved, other, NULL);
    draw(d, &before, &a, &once);
    draw(d, &now, &a, &shared);
    draw(d, &alone, &b, &whole);
    assert_memory_equal(depth[0], depth[1], sizeof depth[0]);
    assert_memory_equal(leaf[0], leaf[1], sizeof leaf[0]);
    assert_memory_equal(face[0], face[1], sizeof face[0]);
    size_t mesh = now.bodies[0].leaves[0].solid->mesh.triangle_count * 32;
    assert_true(shared.model_bytes < once.model_bytes + mesh);
    assert_true(whole.model_bytes > shared.model_bytes + mesh);
    model_free(&before);
    model_free(&now);
    model_free(&alone);
    solid_store_delete(store);
    solid_store_delete(other);
}

static void linked_lists_are_neither_counted_nor_written(void **state)
{
    struct stage s;
    struct render_stats stats;
    struct rays rays = rays_from_above(20);
    stage_make(&s, "cube(size = [8, 8, 2], center = true);");
    device_delete(s.device);
    s.device = *state;
    s.settings.linked = true;
    device_spans(s.device, s.model.bodies, &rays, &s.settings, sink, NULL, &stats);
    assert_non_null(pass_of(&stats, "insert"));
    assert_null(pass_of(&stats, "count"));
    assert_null(pass_of(&stats, "scatter"));
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
        cmocka_unit_test_prestate(edits_leave_meshes_where_they_are, device),
        cmocka_unit_test_prestate(frames_tell_their_passes, device),
        cmocka_unit_test_prestate(linked_lists_are_neither_counted_nor_written, device),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_delete(device);
    return failed;
}
