// test_facets.c - which triangles are drawn of a solid, and how much of a pixel their edges cover.
#include "render/edges.h"
#include "render/facets.h"

#include "geom/mesh.h"
#include "geom/primitives.h"
#include "render/camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

// One leaf, whose solid it is.
struct scene {
    struct solid solid;
    struct leaf leaf;
    struct body body;
    struct model model;
    struct facets *facets;
};

static void scene_make(struct scene *s, struct mesh *m, enum solid_cut cut)
{
    solid_from_mesh(&s->solid, m, true, 0);
    s->solid.cut = cut;
    s->leaf =
        (struct leaf){.solid = &s->solid, .to_world = AFFINE_IDENTITY, .to_local = AFFINE_IDENTITY};
    s->body = (struct body){.leaves = &s->leaf, .leaf_count = 1};
    s->model = (struct model){.bodies = &s->body, .body_count = 1};
    s->facets = facets_new(&s->model);
}

static void scene_free(struct scene *s)
{
    facets_delete(s->facets);
    solid_free(&s->solid);
}

// The face that looks up.
static uint32_t top_of(const struct solid *s)
{
    for (uint32_t i = 0; i < s->planes.count; i++)
        if (s->planes.nz[i] > 0.99)
            return i;
    fail();
    return 0;
}

static struct facet from_above(const struct scene *s, double x, double y)
{
    struct facet f = {0};
    assert_true(facets_find(s->facets, &s->solid, top_of(&s->solid), (struct vec3){x, y, 9},
                            (struct vec3){0, 0, -1}, &f));
    struct vec3 share = facets_shares(&f, (struct vec3){x, y, 9}, (struct vec3){0, 0, -1});
    assert_true(share.x >= -1e-12 && share.y >= -1e-12 && share.z >= -1e-12);
    assert_true(fabs(share.x + share.y + share.z - 1) < 1e-12);
    assert_true(f.normal.z > 0);
    return f;
}

static int edges_of(const struct facet *f)
{
    return f->edge[0] + f->edge[1] + f->edge[2];
}

static void squares_hide_their_diagonal(void **state)
{
    (void)state;
    struct mesh m;
    struct scene s;
    primitive_cube(&m);
    scene_make(&s, &m, CUT_FACES);
    for (double x = 0.05; x < 1; x += 0.1)
        for (double y = 0.07; y < 1; y += 0.1) {
            struct facet f = from_above(&s, x, y);
            assert_int_equal(edges_of(&f), 2);
            struct vec3 a = f.corners[1], b = f.corners[2]; // the side that is hidden
            assert_false(f.edge[0]);
            assert_true(a.x != b.x && a.y != b.y);
        }
    scene_free(&s);
}

static void large_faces_hide_their_spokes(void **state)
{
    (void)state;
    struct mesh m;
    struct scene s;
    primitive_cylinder(&m, 7, 1, 1);
    scene_make(&s, &m, CUT_FACES);
    for (int i = 0; i < 70; i++) {
        double angle = 2 * M_PI * (i + 0.5) / 70;
        struct facet f = from_above(&s, 0.5 * cos(angle), 0.5 * sin(angle));
        assert_true(vec3_length((struct vec3){f.corners[0].x, f.corners[0].y, 0}) < 1e-12);
        assert_true(f.edge[0] && edges_of(&f) == 1);
        double first = 2 * M_PI * (i / 10) / 7; // of the two spokes
        assert_true(fabs(f.corners[1].x - cos(first)) < 1e-12);
        assert_true(fabs(f.corners[1].y - sin(first)) < 1e-12);
    }
    scene_free(&s);
}

static void caps_are_whole_and_bands_are_not(void **state)
{
    (void)state;
    struct mesh m;
    struct scene s;
    struct facet f;
    primitive_sphere(&m, 8);
    scene_make(&s, &m, CUT_CAPS);
    f = from_above(&s, 0.1, 0.05);
    assert_int_equal(edges_of(&f), 1);
    for (uint32_t face = 0; face < s.solid.planes.count; face++) {
        const struct planes *p = &s.solid.planes;
        struct vec3 normal = {p->nx[face], p->ny[face], p->nz[face]};
        assert_true(facets_find(s.facets, &s.solid, face, vec3_scale(normal, 5),
                                vec3_scale(normal, -1), &f));
        assert_int_equal(edges_of(&f), fabs(normal.z) > 0.999 ? 1 : 3);
    }
    scene_free(&s);
    primitive_cube(&m);
    scene_make(&s, &m, CUT_SIDES);
    f = from_above(&s, 0.3, 0.6);
    assert_int_equal(edges_of(&f), 3);
    scene_free(&s);
    primitive_cube(&m);
    scene_make(&s, &m, CUT_TRIANGLES);
    f = from_above(&s, 0.3, 0.6);
    assert_int_equal(edges_of(&f), 3);
    assert_false(facets_find(s.facets, &s.solid, top_of(&s.solid), (struct vec3){3, 3, 9},
                             (struct vec3){0, 0, -1}, &f));
    scene_free(&s);
}

// A cube of 1 mm seen from above, 16 pixels wide.
static void lines_fade_within_their_width(void **state)
{
    (void)state;
    struct mesh m;
    struct scene s;
    primitive_cube(&m);
    scene_make(&s, &m, CUT_FACES);
    struct camera c = {.centre = {0.5, 0.5, 1}, .distance = 100, .orthographic = true};
    c.fov = 2 * 180 / M_PI * atan(0.5 / 100);
    struct rays r = camera_rays(&c, 16, 16, s.solid.bounds);
    uint32_t top = top_of(&s.solid);
    double near = edges_cover(s.facets, &s.leaf, top, &r, 5, 0);
    double t = 0.5 / 1.414; // half a pixel away from the edge
    assert_true(fabs(near - (1 - t * t * (3 - 2 * t))) < 1e-9);
    assert_true(edges_cover(s.facets, &s.leaf, top, &r, 5, 1) == 0);
    assert_true(fabs(edges_cover(s.facets, &s.leaf, top, &r, 0, 9) - near) < 1e-9);
    assert_true(edges_cover(s.facets, &s.leaf, top, &r, 8, 8) == 0);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_hide_their_diagonal),
        cmocka_unit_test(large_faces_hide_their_spokes),
        cmocka_unit_test(caps_are_whole_and_bands_are_not),
        cmocka_unit_test(lines_fade_within_their_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
