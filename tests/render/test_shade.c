// test_shade.c - lit colours against those measured on OpenSCAD's pictures.
#include "render/shade.h"

#include "render/camera.h"
#include "render/device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

#define UNSET                                                                                      \
    {                                                                                              \
        -1, -1, -1, -1                                                                             \
    }

enum { LEFT, RIGHT, FRONT, BACK, BOTTOM, TOP }; // planes of the cube below

static double nx[8] = {-1, 1, 0, 0, 0, 0, -1, -1}, ny[8] = {0, 0, -1, 1},
              nz[8] = {0, 0, 0, 0, -1, 1}, plane_d[8] = {0, 1, 0, 1, 0, 1};
static const struct solid cube = {.convex = true, .planes = {nx, ny, nz, plane_d, 6, 8}};

// A square of two triangles that are one face, with a triangle of no area first, and one more face.
static struct vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
static uint32_t triangles[][3] = {{0, 1, 1}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
static uint32_t faces[] = {0, 0, 0, 1}, own_faces[] = {0, 1, 2, 3};
static const struct solid merged = {.mesh = {.vertices = corners,
                                             .vertex_count = 5,
                                             .triangles = triangles,
                                             .faces = faces,
                                             .triangle_count = 4,
                                             .face_count = 2}};
static const struct solid plain = {.mesh = {.vertices = corners,
                                            .vertex_count = 5,
                                            .triangles = triangles,
                                            .faces = own_faces,
                                            .triangle_count = 4,
                                            .face_count = 4}};

static struct leaf place(const struct solid *solid, struct affine to_world)
{
    struct leaf leaf = {.solid = solid, .to_world = to_world, .colour = UNSET};
    assert_true(affine_inverse(&to_world, &leaf.to_local));
    return leaf;
}

// A model of one body whose leaves form one union.
struct scene {
    struct leaf leaves[4];
    struct expr_node nodes[5];
    uint32_t kids[4], leaf_node[4];
    struct body body;
    struct model model;
    struct shader shader;
    struct light light;
};

static void scene_finish(struct scene *s, uint32_t leaves, enum body_kind kind)
{
    for (uint32_t i = 0; i < leaves; i++) {
        s->nodes[i] = (struct expr_node){.op = EXPR_LEAF,
                                         .parent = leaves > 1 ? leaves : EXPR_NONE,
                                         .minus = EXPR_NONE,
                                         .leaf = i};
        s->kids[i] = s->leaf_node[i] = i;
    }
    s->nodes[leaves] = (struct expr_node){
        .op = EXPR_UNION, .parent = EXPR_NONE, .count = leaves, .minus = EXPR_NONE};
    uint32_t nodes = leaves > 1 ? leaves + 1 : 1;
    s->body = (struct body){.kind = kind, .leaves = s->leaves, .leaf_count = leaves};
    s->body.expr = (struct expr){.nodes = s->nodes,
                                 .node_count = nodes,
                                 .kids = s->kids,
                                 .kid_count = leaves,
                                 .root = nodes - 1,
                                 .leaf_node = s->leaf_node,
                                 .leaf_count = leaves};
    s->model = (struct model){.bodies = &s->body, .body_count = 1};
    uint32_t count;
    shader_init(&s->shader, &s->model, scheme_list(&count));
    struct camera c = CAMERA_DEFAULTS;
    struct rays r = camera_rays(&c, 64, 48, BOX_EMPTY);
    s->light = light_of(&r);
}

static void expect(const struct scene *s, uint32_t leaf, uint32_t face, int r, int g, int b)
{
    struct rgba c = shade_face(&s->shader, 0, &s->light, leaf, face);
    if (c.r != r || c.g != g || c.b != b)
        fail_msg("leaf %u face %u: (%d,%d,%d), not (%d,%d,%d)", leaf, face, c.r, c.g, c.b, r, g, b);
}

static void cube_has_the_measured_colours(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY)}};
    scene_finish(&s, 1, BODY_MAIN);
    expect(&s, 0, RIGHT, 165, 143, 29);
    expect(&s, 0, LEFT, 165, 143, 29);
    expect(&s, 0, TOP, 250, 216, 44);
    expect(&s, 0, FRONT, 143, 123, 25);
    assert_true(s.shader.bodies[0].opaque);
    shader_free(&s.shader);
    shader_free(&s.shader);
}

static void cut_faces_have_the_measured_colours(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY)}};
    s.leaves[0].subtracted = true;
    scene_finish(&s, 1, BODY_MAIN);
    expect(&s, 0, LEFT, 104, 135, 54);
    expect(&s, 0, TOP, 158, 204, 81);
    shader_free(&s.shader);
}

static void scaling_and_mirroring_do_not_dim(void **state)
{
    (void)state;
    struct affine a = {{{-7, 0, 0, 3}, {0, 0.01, 0, 4}, {0, 0, 1000, 5}}};
    struct scene s = {.leaves = {place(&cube, a)}};
    scene_finish(&s, 1, BODY_MAIN);
    expect(&s, 0, RIGHT, 165, 143, 29);
    expect(&s, 0, TOP, 250, 216, 44);
    expect(&s, 0, FRONT, 143, 123, 25);
    shader_free(&s.shader);
}

static void sheared_normals_stay_perpendicular(void **state)
{
    (void)state;
    struct affine a = {{{1, 0, 5, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    struct scene s = {.leaves = {place(&cube, a)}};
    scene_finish(&s, 1, BODY_MAIN);
    expect(&s, 0, TOP, 250, 216, 44); // the top is still level
    shader_free(&s.shader);
}

static void meshes_use_the_normal_of_the_face(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&merged, AFFINE_IDENTITY), place(&plain, AFFINE_IDENTITY),
                                 place(&merged, AFFINE_IDENTITY)}};
    scene_finish(&s, 3, BODY_MAIN);
    assert_int_equal(s.shader.normals.mesh_count, 2);
    for (uint32_t leaf = 0; leaf < 3; leaf += 2) {
        expect(&s, leaf, 0, 250, 216, 44);
        expect(&s, leaf, 1, 165, 143, 29);
    }
    expect(&s, 1, 2, 250, 216, 44);
    expect(&s, 1, 3, 165, 143, 29);
    expect(&s, 1, 0, 50, 43, 9); // no area, no light
    shader_free(&s.shader);
}

static void cap_looks_at_the_viewer(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY)}};
    scene_finish(&s, 1, BODY_MAIN);
    expect(&s, 0, SURFACE_CAP, 194, 167, 34); // times 0.2 + 1 / sqrt 3
    shader_free(&s.shader);
}

static void set_components_replace_the_stock_ones(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY), place(&cube, AFFINE_IDENTITY)}};
    memcpy(s.leaves[0].colour, (float[4]){1, 0, 0, 1}, sizeof(float[4]));
    s.leaves[1].colour[3] = 0.25f;
    scene_finish(&s, 2, BODY_MAIN);
    expect(&s, 0, TOP, 255, 0, 0);
    expect(&s, 1, TOP, 250, 216, 44);
    assert_false(s.shader.bodies[0].opaque);
    assert_int_equal(s.shader.bodies[0].materials[1].alpha, 64);
    shader_free(&s.shader);
    scene_finish(&s, 2, BODY_BACKGROUND);
    assert_int_equal(s.shader.bodies[0].materials[0].alpha, 255);
    expect(&s, 1, TOP, 181, 181, 181);
    shader_free(&s.shader);
    scene_finish(&s, 2, BODY_HIGHLIGHT);
    assert_int_equal(s.shader.bodies[0].materials[0].alpha, 128);
    expect(&s, 0, TOP, 255, 81, 81);
    shader_free(&s.shader);
}

static void transparent_leaf_that_cannot_show_does_not_matter(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY), place(&cube, AFFINE_IDENTITY)}};
    s.leaves[1].colour[3] = 0.25f;
    scene_finish(&s, 1, BODY_MAIN);
    shader_free(&s.shader);
    s.body.leaf_count = s.body.expr.leaf_count = 2;
    s.leaf_node[1] = EXPR_NONE;
    uint32_t count;
    shader_init(&s.shader, &s.model, scheme_list(&count));
    assert_true(s.shader.bodies[0].opaque);
    shader_free(&s.shader);
}

// (0 - 1) + 2: two parts, only leaf 2 stands alone.
static void parts_are_members_of_the_outermost_union(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY), place(&cube, AFFINE_IDENTITY),
                                 place(&cube, AFFINE_IDENTITY)}};
    scene_finish(&s, 3, BODY_MAIN);
    shader_free(&s.shader);
    struct expr_node nodes[] = {
        {EXPR_LEAF, 2, 0, 0, EXPR_NONE, 0},          {EXPR_LEAF, 2, 0, 0, EXPR_NONE, 1},
        {EXPR_INTERSECTION, 4, 0, 1, 1, 0},          {EXPR_LEAF, 4, 0, 0, EXPR_NONE, 2},
        {EXPR_UNION, EXPR_NONE, 1, 2, EXPR_NONE, 0},
    };
    s.leaf_node[2] = 3;
    s.body.expr.nodes = nodes;
    s.body.expr.node_count = 5;
    s.body.expr.root = 4;
    uint32_t count;
    shader_init(&s.shader, &s.model, scheme_list(&count));
    const struct material *m = s.shader.bodies[0].materials;
    assert_true(m[0].part == m[1].part && m[0].part != m[2].part);
    assert_true(!m[0].alone && !m[1].alone && m[2].alone);
    shader_free(&s.shader);
}

static void cache_answers_as_the_original(void **state)
{
    (void)state;
    struct scene s = {.leaves = {place(&cube, AFFINE_IDENTITY), place(&cube, AFFINE_IDENTITY)}};
    s.leaves[1].subtracted = true;
    scene_finish(&s, 2, BODY_MAIN);
    struct shade_cache cache;
    shade_cache_clear(&cache);
    for (uint32_t i = 0; i < 100; i++) {
        uint32_t leaf = i / 3 % 2, face = i % 7 < 6 ? i % 7 : SURFACE_CAP;
        struct rgba a = shade_cached(&cache, &s.shader, 0, &s.light, leaf, face);
        struct rgba b = shade_face(&s.shader, 0, &s.light, leaf, face);
        assert_memory_equal(&a, &b, sizeof a);
    }
    shader_free(&s.shader);
}

static void light_is_the_same_in_both_projections(void **state)
{
    (void)state;
    struct camera c = {{0, 0, 0}, {10, 20, 30}, 50, 22.5, false};
    struct rays r = camera_rays(&c, 64, 48, BOX_EMPTY);
    struct light a = light_of(&r);
    c.orthographic = true;
    r = camera_rays(&c, 64, 48, BOX_EMPTY);
    struct light b = light_of(&r);
    assert_true(vec3_length(vec3_sub(a.direction, b.direction)) < 1e-12);
    assert_true(vec3_length(vec3_sub(a.view_axis, b.view_axis)) < 1e-12);
    assert_true(fabs(fabs(vec3_dot(a.direction, a.view_axis)) - 1 / sqrt(3)) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_has_the_measured_colours),
        cmocka_unit_test(cut_faces_have_the_measured_colours),
        cmocka_unit_test(scaling_and_mirroring_do_not_dim),
        cmocka_unit_test(sheared_normals_stay_perpendicular),
        cmocka_unit_test(meshes_use_the_normal_of_the_face),
        cmocka_unit_test(cap_looks_at_the_viewer),
        cmocka_unit_test(set_components_replace_the_stock_ones),
        cmocka_unit_test(transparent_leaf_that_cannot_show_does_not_matter),
        cmocka_unit_test(parts_are_members_of_the_outermost_union),
        cmocka_unit_test(cache_answers_as_the_original),
        cmocka_unit_test(light_is_the_same_in_both_projections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
