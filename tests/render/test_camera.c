// test_camera.c - the camera against numbers measured on OpenSCAD's pictures.
#include "render/camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static const struct box cube10 = {{0, 0, 0}, {10, 10, 10}};

static void near_to(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.9g is not within %g of %.9g", a, tolerance, b);
}

static void near_vector(struct vec3 a, struct vec3 b, double tolerance)
{
    near_to(a.x, b.x, tolerance);
    near_to(a.y, b.y, tolerance);
    near_to(a.z, b.z, tolerance);
}

// Where a point of the world appears, by solving the rays' own equations.
static void project(const struct rays *r, struct vec3 p, double *x, double *y)
{
    struct vec3 ahead = vec3_normalized(vec3_cross(r->step_y, r->step_x));
    if (vec3_dot(ahead, r->forward) < 0)
        ahead = vec3_scale(ahead, -1);
    double step2 = vec3_dot(r->step_x, r->step_x);
    struct vec3 d = vec3_sub(p, r->origin);
    struct vec3 on = r->orthographic ? d : vec3_scale(d, 1 / vec3_dot(d, ahead));
    struct vec3 base = r->orthographic ? (struct vec3){0, 0, 0} : r->forward;
    struct vec3 offset = vec3_sub(on, base);
    *x = vec3_dot(offset, r->step_x) / step2;
    *y = vec3_dot(offset, r->step_y) / step2;
}

static struct camera viewing(struct box scene)
{
    struct camera c = CAMERA_DEFAULTS;
    camera_autocenter(&c, scene);
    camera_viewall(&c, scene);
    return c;
}

static void cube_fills_the_measured_pixels(void **state)
{
    (void)state;
    struct camera c = viewing(cube10);
    near_to(c.distance, 44.391, 1e-4);
    struct rays r = camera_rays(&c, 512, 512, cube10);
    double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
    for (int i = 0; i < 8; i++) {
        double x, y;
        project(&r, box_corner(cube10, i), &x, &y);
        left = fmin(left, x);
        right = fmax(right, x);
        top = fmin(top, y);
        bottom = fmax(bottom, y);
    }
    assert_int_equal(ceil(left), 40);
    assert_int_equal(floor(right), 452);
    assert_int_equal(ceil(top), 39);
    assert_int_equal(floor(bottom), 498);
    near_to(r.near, 4.4391, 1e-4);
    near_to(r.far, 4439.1, 0.1);
    near_to(r.reference, c.distance, 1e-9); // the centre of the box is the centre of the view
}

static void middle_ray_meets_the_centre(void **state)
{
    (void)state;
    struct camera c = {{1, 2, 3}, {20, 30, 40}, 50, 22.5, false};
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        c.orthographic = orthographic;
        struct rays r = camera_rays(&c, 301, 201, cube10);
        struct vec3 o = rays_origin(&r, 150, 100), d = rays_direction(&r, 150, 100);
        near_vector(vec3_add(o, vec3_scale(d, c.distance)), c.centre, 1e-12);
        near_to(vec3_length(d), 1, 1e-12);
        near_to(r.near, orthographic ? -5000 : 5, 1e-12);
    }
}

static void standard_views_are_exact(void **state)
{
    (void)state;
    struct camera c = {{0, 0, 0}, {0, 0, 0}, 100, 22.5, true};
    struct rays r = camera_rays(&c, 101, 101, cube10);
    near_vector(r.forward, (struct vec3){0, 0, -1}, 0);
    assert_true(r.step_x.x > 0 && r.step_x.y == 0 && r.step_x.z == 0);
    assert_true(r.step_y.y < 0 && r.step_y.x == 0 && r.step_y.z == 0);
    c.rotation = (struct vec3){90, 0, 90};
    r = camera_rays(&c, 101, 101, cube10);
    near_vector(r.forward, (struct vec3){-1, 0, 0}, 0);
}

static void parses_both_forms(void **state)
{
    (void)state;
    struct camera c = CAMERA_DEFAULTS;
    struct error err;
    assert_true(camera_parse(&c, "1,2,3,55,0,25,140", &err));
    near_vector(c.centre, (struct vec3){1, 2, 3}, 0);
    near_vector(c.rotation, (struct vec3){55, 0, 25}, 0);
    near_to(c.distance, 140, 0);
    assert_true(camera_parse(&c, "0,0,100, 0,0,0", &err));
    near_vector(c.rotation, (struct vec3){0, 0, 0}, 0);
    near_to(c.distance, 100, 0);
    // The eye of the six numbers is the eye of the rays.
    assert_true(camera_parse(&c, "30,-40,25,1,2,3", &err));
    struct rays r = camera_rays(&c, 64, 64, BOX_EMPTY);
    near_vector(r.origin, (struct vec3){30, -40, 25}, 1e-12);
    assert_true(camera_parse(&c, "0,0,-7,0,0,0", &err));
    r = camera_rays(&c, 64, 64, BOX_EMPTY);
    near_vector(r.origin, (struct vec3){0, 0, -7}, 1e-12);
}

static void refuses_other_texts(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",        "1,2,3,4,5",    "1,2,3,4,5,6,7,8", "1,2,3,4,5,6,",
        "a,b,c",   "1 2 3 4 5",    "1,2,3,4,5,6,inf", "1,2,3,nan,5,6",
        ",,,,,,,", "1,2,3,4,5,6x", "0,0,0,0,0,0,-1"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct camera c = CAMERA_DEFAULTS;
        struct error err = {0};
        if (camera_parse(&c, texts[i], &err))
            fail_msg("accepted '%s'", texts[i]);
        assert_non_null(strstr(err.text, "--camera"));
        near_to(c.distance, 140, 0);
    }
}

static void prints_what_it_reads(void **state)
{
    (void)state;
    struct camera c = {{1.0 / 3, -2e-7, 12345678.9}, {55, -0.0, 25}, 44.390513061, 22.5, false},
                  d = c;
    char text[CAMERA_TEXT];
    struct error err;
    camera_print(&c, text);
    assert_true(camera_parse(&d, text, &err));
    assert_memory_equal(&c.centre, &d.centre, sizeof c.centre);
    near_vector(c.rotation, d.rotation, 0);
    assert_true(c.distance == d.distance);
    c = CAMERA_DEFAULTS;
    camera_print(&c, text);
    assert_string_equal(text, "0,0,0,55,0,25,140");
    double huge = -1.2345678901234567e-300;
    c = (struct camera){{huge, huge, huge}, {huge, huge, huge}, -huge, 22.5, false};
    camera_print(&c, text);
    assert_true(camera_parse(&d, text, &err) && d.distance == -huge);
}

static void options_come_back(void **state)
{
    (void)state;
    struct camera c = CAMERA_DEFAULTS, back = CAMERA_DEFAULTS;
    char text[300];
    struct error err;
    c.distance = 77;
    c.orthographic = true;
    camera_print_options(&c, text, sizeof text);
    assert_string_equal(text, "--camera=0,0,0,55,0,25,77 --projection=o");
    assert_true(camera_parse_options(&back, text, &err));
    assert_true(back.orthographic && back.distance == 77);
    assert_true(camera_parse_options(&back, "openscad --camera 1,2,3,4,5,6,7 -o x.png", &err));
    assert_true(!back.orthographic && back.centre.y == 2 && back.distance == 7);
    assert_true(camera_parse_options(&back, "  0,0,0,55,0,25,140\n", &err));
    assert_true(back.distance == 140);
    assert_false(camera_parse_options(&back, "", &err));
    assert_false(camera_parse_options(&back, "cube(10);", &err));
    assert_false(camera_parse_options(&back, "--camera=1,2,3,4,5,6,7 --projection=x", &err));
    assert_true(back.distance == 140);
}

static void empty_scene_takes_the_defaults(void **state)
{
    (void)state;
    struct camera c = {{5, 5, 5}, {55, 0, 25}, 1, 22.5, false};
    camera_autocenter(&c, BOX_EMPTY);
    camera_viewall(&c, BOX_EMPTY);
    near_vector(c.centre, (struct vec3){0, 0, 0}, 0);
    near_to(c.distance, 140, 0);
    camera_viewall(&c, (struct box){{0, 0, 0}, {0, 0, 0}});
    assert_true(c.distance > 0);
}

static void viewall_alone_keeps_the_centre(void **state)
{
    (void)state;
    struct camera c = CAMERA_DEFAULTS;
    camera_viewall(&c, cube10);
    near_vector(c.centre, (struct vec3){0, 0, 0}, 0);
    near_to(c.distance, 10 * sqrt(3) / sin(22.5 / 2 * acos(-1) / 180), 1e-9);
}

static void pan_follows_the_pointer(void **state)
{
    (void)state;
    struct camera c = {{1, 2, 3}, {20, 30, 40}, 50, 22.5, false};
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        c.orthographic = orthographic;
        struct vec3 p = c.centre;
        struct camera moved = c;
        camera_pan(&moved, 17, -9, 240);
        struct rays r = camera_rays(&moved, 320, 240, cube10);
        double x, y;
        project(&r, p, &x, &y);
        near_to(x, 159.5 + 17, 1e-9);
        near_to(y, 119.5 - 9, 1e-9);
    }
}

static void zoom_keeps_what_is_under_the_pointer(void **state)
{
    (void)state;
    struct camera c = {{1, 2, 3}, {20, 30, 40}, 50, 22.5, false};
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        c.orthographic = orthographic;
        struct rays r = camera_rays(&c, 320, 240, cube10);
        struct vec3 p =
            vec3_add(rays_origin(&r, 33, 200), vec3_scale(rays_direction(&r, 33, 200), c.distance));
        struct camera zoomed = c;
        camera_zoom_at(&zoomed, 3, 33, 200, 320, 240);
        near_to(zoomed.distance, 50 * 0.9 * 0.9 * 0.9, 1e-12);
        r = camera_rays(&zoomed, 320, 240, cube10);
        double x, y;
        project(&r, p, &x, &y);
        near_to(x, 33, 1e-9);
        near_to(y, 200, 1e-9);
    }
}

static void orbit_turns_as_openscad_does(void **state)
{
    (void)state;
    struct camera c = CAMERA_DEFAULTS;
    camera_orbit(&c, 10, 20);
    near_vector(c.rotation, (struct vec3){41, 0, 18}, 1e-12);
    camera_roll(&c, -10, 0);
    near_vector(c.rotation, (struct vec3){41, 7, 18}, 1e-12);
    camera_orbit(&c, 100, 100);
    assert_true(c.rotation.x >= 0 && c.rotation.z >= 0);
}

static void dolly_moves_along_the_view(void **state)
{
    (void)state;
    struct camera c = {{0, 0, 0}, {0, 0, 0}, 50, 22.5, false};
    camera_dolly(&c, 10, 240);
    assert_true(c.centre.x == 0 && c.centre.y == 0 && c.centre.z < 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_fills_the_measured_pixels),
        cmocka_unit_test(middle_ray_meets_the_centre),
        cmocka_unit_test(standard_views_are_exact),
        cmocka_unit_test(parses_both_forms),
        cmocka_unit_test(refuses_other_texts),
        cmocka_unit_test(prints_what_it_reads),
        cmocka_unit_test(options_come_back),
        cmocka_unit_test(empty_scene_takes_the_defaults),
        cmocka_unit_test(viewall_alone_keeps_the_centre),
        cmocka_unit_test(pan_follows_the_pointer),
        cmocka_unit_test(zoom_keeps_what_is_under_the_pointer),
        cmocka_unit_test(orbit_turns_as_openscad_does),
        cmocka_unit_test(dolly_moves_along_the_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
