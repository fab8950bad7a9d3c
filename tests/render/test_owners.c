// test_owners.c - whose face shows where several lie in one plane: the latest of those that matter,
// whichever device draws and whichever way it takes; and who owns the ends of rays.
#include "csg/csg.h"
#include "render/gl/device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

enum { SIDE = 8, PIXELS = SIDE * SIDE };

// Rays that reach the plane z = 0 around x = y = 5, a tenth apart.
static struct rays rays_down(double lean, bool orthographic)
{
    struct rays r = {.orthographic = orthographic, .width = SIDE, .height = SIDE};
    double distance = 50, step = orthographic ? 0.1 : 0.1 / distance;
    r.forward = vec3_normalized((struct vec3){lean, lean / 2, -1});
    struct vec3 right = vec3_normalized(vec3_cross(r.forward, (struct vec3){0, 1, 0}));
    r.origin = vec3_sub((struct vec3){5, 5, 0}, vec3_scale(r.forward, distance));
    r.step_x = vec3_scale(right, step);
    r.step_y = vec3_scale(vec3_cross(r.forward, right), step);
    r.near = 1;
    r.far = 200;
    r.reference = distance;
    return r;
}

static void expect_leaf_of(struct device *device, const struct body *body, const struct rays *rays,
                           enum walk walk, uint32_t wanted)
{
    float depth[PIXELS];
    uint32_t leaf[PIXELS], face[PIXELS];
    struct surface_image image = {SIDE, SIDE, depth, leaf, face};
    struct render_settings settings = {.epsilon = 1e-3, .threads = 1, .walk = walk};
    struct error why;
    device_first_surface(device, body, rays, &settings, &image, NULL, NULL, NULL);
    assert_false(device_failed(device, &why));
    for (int i = 0; i < PIXELS; i++) {
        if (leaf[i] != wanted)
            print_error("walk %d, pixel %d\n", (int)walk, i);
        assert_int_equal(leaf[i], wanted);
    }
}

struct scene {
    struct csg_tree tree;
    struct model model;
    struct solid_store *store;
};

static void scene_make(struct scene *s, const char *text)
{
    struct messages messages = {0};
    size_t size = strlen(text);
    char *copy = mem_zalloc(size + 2);
    memcpy(copy, text, size);
    assert_true(csg_parse(&s->tree, "owners.csg", copy, size, &messages));
    struct model_options options = MODEL_DEFAULTS;
    s->store = solid_store_new();
    model_build(&s->model, &s->tree, s->store, &options, &messages);
    assert_int_equal(messages.count, 0);
    messages_free(&messages);
    free(copy);
}

static void scene_free(struct scene *s)
{
    model_free(&s->model);
    solid_store_delete(s->store);
    csg_free(&s->tree);
}

// The one on the processor, and the gl device where there is one.
static struct device *devices[2];

static void expect_leaf(const char *text, uint32_t wanted)
{
    struct scene s;
    scene_make(&s, text);
    for (int lean = 0; lean < 2; lean++)
        for (int orthographic = 0; orthographic < 2; orthographic++)
            for (int walk = WALK_AUTO; walk <= WALK_HASH; walk++)
                for (int d = 0; d < 2 && devices[d]; d++) {
                    struct rays rays = rays_down(lean * 0.3, orthographic);
                    expect_leaf_of(devices[d], &s.model.bodies[0], &rays, (enum walk)walk, wanted);
                }
    scene_free(&s);
}

static void expect_end(void *context, uint32_t worker, const struct span_block *block)
{
    const uint32_t *wanted = context;
    (void)worker;
    uint32_t pixels = (uint32_t)((block->x1 - block->x0) * (block->y1 - block->y0));
    for (uint32_t i = 0; i < pixels; i++) {
        assert_int_equal(block->first[i + 1] - block->first[i], 1);
        assert_int_equal(block->spans[block->first[i]].leave_leaf, *wanted);
    }
}

// Whose the end of the only span is when rays end at z = -10.
static void expect_end_of(const char *text, uint32_t wanted)
{
    struct scene s;
    struct error why;
    scene_make(&s, text);
    for (int orthographic = 0; orthographic < 2; orthographic++)
        for (int d = 0; d < 2 && devices[d]; d++) {
            struct rays rays = rays_down(0, orthographic);
            struct render_settings settings = {.epsilon = 1e-3, .threads = 1};
            rays.far = 60;
            device_spans(devices[d], &s.model.bodies[0], &rays, &settings, expect_end, &wanted,
                         NULL);
            assert_false(device_failed(devices[d], &why));
        }
    scene_free(&s);
}

// A block of 10 x 10 from z to z + height.
#define BLOCK(z, height)                                                                           \
    "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1," #z "],[0,0,0,1]]) cube(size=[10,10," #height "]);"

static void a_union_begins_where_an_operand_does(void **state)
{
    (void)state;
    expect_leaf("intersection(){" BLOCK(-10, 10) "union(){" BLOCK(-9, 4) BLOCK(-4, 4) "}}", 2);
    expect_leaf("intersection(){" BLOCK(-10, 10) "union(){" BLOCK(-9, 4) BLOCK(-4, 3.9999999) "}}",
                2);
    expect_leaf("intersection(){union(){" BLOCK(-9, 4) BLOCK(-4, 4) "}" BLOCK(-10, 10) "}", 2);
}

static void a_cut_ends_where_a_solid_begins(void **state)
{
    (void)state;
    expect_leaf("difference(){union(){" BLOCK(-4, 4) BLOCK(3, 1) "}" BLOCK(0, 5) "}", 2);
    expect_leaf("difference(){" BLOCK(-4, 4) BLOCK(0, 5) BLOCK(0, 6) "}", 2);
}

static void what_begins_inside_does_not_count(void **state)
{
    (void)state;
    expect_leaf("intersection(){" BLOCK(-10, 10) "union(){" BLOCK(-10, 15) BLOCK(-5, 5) "}}", 0);
    expect_leaf("difference(){" BLOCK(-10, 10) "difference(){union(){" BLOCK(-20, 23)
                    BLOCK(0, 5) "}" BLOCK(-30, 34) "}}",
                0);
}

static void several_parts_share_a_plane(void **state)
{
    (void)state;
    expect_leaf("union(){" BLOCK(-3, 3) BLOCK(-2, 2) BLOCK(-1, 1) "}", 2);
    expect_leaf("union(){intersection(){" BLOCK(-3, 3) BLOCK(-2, 2) "}" BLOCK(-1, 1) "}", 2);
}

// Where a cut begins with what it cuts, nothing shows of that, unless it shares the plane of others
// and is a later one.
static void what_is_cut_at_once_does_not_hide_others(void **state)
{
    (void)state;
    // leaf 1 is inside of leaf 2, which ends here, and leaf 3 begins
    expect_leaf("union(){" BLOCK(-3, 3) "difference(){" BLOCK(-9, 9) BLOCK(0, 5) BLOCK(-6, 6) "}}",
                0);
    expect_leaf("union(){" BLOCK(-3, 3) "difference(){" BLOCK(-9, 9) BLOCK(-6, 6) "}}", 1);
}

// Each pair is left in one plane, and one of each would do: none matters alone.
static void of_several_that_turn_it_together_the_latest_shows(void **state)
{
    (void)state;
    expect_leaf("difference(){" BLOCK(-9, 9) "intersection(){" BLOCK(-3, 4)
                    BLOCK(-3, 5) "}"
                                 "intersection(){" BLOCK(-3, 6) BLOCK(-3, 7) "}}",
                4);
    expect_leaf("difference(){" BLOCK(-9, 9) "intersection(){" BLOCK(-3, 4)
                    BLOCK(-3, 5) "}"
                                 "intersection(){" BLOCK(-2.9999999, 6) BLOCK(-3.0000001, 7) "}}",
                4);
    expect_leaf("intersection(){" BLOCK(-20, 25) "union(){intersection(){" BLOCK(-4, 4)
                    BLOCK(-5, 5) "}intersection(){" BLOCK(-6, 6) BLOCK(-7, 7) "}}}",
                4);
}

static void nothing_thin_begins_where_rays_end(void **state)
{
    (void)state;
    expect_end_of("union(){" BLOCK(-20, 20) BLOCK(-30, 20.0001) "}", SURFACE_NONE);
    expect_end_of("union(){" BLOCK(-20, 20) "difference(){" BLOCK(-40, 40) BLOCK(-30, 20.0001) "}}",
                  SURFACE_NONE);
    expect_end_of("difference(){" BLOCK(-20, 20) BLOCK(-30, 20.0001) "}", 1);
    expect_end_of("union(){" BLOCK(-9, 9) BLOCK(-30, 20.0001) "}", 0);
    expect_end_of(BLOCK(-10, 10), SURFACE_NONE);
}

// Where rays of the first row leave a plate that is too thin to exist and enter a block, its face,
// seen from the front, is as far away as the plate is thick: one depth, and not thin.
static void what_is_at_one_depth_stays_together(void **state)
{
#define PLATE "multmatrix([[1,0,0,0],[0,1,0,0],[0,8,1,-40],[0,0,0,1]]) cube(size=[10,10,0.003]);"
    static const char *const texts[] = {"union(){" PLATE BLOCK(-5, 5) "}",
                                        "union(){" BLOCK(-5, 5) PLATE "}"};
    (void)state;
    for (uint32_t plate = 0; plate < 2; plate++) {
        struct scene s;
        scene_make(&s, texts[plate]);
        for (int k = 0; k < 4 && devices[k / 2]; k++) {
            float depth[PIXELS];
            uint32_t leaf[PIXELS], face[PIXELS];
            struct surface_image image = {SIDE, SIDE, depth, leaf, face};
            struct rays rays = rays_down(0, true);
            struct render_settings settings = {
                .epsilon = 1e-3, .threads = 1, .walk = k % 2 ? WALK_HASH : WALK_AUTO};
            device_first_surface(devices[k / 2], &s.model.bodies[0], &rays, &settings, &image, NULL,
                                 NULL, NULL);
            for (int i = 0; i < SIDE; i++)
                assert_int_equal(leaf[i], plate);
        }
        scene_free(&s);
    }
}

int main(void)
{
    struct error err;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_union_begins_where_an_operand_does),
        cmocka_unit_test(a_cut_ends_where_a_solid_begins),
        cmocka_unit_test(what_begins_inside_does_not_count),
        cmocka_unit_test(several_parts_share_a_plane),
        cmocka_unit_test(what_is_cut_at_once_does_not_hide_others),
        cmocka_unit_test(of_several_that_turn_it_together_the_latest_shows),
        cmocka_unit_test(nothing_thin_begins_where_rays_end),
        cmocka_unit_test(what_is_at_one_depth_stays_together),
    };
    devices[0] = cpu_device_new();
    devices[1] = gl_device_new(true, NULL, &err);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_delete(devices[0]);
    device_delete(devices[1]);
    return failed;
}
