// test_thin.c - plates just thick enough to exist, and faces alone, seen through pixels that are
// not square.
#include "unit.h"

enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT };
static const double epsilon = 1e-3;

// Rays around the origin of the world along `direction`.
static struct rays rays_along(struct vec3 direction, bool orthographic, double width, double height)
{
    struct rays r = {.orthographic = orthographic, .width = WIDTH, .height = HEIGHT};
    double distance = 40, scale = orthographic ? 1 : 1 / distance;
    r.forward = vec3_normalized(direction);
    struct vec3 right = vec3_normalized(vec3_cross(r.forward, (struct vec3){0, 1, 0}));
    r.step_x = vec3_scale(right, width * scale);
    r.step_y = vec3_scale(vec3_cross(r.forward, right), height * scale);
    r.origin = vec3_scale(r.forward, -distance);
    struct vec3 corner =
        vec3_add(vec3_scale(r.step_x, -0.5 * WIDTH), vec3_scale(r.step_y, -0.5 * HEIGHT));
    if (orthographic)
        r.origin = vec3_add(r.origin, corner);
    else
        r.forward = vec3_add(r.forward, corner);
    r.near = 1;
    r.far = 1000;
    r.reference = distance;
    return r;
}

static void count_spans(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    uint32_t n = (uint32_t)((block->x1 - block->x0) * (block->y1 - block->y0)), *count = context;
    for (uint32_t i = 0; i < n; i++)
        *count += block->first[i + 1] - block->first[i] == 1;
}

static void expect_plate(const char *text, uint32_t seen)
{
    static const struct vec3 directions[] = {{0, 0, -1}, {0.9, 0.1, -0.2}, {0.1, 0.9, -0.2}};
    static const double sizes[][2] = {{0.1, 0.1}, {0.1, 0.01}, {0.01, 0.1}};
    struct render_settings settings = {.epsilon = epsilon, .threads = 1};
    struct stage s;
    stage_make(&s, text);
    for (size_t d = 0; d < array_count(directions); d++)
        for (size_t k = 0; k < array_count(sizes); k++)
            for (int orthographic = 0; orthographic < 2; orthographic++) {
                struct rays rays =
                    rays_along(directions[d], orthographic, sizes[k][0], sizes[k][1]);
                uint32_t count = 0;
                device_spans(s.device, &s.model.bodies[0], &rays, &settings, count_spans, &count,
                             NULL);
                if (count != seen)
                    print_error("%s\ndirection %zu, pixels %g x %g, %s\n", text, d, sizes[k][0],
                                sizes[k][1], orthographic ? "orthographic" : "perspective");
                assert_int_equal(count, seen);
            }
    stage_free(&s);
}

static void thick_enough(void **state)
{
    (void)state;
    expect_plate("cube(size=[200,200,0.0011], center=true);", PIXELS);
    expect_plate("cube(size=[200,200,0.0009], center=true);", 0);
}

static void meshes_are_measured_alike(void **state)
{
    (void)state;
#define BOTTOM "[-90,-90,0],[90,-90,0],[90,90,0],[-90,90,0],"
#define FACES  "faces=[[3,2,1,0],[5,6,7,4],[1,5,4,0],[2,6,5,1],[3,7,6,2],[0,4,7,3]]);"
    expect_plate("polyhedron(points=[" BOTTOM "[-90,-90,0.0011],[90,-90,0.0011],[90,90,0.0011],"
                 "[-90,90,0.0011]]," FACES,
                 PIXELS);
    expect_plate("polyhedron(points=[" BOTTOM "[-90,-90,0.0009],[90,-90,0.0009],[90,90,0.0009],"
                 "[-90,90,0.0009]]," FACES,
                 0);
}

// A ray crosses them once, which closes nothing.
static void faces_of_open_meshes_show(void **state)
{
    (void)state;
    expect_plate("polyhedron(points=[[-90,-90,0],[90,-90,0],[90,90,0],[-90,90,0]],"
                 "faces=[[3,2,1,0]]);",
                 PIXELS);
    expect_plate("polyhedron(points=[[-90,-90,0],[90,-90,0],[90,90,0],[-90,90,0]],"
                 "faces=[[0,1,2,3]]);",
                 PIXELS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thick_enough),
        cmocka_unit_test(meshes_are_measured_alike),
        cmocka_unit_test(faces_of_open_meshes_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
