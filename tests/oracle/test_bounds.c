// test_bounds.c - the gl device where something is scarce: memory, knowledge, room for keys, time.
#include "base/hash.h"
#include "base/mem.h"
#include "compare.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Round solids within each other, ((s0 - s1) + s2) - s3 ...: each has a value of its own, and
// nearly every interval is another combination.
struct chain {
    struct random_scene scene;
    struct subject subject;
};

static void place(struct random_scene *s, uint64_t *random)
{
    struct affine map = AFFINE_IDENTITY;
    for (int i = 0; i < 3; i++) {
        map.m[i][i] = 20 + 20 * random_unit(random);
        map.m[i][3] = 24 * random_unit(random) - 12;
    }
    array_reserve(&s->leaves, &s->leaf_capacity, s->leaf_count + 1);
    s->leaves[s->leaf_count++] = (struct random_leaf){0, map};
}

static void say(struct random_scene *s, enum expr_op op, uint32_t arg)
{
    array_reserve(&s->tokens, &s->token_capacity, s->token_count + 1);
    s->tokens[s->token_count++] = (struct expr_token){op, arg};
}

static void chain_make(struct chain *c, uint32_t leaves, int width, int height)
{
    uint64_t random = 7;
    struct random_scene *s = &c->scene;
    *c = (struct chain){.scene = {.epsilon = 1e-3}};
    array_reserve(&s->meshes, &s->mesh_capacity, 1);
    s->meshes[0] = (struct random_mesh){.shape = SHAPE_SPHERE, .fn = 10};
    s->meshes[0].convex = shape_make(&s->meshes[0].mesh, SHAPE_SPHERE, 10);
    s->mesh_count = 1;
    for (uint32_t i = 0; i < leaves; i++) {
        place(s, &random);
        say(s, EXPR_LEAF, i);
        if (i)
            say(s, i % 2 ? EXPR_DIFFERENCE : EXPR_UNION, 2);
    }
    s->rays = (struct rays){
        .origin = {0, 0, 100},
        .forward = {-0.25 * (width - 1) / width + 0.003, 0.25 * (height - 1) / height - 0.007, -1},
        .step_x = {0.5 / width, 0, 0},
        .step_y = {0, -0.5 / height, 0},
        .width = width,
        .height = height,
        .near = 1,
        .far = 1000,
        .reference = 100};
    subject_make(&c->subject, s);
}

// Gives the classes other values.
static void chain_value(struct chain *c, uint64_t (*value)(uint32_t class_id))
{
    struct body *b = &c->subject.body;
    discovery_delete(b->table);
    for (uint32_t i = 0; i < b->sharing.class_count; i++)
        b->sharing.classes[i].value = value(i);
    b->table = discovery_new(&b->expr, &b->sharing);
}

static void chain_free(struct chain *c)
{
    subject_free(&c->subject);
    random_scene_free(&c->scene);
}

static void see(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    struct picture *p = context;
    for (int y = block->y0, i = 0; y < block->y1; y++)
        for (int x = block->x0; x < block->x1; x++, i++) {
            struct pixel_spans *to = &p->spans[y * p->image.width + x];
            uint32_t n = block->first[i + 1] - block->first[i];
            to->items = mem_alloc((n + 1) * sizeof *to->items);
            memcpy(to->items, block->spans + block->first[i], n * sizeof *to->items);
            to->count = n;
            to->visits++;
        }
}

// As picture_render, but a device may fail.
static void draw(struct picture *out, struct device *device, const struct body *body,
                 const struct rays *rays, const struct render_settings *settings)
{
    size_t n = (size_t)rays->width * (size_t)rays->height;
    *out = (struct picture){
        .image = {.depth = mem_zalloc(n * 4), .leaf = mem_zalloc(n * 4), .face = mem_zalloc(n * 4)},
        .spans = mem_zalloc(n * sizeof *out->spans)};
    device_first_surface(device, body, rays, settings, &out->image, NULL, NULL,
                         &out->surface_stats);
    device_spans(device, body, rays, settings, see, out, &out->span_stats);
}

static void judge(const struct chain *c, const struct picture *p, uint32_t verdicts[VERDICTS],
                  uint32_t *hits)
{
    const struct random_scene *s = &c->scene;
    struct oracle oracle;
    struct oracle_leaf *leaves = subject_leaves(&c->subject.body);
    oracle_init(&oracle, leaves, s->leaf_count, s->tokens, s->token_count);
    struct comparison to = {
        .oracle = &oracle, .rays = &s->rays, .epsilon = s->epsilon, .tolerance = 2e-3};
    *hits = 0;
    for (int y = 0; y < s->rays.height; y++)
        for (int x = 0; x < s->rays.width; x++) {
            verdicts[compare_pixel(&to, p, x, y)]++;
            *hits += to.answer.count > 0;
        }
    compare_free(&to);
    oracle_free(&oracle);
    free(leaves);
}

static void assert_true_picture(const struct chain *c, const struct picture *p)
{
    uint32_t verdicts[VERDICTS] = {0}, hits;
    judge(c, p, verdicts, &hits);
    assert_true(hits > (uint32_t)(c->scene.rays.width * c->scene.rays.height) / 4);
    assert_int_equal(verdicts[VERDICT_WRONG] + verdicts[VERDICT_UNEXPLAINED], 0);
    assert_in_range(verdicts[VERDICT_FORGIVEN], 0, hits / 20);
}

static void assert_false_picture(const struct chain *c, const struct picture *p)
{
    uint32_t verdicts[VERDICTS] = {0}, hits;
    judge(c, p, verdicts, &hits);
    assert_true(verdicts[VERDICT_WRONG] + verdicts[VERDICT_UNEXPLAINED] > hits / 50);
}

// The first picture of a body about whose combinations nothing is known.
static void nothing_missing_is_shown(void **state)
{
    struct error why;
    struct chain c;
    struct picture p;
    struct render_settings settings = {0};
    chain_make(&c, 40, 24, 24);
    settings.epsilon = c.scene.epsilon;
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_false(device_failed(*state, &why));
    assert_true_picture(&c, &p);
    assert_in_range(p.surface_stats.misses + p.span_stats.misses, 1500, 1000000);
    picture_free(&p);

    // Where records have next to no room.
    discovery_clear(c.subject.body.table);
    settings.memory = 64 << 10;
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_false(device_failed(*state, &why));
    assert_true_picture(&c, &p);
    assert_in_range(p.surface_stats.peak_bytes, 1, settings.memory);
    assert_in_range(p.span_stats.peak_bytes, 1, settings.memory);
    picture_free(&p);
    chain_free(&c);
}

// Sets of as many solids, with one primary key: two values as different as keys can tell.
static uint64_t shared_by_two(uint32_t class_id)
{
    uint64_t random = class_id + 1;
    uint64_t secondary = random_next(&random) & 0x7fffff;
    random = class_id / 2 + 1000;
    return secondary << 32 | (uint32_t)random_next(&random);
}

static void few_colliding_keys_are_told_apart(void **state)
{
    struct error why;
    struct chain c;
    struct picture p;
    chain_make(&c, 6, 40, 40);
    chain_value(&c, shared_by_two);
    struct render_settings settings = {.epsilon = c.scene.epsilon};
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_false(device_failed(*state, &why));
    assert_true_picture(&c, &p);
    picture_free(&p);
    chain_free(&c);
}

// The last of the frames that discovery takes when it goes on over frames.
static void draw_until_known(struct picture *p, struct device *device, const struct chain *c,
                             const struct render_settings *settings)
{
    struct error why;
    for (int i = 0; i < 100; i++) {
        draw(p, device, &c->subject.body, &c->scene.rays, settings);
        assert_false(device_failed(device, &why));
        if (!i)
            assert_false_picture(c, p);
        if (!p->surface_stats.missing && !p->span_stats.missing)
            return;
        picture_free(p);
    }
    fail();
}

static void frames_lead_to_the_true_picture(void **state)
{
    struct chain c;
    struct picture p;
    struct render_settings settings = {.discovery = DISCOVER_OVER_FRAMES};
    for (int way = 0; way < 3; way++) {
        chain_make(&c, way ? 6 : 12, 32, 24);
        settings.epsilon = c.scene.epsilon;
        settings.slabs = way == 2 ? 3 : 0;
        if (way)
            chain_value(&c, shared_by_two);
        draw_until_known(&p, *state, &c, &settings);
        assert_true_picture(&c, &p);
        picture_free(&p);

        // The same body without missing anything, from values that have been renewed.
        discovery_clear(c.subject.body.table);
        draw(&p, *state, &c.subject.body, &c.scene.rays,
             &(struct render_settings){.epsilon = c.scene.epsilon});
        assert_true_picture(&c, &p);
        assert_int_equal(p.surface_stats.missing + p.span_stats.missing, 0);
        picture_free(&p);
        chain_free(&c);
    }
}

// Pairs with one value: 55 bits that cannot tell sets apart.
static uint64_t one_of_two(uint32_t class_id)
{
    uint64_t random = class_id / 2 + 1000;
    return random_next(&random) & VALUE_MASK;
}

// Secondary values are what is renewed: where the primary ones agree, sets can be told apart from
// the next frame on.
static void ambiguities_do_not_stay(void **state)
{
    struct chain c;
    struct picture p;
    struct render_settings settings = {0};
    chain_make(&c, 6, 40, 40);
    chain_value(&c, one_of_two);
    settings.epsilon = c.scene.epsilon;
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_false_picture(&c, &p); // this is what the odds of two random numbers are against
    picture_free(&p);
    settings.discovery = DISCOVER_OVER_FRAMES;
    for (int i = 0; i < 4; i++) { // nothing is missing at first
        draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
        picture_free(&p);
    }
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_int_equal(p.surface_stats.missing + p.span_stats.missing, 0);
    assert_true_picture(&c, &p);
    picture_free(&p);
    chain_free(&c);
}

static uint64_t shared_by_all(uint32_t class_id)
{
    uint64_t random = class_id + 1;
    return (random_next(&random) & 0x7fffff) << 32 | 1;
}

static void too_many_colliding_keys_are_for_the_processor(void **state)
{
    (void)state;
    struct device *device = device_under_test(true); // of its own: it will fail
    struct error why;
    struct chain c;
    struct picture p;
    chain_make(&c, 24, 24, 24);
    chain_value(&c, shared_by_all);
    struct render_settings settings = {.epsilon = c.scene.epsilon};
    draw(&p, device, &c.subject.body, &c.scene.rays, &settings);
    assert_true(device_failed(device, &why));
    assert_non_null(strstr(why.text, "share a primary key"));
    assert_null(strchr(why.text, '\n'));
    assert_true_picture(&c, &p);
    picture_free(&p);
    chain_free(&c);
    device_delete(device);
}

static void too_little_memory_is_for_the_processor(void **state)
{
    (void)state;
    struct device *device = device_under_test(true);
    struct error why;
    struct chain c;
    struct picture p;
    chain_make(&c, 8, 40, 40);
    struct render_settings settings = {.epsilon = c.scene.epsilon, .memory = 1000};
    draw(&p, device, &c.subject.body, &c.scene.rays, &settings);
    assert_true(device_failed(device, &why));
    assert_non_null(strstr(why.text, "1000 bytes of memory are too few"));
    assert_true_picture(&c, &p);
    picture_free(&p);
    chain_free(&c);
    device_delete(device);
}

// A row that has no room is taken in parts; so is the depth, for each of them anew.
static void rows_may_be_cut(void **state)
{
    struct error why;
    struct chain c;
    struct picture whole, cut;
    int x, y;
    chain_make(&c, 8, 700, 2);
    struct render_settings settings = {.epsilon = c.scene.epsilon};
    draw(&whole, *state, &c.subject.body, &c.scene.rays, &settings);
    settings.memory = 64 << 10;
    draw(&cut, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_false(device_failed(*state, &why));
    assert_in_range(cut.span_stats.peak_bytes, 1, settings.memory);
    assert_true(picture_equal(&whole, &cut, &x, &y));
    picture_free(&whole);
    picture_free(&cut);
    chain_free(&c);
}

// Some rows of a picture as wide as any: more rows are more bands (tests/gl/test_plan.c).
static void large_pictures_fit(void **state)
{
    struct error why;
    struct chain c;
    chain_make(&c, 4, 8192, 32);
    struct random_scene *s = &c.scene;
    size_t n = 8192 * 32;
    struct surface_image image[2];
    struct render_settings settings[2] = {{.epsilon = s->epsilon, .memory = 1 << 30},
                                          {.epsilon = s->epsilon, .memory = 1 << 20}};
    struct render_stats stats;
    for (int i = 0; i < 2; i++) {
        image[i] = (struct surface_image){
            .depth = mem_zalloc(n * 4), .leaf = mem_zalloc(n * 4), .face = mem_zalloc(n * 4)};
        device_first_surface(*state, &c.subject.body, &s->rays, &settings[i], &image[i], NULL, NULL,
                             &stats);
    }
    assert_false(device_failed(*state, &why));
    assert_in_range(stats.peak_bytes, 1 << 19, 1 << 20);
    assert_memory_equal(image[0].leaf, image[1].leaf, n * 4);
    assert_memory_equal(image[0].depth, image[1].depth, n * 4);
    for (int i = 0; i < 2; i++) {
        free(image[i].depth);
        free(image[i].leaf);
        free(image[i].face);
    }
    chain_free(&c);
}

static void nothing_is_drawn_where_nothing_is(void **state)
{
    struct error why;
    struct chain c;
    struct picture p;
    chain_make(&c, 1, 1, 1);
    struct render_settings settings = {.epsilon = c.scene.epsilon};
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_int_equal(p.image.leaf[0], 0);
    assert_int_equal(p.spans[0].count, 1);
    picture_free(&p);
    chain_free(&c);

    chain_make(&c, 0, 5, 4);
    settings.slabs = 3;
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    assert_false(device_failed(*state, &why));
    for (int i = 0; i < 20; i++) {
        assert_int_equal(p.image.leaf[i], SURFACE_NONE);
        assert_int_equal(p.spans[i].count, 0);
        assert_int_equal(p.spans[i].visits, 1);
    }
    picture_free(&p);
    chain_free(&c);
}

struct teller {
    atomic_bool cancelled;
    int rows;
};

static void cancel_after_some(void *context, struct pixel_rect rect, bool nothing)
{
    (void)nothing;
    struct teller *t = context;
    t->rows += rect.y1 - rect.y0;
    atomic_store(&t->cancelled, true);
}

static void a_cancelled_picture_is_not_a_failure(void **state)
{
    struct error why;
    struct chain c;
    struct picture p;
    struct teller t = {.rows = 0};
    chain_make(&c, 8, 100, 100);
    struct render_settings settings = {.epsilon = c.scene.epsilon, .threads = 1};
    draw(&p, *state, &c.subject.body, &c.scene.rays, &settings);
    settings.cancelled = &t.cancelled;
    settings.memory = 128 << 10; // many bands
    device_first_surface(*state, &c.subject.body, &c.scene.rays, &settings, &p.image,
                         cancel_after_some, &t, NULL);
    assert_false(device_failed(*state, &why));
    assert_in_range(t.rows, 1, 50);
    t.rows = 0;
    device_first_surface(*state, &c.subject.body, &c.scene.rays, &settings, &p.image,
                         cancel_after_some, &t, NULL); // cancelled before it begins
    assert_false(device_failed(*state, &why));
    assert_int_equal(t.rows, 0);
    picture_free(&p);
    chain_free(&c);
}

static int setup(void **state)
{
    *state = device_under_test(true);
    return 0;
}

static int teardown(void **state)
{
    device_delete(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_missing_is_shown),
        cmocka_unit_test(few_colliding_keys_are_told_apart),
        cmocka_unit_test(frames_lead_to_the_true_picture),
        cmocka_unit_test(ambiguities_do_not_stay),
        cmocka_unit_test(too_many_colliding_keys_are_for_the_processor),
        cmocka_unit_test(too_little_memory_is_for_the_processor),
        cmocka_unit_test(rows_may_be_cut),
        cmocka_unit_test(large_pictures_fit),
        cmocka_unit_test(nothing_is_drawn_where_nothing_is),
        cmocka_unit_test(a_cancelled_picture_is_not_a_failure),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
