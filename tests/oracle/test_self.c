// test_self.c - the oracle against cases whose answer is known by hand.
#include "oracle.h"
#include "random_tree.h"
#include "shapes.h"

#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>

struct bench {
    struct mesh mesh[8];
    struct oracle_leaf leaves[8];
    uint32_t leaf_count;
    struct rays rays;
    struct oracle oracle;
    struct oracle_ray ray;
    struct oracle_answer answer;
};

// Parallel rays down the z axis: a depth d is the height -d.
static struct rays down(void)
{
    return (struct rays){.orthographic = true,
                         .forward = {0, 0, -1},
                         .step_x = {1, 0, 0},
                         .step_y = {0, -1, 0},
                         .near = -1000,
                         .far = 1000};
}

static void add(struct bench *b, enum shape shape, struct vec3 size, struct vec3 at)
{
    shape_make(&b->mesh[b->leaf_count], shape, 8);
    b->leaves[b->leaf_count] =
        (struct oracle_leaf){&b->mesh[b->leaf_count],
                             {{{size.x, 0, 0, at.x}, {0, size.y, 0, at.y}, {0, 0, size.z, at.z}}}};
    b->leaf_count++;
}

static void shoot(struct bench *b, const struct expr_token *tokens, size_t count, double epsilon,
                  double x, double y)
{
    oracle_init(&b->oracle, b->leaves, b->leaf_count, tokens, count);
    oracle_cast(&b->oracle, &b->rays, x, y, &b->ray);
    oracle_spans(&b->ray, epsilon, &b->answer);
}

static void finish(struct bench *b)
{
    oracle_free(&b->oracle);
    oracle_ray_free(&b->ray);
    oracle_answer_free(&b->answer);
    for (uint32_t i = 0; i < b->leaf_count; i++)
        shape_free(&b->mesh[i]);
}

static void assert_span(const struct bench *b, uint32_t i, double enter, double leave)
{
    assert_true(i < b->answer.count);
    assert_true(fabs(b->answer.spans[i].enter.low - enter) < 1e-9);
    assert_true(fabs(b->answer.spans[i].leave.high - leave) < 1e-9);
}

static const struct expr_token two_less[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_DIFFERENCE, 2}};
static const struct expr_token two_more[] = {{EXPR_LEAF, 0}, {EXPR_LEAF, 1}, {EXPR_UNION, 2}};

static void cube_minus_cube(void **state)
{
    (void)state;
    struct bench b = {.rays = down()};
    add(&b, SHAPE_CUBE, (struct vec3){10, 10, 10}, (struct vec3){0, 0, 0});
    add(&b, SHAPE_CUBE, (struct vec3){4, 4, 4}, (struct vec3){0, 0, 0});
    shoot(&b, two_less, 3, 1e-3, 0.3, 0.1);
    assert_int_equal(b.answer.count, 2);
    assert_span(&b, 0, -5, -2);
    assert_span(&b, 1, 2, 5);
    oracle_free(&b.oracle);
    shoot(&b, two_less, 3, 1e-3, 3, 0.1);
    assert_int_equal(b.answer.count, 1);
    assert_span(&b, 0, -5, 5);
    finish(&b);
}

static void nested_and_empty_operands(void **state)
{
    (void)state;
    static const struct expr_token tokens[] = {
        {EXPR_LEAF, 0},  {EXPR_LEAF, 1},         {EXPR_LEAF, 2},  {EXPR_UNION, 0},
        {EXPR_UNION, 1}, {EXPR_INTERSECTION, 1}, {EXPR_UNION, 2}, {EXPR_DIFFERENCE, 3},
    };
    struct bench b = {.rays = down()};
    add(&b, SHAPE_CUBE, (struct vec3){10, 10, 10}, (struct vec3){0, 0, 0});
    add(&b, SHAPE_CUBE, (struct vec3){1, 1, 4}, (struct vec3){0, 0, 0});
    add(&b, SHAPE_CUBE, (struct vec3){2, 2, 1}, (struct vec3){0, 0, 4});
    shoot(&b, tokens, array_count(tokens), 1e-3, 0.3, 0.1);
    assert_int_equal(b.answer.count, 3);
    assert_span(&b, 0, -5, -4.5);
    assert_span(&b, 1, -3.5, -2);
    assert_span(&b, 2, 2, 5);
    finish(&b);
}

static void coincident_faces_leave_no_skin(void **state)
{
    (void)state;
    struct bench b = {.rays = down()};
    add(&b, SHAPE_CUBE, (struct vec3){10, 10, 10}, (struct vec3){0, 0, 0});
    add(&b, SHAPE_CUBE, (struct vec3){4, 4, 10}, (struct vec3){0, 0, 1e-7});
    shoot(&b, two_less, 3, 1e-3, 0.3, 0.1);
    assert_int_equal(b.answer.count, 0);
    assert_int_equal(b.ray.boundary_count, 2);
    oracle_free(&b.oracle);
    b.leaves[1].to_world.m[2][3] = 10 + 1e-7; // stacked with a gap that is none
    shoot(&b, two_more, 3, 1e-3, 0.3, 0.1);
    assert_int_equal(b.answer.count, 1);
    assert_span(&b, 0, -15 - 1e-7, 5);
    finish(&b);
}

static void thickness_is_measured_across_faces(void **state)
{
    (void)state;
    struct bench b = {.rays = down()};
    add(&b, SHAPE_CUBE, (struct vec3){10, 10, 5e-4}, (struct vec3){0, 0, 0});
    b.rays.forward = (struct vec3){1, 0, -0.001}; // grazing: 0.5 mm along the ray
    b.rays.origin = (struct vec3){0, 0, 0};
    b.rays.step_y = (struct vec3){0, 0, 1};
    static const struct expr_token one[] = {{EXPR_LEAF, 0}};
    shoot(&b, one, 1, 1e-3, 0, 0);
    assert_int_equal(b.answer.count, 0);
    oracle_free(&b.oracle);
    shoot(&b, one, 1, 1e-4, 0, 0);
    assert_int_equal(b.answer.count, 1);
    finish(&b);
}

static void solid_at_near_and_far(void **state)
{
    (void)state;
    struct bench b = {.rays = down()};
    add(&b, SHAPE_CUBE, (struct vec3){10, 10, 10}, (struct vec3){0, 0, 0});
    add(&b, SHAPE_CUBE, (struct vec3){4, 4, 4}, (struct vec3){0, 0, 0});
    b.rays.orthographic = false;
    b.rays.origin = (struct vec3){0, 0, 4};
    b.rays.near = 0.5;
    b.rays.far = 8;
    shoot(&b, two_less, 3, 1e-3, 0.01, 0.02);
    assert_int_equal(b.answer.count, 2);
    assert_span(&b, 0, 0.5, 2);
    assert_span(&b, 1, 6, 8);
    assert_int_equal(b.answer.spans[0].enter.at->kind, BOUND_NEAR);
    assert_int_equal(b.answer.spans[1].leave.at->kind, BOUND_FAR);
    finish(&b);
}

// Rays through corners, along edges and in the planes of faces cross every closed mesh
// consistently.
static void exact_hits_of_edges_stay_closed(void **state)
{
    (void)state;
    static const struct expr_token one[] = {{EXPR_LEAF, 0}};
    for (int shape = 0; shape < SHAPES; shape++)
        for (int view = 0; view < 4; view++) {
            struct bench b = {.rays = down()};
            add(&b, (enum shape)shape, (struct vec3){view % 2 ? -8 : 8, 8, 8},
                (struct vec3){0, 0, 0});
            if (view > 1)
                b.rays.forward = (struct vec3){0, -1, -1};
            oracle_init(&b.oracle, b.leaves, 1, one, 1);
            for (double x = -4.5; x <= 4.5; x += 0.25)
                for (double y = -4.5; y <= 4.5; y += 0.25) {
                    oracle_cast(&b.oracle, &b.rays, x, y, &b.ray);
                    assert_int_equal(b.ray.open_leaves, 0);
                    assert_int_equal(b.ray.crossing_count % 2, 0);
                    for (uint32_t i = 0; i < b.ray.boundary_count; i++)
                        assert_true(fabs(b.ray.boundaries[i].depth) < 9);
                }
            for (uint32_t i = 0; i < b.mesh[0].vertex_count; i++) {
                struct vec3 v = b.oracle.leaves[0].vertices[i];
                oracle_cast(&b.oracle, &b.rays, v.x, -v.y, &b.ray);
                assert_int_equal(b.ray.open_leaves, 0);
            }
            finish(&b);
        }
}

// Volumes by rays: a convex solid's crossings agree with its faces' planes, a torus has its volume.
static void volumes_agree_with_formulas(void **state)
{
    (void)state;
    static const struct expr_token one[] = {{EXPR_LEAF, 0}};
    static const double expected[SHAPES] = {1, -1, 0.70710678, -1, 0.70710678 / 3, 0.64, -1, -1};
    for (int shape = 0; shape < SHAPES; shape++) {
        struct bench b = {.rays = down()};
        add(&b, (enum shape)shape, (struct vec3){1, 1, 1}, (struct vec3){0, 0, 0});
        oracle_init(&b.oracle, b.leaves, 1, one, 1);
        double by_rays = 0, by_mesh = 0;
        const struct mesh *m = &b.mesh[0];
        for (uint32_t i = 0; i < m->triangle_count; i++) {
            const uint32_t *t = m->triangles[i];
            by_mesh +=
                vec3_dot(m->vertices[t[0]], vec3_cross(m->vertices[t[1]], m->vertices[t[2]])) / 6;
        }
        const int n = 100;
        for (int i = 0; i < n * n; i++) {
            oracle_cast(&b.oracle, &b.rays, (i % n + 0.5) / n - 0.5, (i / n + 0.5) / n - 0.5,
                        &b.ray);
            oracle_spans(&b.ray, 0, &b.answer);
            for (uint32_t k = 0; k < b.answer.count; k++)
                by_rays += b.answer.spans[k].leave.low - b.answer.spans[k].enter.low;
        }
        assert_true(by_mesh > 0);
        assert_true(fabs(by_rays / (n * n) - by_mesh) < 0.01 * by_mesh);
        if (expected[shape] > 0)
            assert_true(fabs(by_mesh - expected[shape]) < 1e-6);
        finish(&b);
    }
}

static void random_scenes_are_closed_and_varied(void **state)
{
    (void)state;
    uint32_t hits = 0, pixels = 0, caps = 0, far = 0;
    for (uint64_t seed = 0; seed < 60; seed++) {
        struct random_scene s;
        random_scene_make(&s, seed);
        struct oracle_leaf *leaves = calloc(s.leaf_count + 1, sizeof *leaves);
        for (uint32_t i = 0; i < s.leaf_count; i++)
            leaves[i] =
                (struct oracle_leaf){&s.meshes[s.leaves[i].mesh].mesh, s.leaves[i].to_world};
        struct oracle o;
        struct oracle_ray ray = {0};
        oracle_init(&o, leaves, s.leaf_count, s.tokens, s.token_count);
        for (int i = 0; i < s.rays.width * s.rays.height; i += 7) {
            oracle_cast(&o, &s.rays, i % s.rays.width, i / s.rays.width, &ray);
            assert_int_equal(ray.open_leaves, 0);
            assert_int_equal(ray.boundary_count % 2, 0);
            pixels++;
            hits += ray.boundary_count > 0;
            caps += ray.boundary_count && ray.boundaries[0].kind == BOUND_NEAR;
            far += ray.boundary_count && ray.boundaries[ray.boundary_count - 1].kind == BOUND_FAR;
        }
        oracle_ray_free(&ray);
        oracle_free(&o);
        free(leaves);
        random_scene_free(&s);
    }
    print_message("%u rays: %u hit, %u start in solid, %u end in solid\n", pixels, hits, caps, far);
    assert_true(hits > pixels / 10 && hits < pixels && caps > 0 && far > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_minus_cube),
        cmocka_unit_test(nested_and_empty_operands),
        cmocka_unit_test(coincident_faces_leave_no_skin),
        cmocka_unit_test(thickness_is_measured_across_faces),
        cmocka_unit_test(solid_at_near_and_far),
        cmocka_unit_test(exact_hits_of_edges_stay_closed),
        cmocka_unit_test(volumes_agree_with_formulas),
        cmocka_unit_test(random_scenes_are_closed_and_varied),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
