// test_seams.c - solids that share a flat face: where they meet nothing of their sides may show.
//
// Pixels are much smaller than the filter's epsilon and cross the seam in small steps, so that
// every way to pass it within epsilon comes up.
#include "csg/csg.h"
#include "geom/mesh.h"
#include "render/device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 8, PIXELS = WIDTH * HEIGHT };
static const double epsilon = 1e-3;

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
    assert_true(csg_parse(&s->tree, "seam.csg", copy, size, &messages));
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

// Rays that reach the plane z = 1 around x = 0, steps of epsilon / 16 apart, along `direction`.
static struct rays rays_across(struct vec3 direction, bool orthographic)
{
    struct rays r = {.orthographic = orthographic, .width = WIDTH, .height = HEIGHT};
    double distance = 40, step = epsilon / 16;
    r.forward = vec3_normalized(direction);
    struct vec3 right = vec3_normalized(vec3_cross(r.forward, (struct vec3){0, 1, 0}));
    struct vec3 down = vec3_cross(r.forward, right);
    r.origin = vec3_sub((struct vec3){0, 0.123, 1}, vec3_scale(r.forward, distance));
    if (!orthographic)
        step /= distance;
    r.step_x = vec3_scale(right, step);
    r.step_y = vec3_scale(down, step);
    struct vec3 corner = vec3_add(vec3_scale(r.step_x, -0.5 * (WIDTH - 1) + 0.0123),
                                  vec3_scale(r.step_y, -0.5 * (HEIGHT - 1) + 0.0321));
    if (orthographic)
        r.origin = vec3_add(r.origin, corner);
    else
        r.forward = vec3_add(r.forward, corner);
    r.near = 1;
    r.far = 100;
    r.reference = distance;
    return r;
}

// |z| of the unit normal of a face in the world.
static double upright(const struct leaf *leaf, uint32_t face)
{
    const struct mesh *m = &leaf->solid->mesh;
    uint32_t i = 0;
    while (i < m->triangle_count && m->faces[i] != face)
        i++;
    assert_true(i < m->triangle_count);
    struct vec3 a = m->vertices[m->triangles[i][0]];
    struct vec3 n = vec3_cross(vec3_sub(m->vertices[m->triangles[i][1]], a),
                               vec3_sub(m->vertices[m->triangles[i][2]], a));
    return fabs(vec3_normalized(affine_normal(&leaf->to_local, n)).z);
}

// Sides that show instead of the flat face.
static int sides_seen(const struct body *body, const struct rays *rays, enum walk walk)
{
    float depth[PIXELS];
    uint32_t leaf[PIXELS], face[PIXELS];
    struct surface_image image = {WIDTH, HEIGHT, depth, leaf, face};
    struct render_settings settings = {.epsilon = epsilon, .threads = 1, .walk = walk};
    struct render_stats stats;
    struct device *device = cpu_device_new();
    device_first_surface(device, body, rays, &settings, &image, NULL, NULL, &stats);
    device_delete(device);
    int sides = 0;
    for (int i = 0; i < PIXELS; i++) {
        assert_int_not_equal(leaf[i], SURFACE_NONE);
        assert_int_not_equal(face[i], SURFACE_CAP);
        sides += upright(&body->leaves[leaf[i]], face[i]) < 0.9;
    }
    return sides;
}

static void expect_flat(const char *text)
{
    static const struct vec3 directions[] = {
        {0.3, 0.2, -1}, {-0.3, 0.1, -1}, {0.9, 0.1, -0.3}, {-0.9, -0.2, -0.3}, {0.01, 0, -1}};
    struct scene s;
    scene_make(&s, text);
    for (size_t d = 0; d < array_count(directions); d++)
        for (int orthographic = 0; orthographic < 2; orthographic++)
            for (int walk = WALK_AUTO; walk <= WALK_HASH; walk++) {
                struct rays rays = rays_across(directions[d], orthographic);
                int seen = sides_seen(&s.model.bodies[0], &rays, (enum walk)walk);
                if (seen)
                    print_error("%s\ndirection %zu, %s, walk %d\n", text, d,
                                orthographic ? "orthographic" : "perspective", walk);
                assert_int_equal(seen, 0);
            }
    scene_free(&s);
}

#define LEFT  "multmatrix([[1,0,0,-5],[0,1,0,-5],[0,0,1,0],[0,0,0,1]]) cube(size=[5,10,1]);"
#define RIGHT "multmatrix([[1,0,0,0],[0,1,0,-5],[0,0,1,0],[0,0,0,1]]) cube(size=[5,10,1]);"
#define NEAR  "multmatrix([[1,0,0,0],[0,1,0,-5],[0,0,1,1e-6],[0,0,0,1]]) cube(size=[5,10,1]);"

static void parts_show_no_sides(void **state)
{
    (void)state;
    expect_flat(LEFT RIGHT);
    expect_flat(RIGHT LEFT);
    expect_flat(LEFT NEAR);
}

static void operands_show_no_sides(void **state)
{
    (void)state;
    expect_flat("difference() { union() {" LEFT RIGHT "} cube(size=[9,9,0.5]); }");
    expect_flat("intersection() { union() {" RIGHT LEFT "} cube(size=[20,20,20], center=true); }");
}

static void meshes_show_no_sides(void **state)
{
    (void)state;
    // the same left part as a mesh
    expect_flat(
        "polyhedron(points=[[-5,-5,0],[0,-5,0],[0,5,0],[-5,5,0],[-5,-5,1],[0,-5,1],[0,5,1],"
        "[-5,5,1]],faces=[[0,1,2,3],[4,7,6,5],[0,4,5,1],[1,5,6,2],[2,6,7,3],[3,7,4,0]]);" RIGHT);
}

static void floors_of_cuts_show_no_sides(void **state)
{
    (void)state;
#define UP "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,1],[0,0,0,1]])"
    expect_flat("difference() { cube(size=[20,20,20], center=true); " UP "{" LEFT RIGHT "}" UP
                "multmatrix([[2,0,0,0],[0,2,0,0],[0,0,20,0.5],[0,0,0,1]]) {" LEFT RIGHT "} }");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_show_no_sides),
        cmocka_unit_test(operands_show_no_sides),
        cmocka_unit_test(meshes_show_no_sides),
        cmocka_unit_test(floors_of_cuts_show_no_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
