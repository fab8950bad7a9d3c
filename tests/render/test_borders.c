// test_borders.c - whose face geometry shows where faces meet: as CGAL marks it, that of a cut
// wherever the place is outside of the solid with all borders.
#include "unit.h"

#define AT(x, y, z) "multmatrix([[1,0,0," #x "],[0,1,0," #y "],[0,0,1," #z "],[0,0,0,1]]) "
#define CUT         "difference() { cube(10); " AT(0, 0, 5) "cube(10); } "

enum { SIZE = 64 };

// Looks at the scene from a side and compares whether there is a cut at all places of [low, high)
// of both axes of the picture, in mm.
struct patch {
    double u0, u1, v0, v1;
    bool cut;
};

static void expect(const char *text, struct vec3 ahead, struct vec3 right, const struct patch *p,
                   size_t count)
{
    struct stage s;
    static const enum walk walks[] = {WALK_AUTO, WALK_HASH};
    float depth[SIZE * SIZE];
    uint32_t leaf[SIZE * SIZE], face[SIZE * SIZE];
    struct surface_image image = {.depth = depth, .leaf = leaf, .face = face};
    struct vec3 up = vec3_cross(right, ahead);
    double pixel = 20.0 / SIZE;
    stage_make_as(&s, MODEL_RENDER, text);
    struct rays rays = {.orthographic = true,
                        .forward = ahead,
                        .step_x = vec3_scale(right, pixel),
                        .step_y = vec3_scale(up, pixel),
                        .width = SIZE,
                        .height = SIZE,
                        .far = 100,
                        .reference = 40};
    rays.origin = vec3_add(vec3_scale(ahead, -40), vec3_scale(vec3_add(right, up), pixel / 2));
    for (int w = 0; w < 2; w++) {
        struct render_stats stats;
        s.settings.walk = walks[w];
        device_first_surface(s.device, &s.model.bodies[0], &rays, &s.settings, &image, NULL, NULL,
                             &stats);
        for (int i = 0; i < SIZE * SIZE; i++) {
            double u = (i % SIZE + 0.5) * pixel, v = (i / SIZE + 0.5) * pixel;
            for (size_t k = 0; k < count; k++)
                if (u > p[k].u0 && u < p[k].u1 && v > p[k].v0 && v < p[k].v1) {
                    assert_true(leaf[i] != SURFACE_NONE);
                    if (s.model.bodies[0].leaves[leaf[i]].subtracted != p[k].cut)
                        fail_msg("%s at %g, %g: %d", text, u, v, !p[k].cut);
                }
        }
    }
    stage_free(&s);
}
#define EXPECT(text, ahead, right, ...)                                                            \
    expect(text, ahead, right, (const struct patch[]){__VA_ARGS__},                                \
           sizeof((const struct patch[]){__VA_ARGS__}) / sizeof(struct patch))

static const struct vec3 down = {0, 0, -1}, x_axis = {1, 0, 0}, y_axis = {0, 1, 0},
                         back = {-1, 0, 0};

static void unions_show_material(void **state)
{
    (void)state;
    // The floor of the cut is flush with a cube's top: that wins, first or last.
    EXPECT("cube(5); " CUT, down, x_axis, {0, 5, 0, 5, false}, {5, 10, 0, 10, true});
    EXPECT(CUT "cube(5);", down, x_axis, {0, 5, 0, 5, false}, {5, 10, 0, 10, true});
    EXPECT("union() { cube(5); union() { " CUT "sphere(1); } }", down, x_axis, {0, 5, 0, 5, false},
           {0, 5, 5, 10, true});
}

static void intersections_show_cuts(void **state)
{
    (void)state;
    EXPECT("intersection() { " CUT "cube([8, 8, 5]); }", down, x_axis, {0, 8, 0, 8, true});
    EXPECT("intersection() { cube([8, 8, 5]); " CUT "}", down, x_axis, {0, 8, 0, 8, true});
}

static void what_only_touches_cuts_the_border(void **state)
{
    (void)state;
    EXPECT("difference() { cube(10); " AT(10, 2, 2) "cube(5); }", back, y_axis, {2, 7, 2, 7, true},
           {7, 10, 7, 10, false}, {0, 2, 0, 10, false});
}

static void what_is_spared_is_material(void **state)
{
    (void)state;
    // A - (B - C): the walls of C inside of A, and where C ends flush with A.
    EXPECT("difference() { cube(10); difference() { " AT(2, 2, 2) "cube(20); " AT(
               4, 4, 0) "cube([3, 3, 10]); } }",
           down, x_axis, {0, 10, 0, 2, false}, {2, 10, 2, 4, true}, {4, 7, 4, 7, false});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unions_show_material),
        cmocka_unit_test(intersections_show_cuts),
        cmocka_unit_test(what_only_touches_cuts_the_border),
        cmocka_unit_test(what_is_spared_is_material),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
