// test_measure.c - volumes, surfaces and centres of mass against known ones: the truth has to lie
// within the bound.
#include "render/measure.h"

#include "base/hash.h"
#include "csg/csg.h"
#include "geom/boolean.h"
#include "geom/mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

#define ACCURACY 1e-2

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
    assert_true(csg_parse(&s->tree, "measured.csg", copy, size, &messages));
    s->store = solid_store_new();
    model_build(&s->model, &s->tree, s->store, &MODEL_DEFAULTS, &messages);
    messages_free(&messages);
    free(copy);
}

static void scene_free(struct scene *s)
{
    model_free(&s->model);
    solid_store_delete(s->store);
    csg_free(&s->tree);
}

static struct measure measure_scene(const struct scene *s, double accuracy, uint32_t threads)
{
    const struct render_settings settings = {.epsilon = model_epsilon(&s->model, -1),
                                             .threads = threads};
    struct device *device = cpu_device_new();
    struct measure m;
    measure_model(&m, device, &s->model, &settings, accuracy);
    device_delete(device);
    return m;
}

static struct measure measure_text(const char *text, double accuracy)
{
    struct scene s;
    scene_make(&s, text);
    struct measure m = measure_scene(&s, accuracy, 1);
    scene_free(&s);
    return m;
}

static void assert_near(const char *what, struct measured got, double truth)
{
    if (!(fabs(got.value - truth) <= got.bound))
        fail_msg("%s is %.9g +- %.3g, not %.9g", what, got.value, got.bound, truth);
}
#define assert_holds(number, truth) assert_near(#number, number, truth)

static void a_box_has_its_volume_surface_and_centre(void **state)
{
    struct measure m = measure_text("multmatrix([[1,0,0,-3],[0,1,0,100],[0,0,1,7],[0,0,0,1]])"
                                    "{cube(size=[10,20,30],center=false);}",
                                    ACCURACY);
    (void)state;
    assert_false(m.flat);
    assert_holds(m.volume, 6000);
    assert_holds(m.area, 2200);
    assert_holds(m.centre[0], 2);
    assert_holds(m.centre[1], 110);
    assert_holds(m.centre[2], 22);
    assert_true(m.volume.bound <= ACCURACY * 6000 && m.volume.bound > 0);
    assert_true(m.area.bound <= ACCURACY * 2200 && m.area.bound > 0);
    assert_holds(measure_mass(&m, 7.85), 6000 * 7.85e-3);
}

// As much as asked for, and by rays, not by a larger bound.
static void more_accuracy_costs_more_and_still_holds(void **state)
{
    double last = 1;
    (void)state;
    for (double accuracy = 1e-2; accuracy > 5e-4; accuracy /= 10) {
        struct measure m = measure_text("multmatrix([[0.8,-0.6,0,0],[0.6,0.8,0,0],[0,0,1,0],"
                                        "[0,0,0,1]]){cube(size=[7,11,13],center=false);}",
                                        accuracy);
        assert_holds(m.volume, 1001);
        assert_holds(m.area, 2 * (77 + 143 + 91));
        assert_true(m.volume.bound <= accuracy * m.volume.value);
        assert_true(m.volume.bound < last * 1001);
        last = m.volume.bound / 1001;
    }
}

static const char drilled[] = "difference(){cube(size=[20,20,10],center=true);"
                              "cylinder($fn=24,$fa=12,$fs=2,h=30,r1=5,r2=5,center=true);}";

static void a_drilled_plate_lacks_the_hole(void **state)
{
    struct measure m = measure_text(drilled, 1e-3);
    double turn = acos(-1) / 12, disc = 24 * 0.5 * 25 * sin(turn), rim = 24 * 10 * sin(turn / 2);
    (void)state;
    assert_holds(m.volume, 4000 - 10 * disc);
    assert_holds(m.area, 2 * (400 - disc) + 4 * 200 + 10 * rim);
    for (int i = 0; i < 3; i++)
        assert_holds(m.centre[i], 0);
}

static void threads_change_nothing(void **state)
{
    struct scene s;
    (void)state;
    scene_make(&s, drilled);
    struct measure one = measure_scene(&s, ACCURACY, 1), three = measure_scene(&s, ACCURACY, 3);
    scene_free(&s);
    assert_memory_equal(&one.volume, &three.volume, sizeof one.volume);
    assert_memory_equal(&one.area, &three.area, sizeof one.area);
    assert_memory_equal(one.centre, three.centre, sizeof one.centre);
}

static void a_rod_and_a_sheet_are_measured_as_well(void **state)
{
    struct measure rod = measure_text("cube(size=[2000,1,1],center=false);", ACCURACY);
    struct measure sheet = measure_text("cube(size=[500,700,0.01],center=true);", ACCURACY);
    (void)state;
    assert_holds(rod.volume, 2000);
    assert_holds(rod.area, 8002);
    assert_holds(rod.centre[0], 1000);
    assert_true(rod.volume.bound <= ACCURACY * 2000);
    assert_holds(sheet.volume, 3500);
    assert_holds(sheet.area, 700000 + 0.01 * 2400);
    assert_true(sheet.volume.bound <= ACCURACY * 3500);
}

static void what_rays_miss_is_in_the_bound(void **state)
{
    struct measure m = measure_text("cube(size=1,center=true);"
                                    "multmatrix([[1,0,0,9000],[0,1,0,8000],[0,0,1,7000],[0,0,0,1]])"
                                    "{cube(size=1,center=true);}",
                                    ACCURACY);
    (void)state;
    assert_holds(m.volume, 2);
    assert_holds(m.area, 12);
    assert_holds(m.centre[0], 4500);
    assert_true(m.volume.bound > 0.1);
}

static void nothing_has_no_volume(void **state)
{
    struct measure none = measure_text("", ACCURACY);
    struct measure apart = measure_text(
        "intersection(){sphere($fn=8,$fa=12,$fs=2,r=1);multmatrix([[1,0,0,1.3],[0,1,0,1.3],"
        "[0,0,1,0],[0,0,0,1]]){sphere($fn=8,$fa=12,$fs=2,r=0.5);}}",
        ACCURACY);
    (void)state;
    assert_true(none.volume.value == 0 && none.volume.bound == 0 && none.area.value == 0);
    assert_holds(apart.volume, 0);
    assert_true(isfinite(apart.centre[0].value) && isfinite(apart.centre[0].bound));
}

static void flat_shapes_have_an_area_only(void **state)
{
    struct measure m = measure_text("difference(){square(size=[30,20],center=false);"
                                    "multmatrix([[1,0,0,10],[0,1,0,10],[0,0,1,0],[0,0,0,1]])"
                                    "{circle($fn=6,$fa=12,$fs=2,r=5);}}",
                                    1e-3);
    (void)state;
    assert_true(m.flat);
    assert_holds(m.area, 600 - 1.5 * sqrt(3) * 25);
    assert_true(m.area.bound <= 1e-3 * 600);
    assert_true(m.volume.value == 0 && m.volume.bound == 0);
}

static void marked_background_does_not_count(void **state)
{
    struct measure m =
        measure_text("cube(size=10,center=true);%cube(size=20,center=true);", ACCURACY);
    (void)state;
    assert_holds(m.volume, 1000);
}

// Random trees of random solids, and the mesh of each.
struct text {
    char *chars;
    uint32_t length, room;
    uint64_t random;
};

static void say(struct text *t, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    array_reserve(&t->chars, &t->room, t->length + (size_t)length + 1);
    memcpy(t->chars + t->length, line, (size_t)length + 1);
    t->length += (uint32_t)length;
}

static double between(struct text *t, double a, double b)
{
    return a + (b - a) * random_unit(&t->random);
}

static void say_placed(struct text *t)
{
    double a = between(t, 0, 7), b = random_next(&t->random) % 3 ? between(t, 0, 7) : 0;
    double size = random_next(&t->random) % 4 ? 1 : between(t, 0.1, 0.4);
    double c = cos(a), s = sin(a), d = cos(b), e = sin(b);
    say(t, "multmatrix([[%g,%g,%g,%g],[%g,%g,%g,%g],[%g,%g,%g,%g],[0,0,0,1]])", c * d, -s, c * e,
        between(t, -4, 4), s * d, c, s * e, between(t, -4, 4), -e, 0.0, d, between(t, -4, 4));
    const double x = between(t, 1, 8) * size, y = between(t, 1, 8) * size;
    unsigned fn = 3 + (unsigned)(random_next(&t->random) % 20);
    switch (random_next(&t->random) % 4) {
    case 0:
        say(t, "{sphere($fn=%u,$fa=12,$fs=2,r=%g);}", fn, x);
        break;
    case 1:
        say(t, "{cylinder($fn=%u,$fa=12,$fs=2,h=%g,r1=%g,r2=%g,center=true);}", fn, y, x, y / 3);
        break;
    default:
        say(t, "{cube(size=[%g,%g,%g],center=true);}", x, y, between(t, 0.2, 8));
    }
}

static void say_tree(struct text *t, int depth)
{
    const char *const names[] = {"union", "difference", "intersection", "difference"};
    if (depth == 0) {
        say_placed(t);
        return;
    }
    say(t, "%s(){", names[random_next(&t->random) % 4]);
    for (int i = 0; i < 2; i++)
        say_tree(t, depth - (random_next(&t->random) % 3 ? 1 : depth));
    say(t, "}");
}

static struct mesh leaf_mesh(const struct leaf *leaf)
{
    const struct mesh *m = &leaf->solid->mesh;
    struct mesh_builder b = {0};
    for (uint32_t i = 0; i < m->vertex_count; i++)
        mesh_add_vertex(&b, affine_point(&leaf->to_world, m->vertices[i]));
    for (uint32_t i = 0; i < m->triangle_count; i++)
        mesh_add_triangle(&b, m->triangles[i][0], m->triangles[i][1], m->triangles[i][2],
                          mesh_add_face(&b));
    return b.mesh;
}

static void combine(struct mesh *into, enum boolean_op op, struct mesh *with)
{
    struct mesh result;
    struct error err;
    if (!boolean_mesh(&result, op, into, with, &err))
        fail_msg("%s", err.text);
    mesh_free(into);
    mesh_free(with);
    *into = result;
}

static struct mesh exact_mesh(const struct body *body, uint32_t node)
{
    const struct expr_node *n = &body->expr.nodes[node];
    if (n->op == EXPR_LEAF)
        return leaf_mesh(&body->leaves[n->leaf]);
    struct mesh m = exact_mesh(body, body->expr.kids[n->first]);
    for (uint32_t i = 1; i < n->count; i++) {
        struct mesh kid = exact_mesh(body, body->expr.kids[n->first + i]);
        combine(&m, n->op == EXPR_UNION ? BOOLEAN_UNION : BOOLEAN_INTERSECTION, &kid);
    }
    if (n->minus != EXPR_NONE) {
        struct mesh kid = exact_mesh(body, n->minus);
        combine(&m, BOOLEAN_DIFFERENCE, &kid);
    }
    return m;
}

static void random_trees_have_the_volume_of_their_mesh(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        struct text t = {.random = seed};
        struct scene s;
        say_tree(&t, 3);
        scene_make(&s, t.chars);
        const struct body *body = &s.model.bodies[0];
        struct mesh mesh = {0};
        if (body->expr.root != EXPR_NONE)
            mesh = exact_mesh(body, body->expr.root);
        struct measure m = measure_scene(&s, ACCURACY, 1);
        double volume = mesh_volume(&mesh), area = mesh_area(&mesh);
        if (fabs(m.volume.value - volume) > m.volume.bound ||
            fabs(m.area.value - area) > m.area.bound)
            fail_msg(
                "seed %llu: volume %.9g +- %.3g, of the mesh %.9g; area %.9g +- %.3g, %.9g\n%s",
                (unsigned long long)seed, m.volume.value, m.volume.bound, volume, m.area.value,
                m.area.bound, area, t.chars);
        mesh_free(&mesh);
        scene_free(&s);
        free(t.chars);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_its_volume_surface_and_centre),
        cmocka_unit_test(more_accuracy_costs_more_and_still_holds),
        cmocka_unit_test(a_drilled_plate_lacks_the_hole),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(a_rod_and_a_sheet_are_measured_as_well),
        cmocka_unit_test(what_rays_miss_is_in_the_bound),
        cmocka_unit_test(nothing_has_no_volume),
        cmocka_unit_test(flat_shapes_have_an_area_only),
        cmocka_unit_test(marked_background_does_not_count),
        cmocka_unit_test(random_trees_have_the_volume_of_their_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
