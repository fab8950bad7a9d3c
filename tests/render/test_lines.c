// test_lines.c - which pixels a line takes.
#include "render/lines.h"

#include "render/camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

enum { WIDTH = 16, HEIGHT = 8 };

struct page {
    uint8_t rgb[3 * WIDTH * HEIGHT];
    float depth[WIDTH * HEIGHT];
    struct canvas canvas;
};

static void page_clear(struct page *p)
{
    memset(p->rgb, 0, sizeof p->rgb);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        p->depth[i] = INFINITY;
    p->canvas = (struct canvas){WIDTH, HEIGHT, p->rgb, p->depth};
}

// Rows of '.' and '#', from the top; what follows is empty.
static void expect(const struct page *p, const char *rows)
{
    char got[(WIDTH + 1) * HEIGHT + 1], want[sizeof got];
    char *g = got, *w = want;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            *g++ = p->rgb[3 * (y * WIDTH + x)] ? '#' : '.';
            *w++ = *rows && *rows != '/' ? *rows++ : '.';
        }
        rows += *rows == '/';
        *g++ = *w++ = '\n';
    }
    *g = *w = 0;
    assert_string_equal(got, want);
}

static void flat(struct page *p, struct line_style style, double x0, double y0, double x1,
                 double y1)
{
    page_clear(p);
    style.colour = (struct rgb){255, 0, 0};
    lines_draw_flat(&p->canvas, &style, (struct vec2){x0, y0}, (struct vec2){x1, y1});
}

static const struct line_style thin = {.width = 1};

static void last_pixel_is_left_to_the_next_line(void **state)
{
    (void)state;
    struct page p;
    flat(&p, thin, 1, 1, 6, 1);
    expect(&p, "/.#####");
    flat(&p, thin, 6, 1, 1, 1);
    expect(&p, "/..#####");
    flat(&p, thin, 1, 0, 1, 3);
    expect(&p, ".#/.#/.#");
    flat(&p, thin, 1, 3, 1, 0);
    expect(&p, "/.#/.#/.#");
    flat(&p, thin, 0, 0, 3, 3);
    expect(&p, "#/.#/..#");
    flat(&p, thin, 1.1, 1.1, 1.2, 1.2); // does not leave the diamond
    expect(&p, "");
}

static void ends_count_by_the_diamond_they_leave(void **state)
{
    (void)state;
    struct page p;
    flat(&p, thin, 1.3, 1, 4.4, 1); // begins and ends inside diamonds, behind their middles
    expect(&p, "/.###");
    flat(&p, thin, 1.45, 1.2, 4, 1.2); // begins beside the diamond
    expect(&p, "/..##");
    flat(&p, thin, 1, 1.2, 4.45, 1.2); // ends beside it
    expect(&p, "/.####");
}

static void one_pixel_for_each_step_of_the_main_direction(void **state)
{
    (void)state;
    struct page p;
    flat(&p, thin, 0, 0, 8, 2);
    expect(&p, "##/..####/......##");
    flat(&p, thin, 0, 0, 2, 6);
    expect(&p, "#/#/.#/.#/.#/..#");
}

static void width_is_across_the_main_direction(void **state)
{
    (void)state;
    struct page p;
    flat(&p, (struct line_style){.width = 3}, 1, 2, 5, 2);
    expect(&p, "/.####/.####/.####");
    flat(&p, (struct line_style){.width = 2}, 2.9, 0, 2.9, 3);
    expect(&p, "..##/..##/..##");
    flat(&p, (struct line_style){.width = 5}, 0, 0, 3, 0); // partly outside
    expect(&p, "###/###/###");
}

static void stippled_lines_are_off_first(void **state)
{
    (void)state;
    struct page p;
    const struct line_style style = {.width = 1, .stippled = true};
    flat(&p, style, 0, 0, 14, 0);
    expect(&p, "...###...###");
    flat(&p, style, 14, 1, 0, 1);
    expect(&p, "/...###...###");
    flat(&p, style, 0, 0, 4, 0);
    expect(&p, "...#");
}

static void hostile_ends_are_cut_or_refused(void **state)
{
    (void)state;
    struct page p;
    flat(&p, thin, -1e9, 3, 1e9, 3);
    expect(&p, "///################");
    flat(&p, thin, -1e300, 3, 1e300, 3);
    expect(&p, "");
    flat(&p, thin, -1e9, -1e9, -5, -5);
    expect(&p, "");
    flat(&p, thin, NAN, 0, 5, 0);
    expect(&p, "");
    flat(&p, thin, -INFINITY, 0, 5, 0);
    expect(&p, "");
    flat(&p, thin, 3, 3, 3, 3);
    expect(&p, "");
}

// Looking straight down from 80 above the origin with pixels of 1 mm there.
static struct rays down(bool orthographic)
{
    struct camera c = {.distance = 80, .fov = 2 * 180 / M_PI * atan(4 / 80.0)};
    c.orthographic = orthographic;
    return camera_rays(&c, WIDTH, HEIGHT, BOX_EMPTY);
}

static void world(struct page *p, const struct rays *r, struct vec3 a, struct vec3 b)
{
    const struct line_style style = {.colour = {255, 0, 0}, .width = 1};
    lines_draw(&p->canvas, r, &style, a, b);
}

static void world_lines_stand_where_rays_look(void **state)
{
    (void)state;
    struct page p;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct rays r = down(orthographic);
        page_clear(&p);
        world(&p, &r, (struct vec3){-6.5, 2.5, 0}, (struct vec3){-2.5, 2.5, 0});
        expect(&p, "/.####");
        assert_float_equal(p.depth[WIDTH + 2], 0, 1e-4);
        page_clear(&p);
        double size = orthographic ? 1 : 0.5; // of a pixel at half the distance
        p.depth[WIDTH + 2] = -41;
        world(&p, &r, (struct vec3){-6.5 * size, 2.5 * size, 40},
              (struct vec3){-2.5 * size, 2.5 * size, 40});
        expect(&p, "/.#.##"); // something nearer is there
        assert_float_equal(p.depth[WIDTH + 2], -41, 0);
        assert_float_equal(p.depth[WIDTH + 3], -40, 1e-4);
    }
}

static void depth_along_a_line_is_that_of_its_points(void **state)
{
    (void)state;
    struct page p;
    struct rays r = down(false);
    page_clear(&p);
    // Of a line of slope 1 the middle of the picture shows the point (0.5, 0.5, z).
    world(&p, &r, (struct vec3){-7, 0.5, -7}, (struct vec3){7, 0.5, 7});
    for (int x = 2; x < 14; x++) {
        double t = x - 7.5; // on the plane z = 0; at depth d it is t * d / 80 = 80 - d
        double depth = 80 * 80 / (80 + t);
        assert_float_equal(p.depth[3 * WIDTH + x], depth - 80, 0.01);
    }
}

static void what_is_behind_the_viewer_does_not_show(void **state)
{
    (void)state;
    struct page p;
    struct rays r = down(false);
    page_clear(&p);
    world(&p, &r, (struct vec3){-1, 0.5, 90}, (struct vec3){1, 0.5, 200});
    expect(&p, "");
    world(&p, &r, (struct vec3){0.5, 0.5, 0}, (struct vec3){0.5, 0.5, 1000});
    assert_int_equal(p.rgb[3 * (3 * WIDTH + 8)], 255); // up to the near plane
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_true(p.depth[i] >= 8 - 80.001);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(last_pixel_is_left_to_the_next_line),
        cmocka_unit_test(ends_count_by_the_diamond_they_leave),
        cmocka_unit_test(one_pixel_for_each_step_of_the_main_direction),
        cmocka_unit_test(width_is_across_the_main_direction),
        cmocka_unit_test(stippled_lines_are_off_first),
        cmocka_unit_test(hostile_ends_are_cut_or_refused),
        cmocka_unit_test(world_lines_stand_where_rays_look),
        cmocka_unit_test(depth_along_a_line_is_that_of_its_points),
        cmocka_unit_test(what_is_behind_the_viewer_does_not_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
