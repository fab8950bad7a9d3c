// test_owners.c - whose face shows where several lie in one plane: the latest of those that matter,
// whichever way the device takes.
#include "csg/csg.h"
#include "render/device.h"

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

static void expect_leaf_of(const struct body *body, const struct rays *rays, enum walk walk,
                           uint32_t wanted)
{
    float depth[PIXELS];
    uint32_t leaf[PIXELS], face[PIXELS];
    struct surface_image image = {SIDE, SIDE, depth, leaf, face};
    struct render_settings settings = {.epsilon = 1e-3, .threads = 1, .walk = walk};
    struct render_stats stats;
    struct device *device = cpu_device_new();
    device_first_surface(device, body, rays, &settings, &image, NULL, NULL, &stats);
    device_delete(device);
    for (int i = 0; i < PIXELS; i++) {
        if (leaf[i] != wanted)
            print_error("walk %d, pixel %d\n", (int)walk, i);
        assert_int_equal(leaf[i], wanted);
    }
}

static void expect_leaf(const char *text, uint32_t wanted)
{
    struct messages messages = {0};
    struct csg_tree tree;
    struct model model;
    size_t size = strlen(text);
    char *copy = mem_zalloc(size + 2);
    memcpy(copy, text, size);
    assert_true(csg_parse(&tree, "owners.csg", copy, size, &messages));
    struct model_options options = MODEL_DEFAULTS;
    struct solid_store *store = solid_store_new();
    model_build(&model, &tree, store, &options, &messages);
    assert_int_equal(messages.count, 0);
    for (int lean = 0; lean < 2; lean++)
        for (int orthographic = 0; orthographic < 2; orthographic++)
            for (int walk = WALK_AUTO; walk <= WALK_HASH; walk++) {
                struct rays rays = rays_down(lean * 0.3, orthographic);
                expect_leaf_of(&model.bodies[0], &rays, (enum walk)walk, wanted);
            }
    messages_free(&messages);
    model_free(&model);
    solid_store_delete(store);
    csg_free(&tree);
    free(copy);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_union_begins_where_an_operand_does),
        cmocka_unit_test(a_cut_ends_where_a_solid_begins),
        cmocka_unit_test(what_begins_inside_does_not_count),
        cmocka_unit_test(several_parts_share_a_plane),
        cmocka_unit_test(what_is_cut_at_once_does_not_hide_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
