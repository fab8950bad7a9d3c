// test_device.c - a device that fails: the picture is whole all the same, and one line says so.
#include "unit.h"

enum { SIZE = 100, PIXELS = SIZE * SIZE };

// Draws the upper rows as the processor does, then fails.
struct failing {
    struct device device;
    struct device *inner;
    int rows, asked;
};

static int breaks(struct failing *f, struct render_stats *stats, struct error *err)
{
    f->asked++;
    stats->seconds_draw = 1000;
    error_set(err, "glass: broke");
    return f->rows;
}

static struct rays upper(const struct rays *rays, int rows)
{
    struct rays r = *rays;
    r.height = rows;
    return r;
}

static int first_surface(struct device *d, const struct body *body, const struct rays *rays,
                         const struct render_settings *settings, struct surface_image *out,
                         void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                         void *context, struct render_stats *stats, struct error *err)
{
    struct failing *f = (struct failing *)d;
    struct rays r = upper(rays, f->rows);
    struct surface_image image = *out;
    if (f->rows)
        device_first_surface(f->inner, body, &r, settings, &image, drawn, context, stats);
    return breaks(f, stats, err);
}

static int spans(struct device *d, const struct body *body, const struct rays *rays,
                 const struct render_settings *settings,
                 void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                 void *context, struct render_stats *stats, struct error *err)
{
    struct failing *f = (struct failing *)d;
    struct rays r = upper(rays, f->rows);
    if (f->rows)
        device_spans(f->inner, body, &r, settings, sink, context, stats);
    return breaks(f, stats, err);
}

static void end(struct device *d)
{
    struct failing *f = (struct failing *)d;
    device_delete(f->inner);
    free(f);
}

static struct failing *failing_new(int rows)
{
    static const struct device_kind kind = {
        .first_surface = first_surface, .spans = spans, .delete = end};
    struct failing *f = mem_zalloc(sizeof *f);
    f->device.kind = &kind;
    f->inner = cpu_device_new();
    f->rows = rows;
    return f;
}

// What a device said of each pixel.
struct told {
    int visits[PIXELS];
    double inside[PIXELS]; // sum of the lengths of its spans
};

static void drawn(void *context, struct pixel_rect rect, bool nothing)
{
    struct told *t = context;
    (void)nothing;
    for (int y = rect.y0; y < rect.y1; y++)
        for (int x = rect.x0; x < rect.x1; x++)
            t->visits[y * SIZE + x]++;
}

static void sink(void *context, uint32_t worker, const struct span_block *block)
{
    struct told *t = context;
    const uint32_t *first = block->first;
    (void)worker;
    for (int y = block->y0; y < block->y1; y++)
        for (int x = block->x0; x < block->x1; x++, first++) {
            t->visits[y * SIZE + x]++;
            for (uint32_t i = first[0]; i < first[1]; i++)
                t->inside[y * SIZE + x] += block->spans[i].leave - block->spans[i].enter;
        }
}

static const char text[] =
    "difference() { sphere($fn=12,r=20); cube(size=[99,9,9],center=false); }";

// In perspective and not: the rows below begin elsewhere in each.
static void from_aside(struct rays *out, bool orthographic)
{
    struct camera c = {
        .rotation = {50, 10, 20}, .distance = 90, .fov = 40, .orthographic = orthographic};
    *out = camera_rays(&c, SIZE, SIZE, BOX_EMPTY);
}

static void surfaces_are_whole(int rows, bool orthographic)
{
    static float depth[2][PIXELS];
    static uint32_t leaf[2][PIXELS], face[2][PIXELS];
    static struct told told;
    struct stage s;
    struct rays rays;
    struct error why;
    struct render_stats stats = {0};
    struct failing *f = failing_new(rows);
    memset(&told, 0, sizeof told);
    stage_make(&s, text);
    from_aside(&rays, orthographic);
    struct device *devices[2] = {s.device, &f->device};
    for (int i = 0; i < 2; i++) {
        struct surface_image image = {.depth = depth[i], .leaf = leaf[i], .face = face[i]};
        device_first_surface(devices[i], &s.model.bodies[0], &rays, &s.settings, &image,
                             i ? drawn : NULL, &told, &stats);
        assert_int_equal(image.width, SIZE);
        assert_int_equal(image.height, SIZE);
    }
    int hits = 0;
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(told.visits[i], 1);
        assert_int_equal(leaf[0][i], leaf[1][i]);
        if (leaf[0][i] == SURFACE_NONE)
            continue;
        hits++;
        assert_float_equal(depth[0][i], depth[1][i], 1e-4);
        assert_int_equal(face[0][i], face[1][i]);
    }
    assert_in_range(hits, PIXELS / 20, PIXELS - 1);
    assert_true(stats.seconds_draw > 1000);
    assert_true(device_failed(&f->device, &why));
    device_delete(&f->device);
    stage_free(&s);
}

static void surfaces_stay_whole(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++)
        surfaces_are_whole(i / 2 * 37, i % 2);
}

static void spans_stay_whole(void **state)
{
    (void)state;
    static struct told told[2];
    struct stage s;
    struct rays rays;
    struct render_stats stats;
    struct failing *f = failing_new(51);
    stage_make(&s, text);
    from_aside(&rays, false);
    struct device *devices[2] = {s.device, &f->device};
    for (int i = 0; i < 2; i++)
        device_spans(devices[i], &s.model.bodies[0], &rays, &s.settings, sink, &told[i], &stats);
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(told[1].visits[i], 1);
        assert_float_equal(told[0].inside[i], told[1].inside[i], 1e-4);
    }
    device_delete(&f->device);
    stage_free(&s);
}

// It fails once, says so once and is left alone afterwards.
static void a_failure_is_told_once(void **state)
{
    (void)state;
    static struct told told;
    struct stage s;
    struct rays rays;
    struct error why;
    struct render_stats stats;
    struct failing *f = failing_new(0);
    stage_make(&s, text);
    from_aside(&rays, true);
    assert_false(device_failed(&f->device, &why));
    for (int i = 0; i < 3; i++)
        device_spans(&f->device, &s.model.bodies[0], &rays, &s.settings, sink, &told, &stats);
    assert_int_equal(f->asked, 1);
    assert_int_equal(told.visits[0], 3);
    assert_true(device_failed(&f->device, &why));
    assert_string_equal(why.text, "glass: broke; the processor draws from here on");
    assert_false(device_failed(&f->device, &why));
    device_delete(&f->device);
    stage_free(&s);
}

static void passes_add_up_by_name(void **state)
{
    (void)state;
    struct render_stats sum = {
        .peak_bytes = 5, .model_bytes = 6, .passes = {{"one", 1, 2}, {"two", 4, 1}}};
    const struct render_stats more = {.peak_bytes = 3,
                                      .model_bytes = 7,
                                      .fragments = 7,
                                      .passes = {{"two", 0.5, 1}, {"three", 3, 4}}};
    const struct render_pass expected[] = {{"one", 1, 2}, {"two", 4.5, 2}, {"three", 3, 4}};
    render_stats_add(&sum, &more);
    assert_int_equal(sum.peak_bytes, 5);
    assert_int_equal(sum.model_bytes, 7);
    assert_int_equal(sum.fragments, 7);
    for (size_t i = 0; i < array_count(expected); i++) {
        assert_string_equal(sum.passes[i].name, expected[i].name);
        assert_true(sum.passes[i].seconds == expected[i].seconds);
        assert_int_equal(sum.passes[i].count, expected[i].count);
    }
    assert_null(sum.passes[array_count(expected)].name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_stay_whole),
        cmocka_unit_test(spans_stay_whole),
        cmocka_unit_test(a_failure_is_told_once),
        cmocka_unit_test(passes_add_up_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
