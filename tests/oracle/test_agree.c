// test_agree.c - pictures that differ in one known pixel.
#include "agree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

// The same picture twice.
struct twins {
    struct random_scene scene;
    struct subject subject;
    struct picture first, second;
    int face, border; // a pixel inside of a face, and one with nothing next to it
};

static bool inside_face(const struct surface_image *p, int x, int y)
{
    int at = y * p->width + x;
    for (int ny = y - 1; ny <= y + 1; ny++)
        for (int nx = x - 1; nx <= x + 1; nx++) {
            int i = ny * p->width + nx;
            if (p->leaf[i] == SURFACE_NONE || p->leaf[i] != p->leaf[at] ||
                p->face[i] != p->face[at])
                return false;
        }
    return true;
}

static int setup(void **state)
{
    static struct twins t;
    struct device *device = cpu_device_new();
    random_scene_make(&t.scene, 3);
    subject_make(&t.subject, &t.scene);
    struct render_settings settings = {.epsilon = t.scene.epsilon, .threads = 1};
    picture_render(&t.first, device, &t.subject.body, &t.scene.rays, &settings);
    picture_render(&t.second, device, &t.subject.body, &t.scene.rays, &settings);
    device_delete(device);
    const struct surface_image *p = &t.first.image;
    t.face = t.border = -1;
    for (int y = 1; y + 1 < p->height; y++)
        for (int x = 1; x + 1 < p->width; x++) {
            int i = y * p->width + x;
            if (inside_face(p, x, y) && t.first.spans[i].count)
                t.face = i;
            if (p->leaf[i] != SURFACE_NONE && p->leaf[i - 1] == SURFACE_NONE)
                t.border = i;
        }
    assert_true(t.face >= 0 && t.border >= 0);
    *state = &t;
    return 0;
}

static int teardown(void **state)
{
    struct twins *t = *state;
    picture_free(&t->first);
    picture_free(&t->second);
    subject_free(&t->subject);
    random_scene_free(&t->scene);
    return 0;
}

static struct agreement compare(const struct twins *t)
{
    struct agreement a;
    agree_compare(&a, &t->subject.body, &t->scene.rays, &t->first, &t->second, 2e-3);
    return a;
}

static void equal_pictures_agree(void **state)
{
    struct agreement a = compare(*state);
    assert_int_equal(a.surface.others + a.spans.others, 0);
    assert_true(a.surface.depth == 0 && a.spans.depth == 0);
    assert_in_range(a.silhouettes, 1, a.pixels - 1);
}

static void a_hole_in_a_face_counts(void **state)
{
    struct twins *t = *state;
    t->second.image.leaf[t->face] = SURFACE_NONE;
    struct agreement a = compare(t);
    assert_int_equal(a.surface.others, 1);
    assert_int_equal(a.surface.apart, 1);
    assert_true(a.surface.depth == INFINITY);
    assert_int_equal(a.surface.y * t->first.image.width + a.surface.x, t->face);
}

static void borders_may_move(void **state)
{
    struct twins *t = *state;
    t->second.image.leaf[t->border] = SURFACE_NONE;
    struct agreement a = compare(t);
    assert_int_equal(a.surface.others, 1);
    assert_int_equal(a.surface.apart, 1);
    assert_true(a.surface.depth == 0);
}

static void depths_are_measured(void **state)
{
    struct twins *t = *state;
    t->second.image.depth[t->face] += 0.003F;
    t->second.image.depth[t->border] += 1;
    struct agreement a = compare(t);
    assert_int_equal(a.surface.others, 0);
    assert_float_equal(a.surface.depth, 0.003, 1e-4);
    t->second.image.depth[t->face] = NAN;
    assert_true(compare(t).surface.depth == INFINITY);
}

static void another_leaf_in_its_place_is_told_apart(void **state)
{
    struct twins *t = *state;
    t->second.image.leaf[t->face] = !t->second.image.leaf[t->face];
    struct agreement a = compare(t);
    assert_int_equal(a.surface.others, 1);
    assert_int_equal(a.surface.apart, 0);
    assert_true(a.surface.depth == 0);
}

static void spans_count(void **state)
{
    struct twins *t = *state;
    struct pixel_spans *s = &t->second.spans[t->face];
    s->count--;
    assert_int_equal(compare(t).spans.others, 1);
    s->count++;
    s->items[0].leave_leaf++;
    assert_int_equal(compare(t).spans.others, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(equal_pictures_agree, setup, teardown),
        cmocka_unit_test_setup_teardown(a_hole_in_a_face_counts, setup, teardown),
        cmocka_unit_test_setup_teardown(borders_may_move, setup, teardown),
        cmocka_unit_test_setup_teardown(depths_are_measured, setup, teardown),
        cmocka_unit_test_setup_teardown(another_leaf_in_its_place_is_told_apart, setup, teardown),
        cmocka_unit_test_setup_teardown(spans_count, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
