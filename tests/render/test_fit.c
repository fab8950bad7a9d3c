// test_fit.c - after camera_fit the free space around what shows is the margin.
#include "render/fit.h"

#include "render/map.h"
#include "unit.h"

// Free pixels on the four sides.
struct sides {
    int left, right, top, bottom;
};

static struct sides free_sides(struct stage *s, const struct camera *c, int width, int height)
{
    struct map m = {0};
    struct render_stats stats;
    struct rays rays = camera_rays(c, width, height, s->model.bounds);
    struct sides r = {width, width, height, height};
    map_draw(&m, s->device, &s->model, &rays, &s->settings, &stats);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            if (map_is_empty_at(&m, (size_t)y * (size_t)width + (size_t)x))
                continue;
            r.left = x < r.left ? x : r.left;
            r.right = width - 1 - x < r.right ? width - 1 - x : r.right;
            r.top = y < r.top ? y : r.top;
            r.bottom = height - 1 - y < r.bottom ? height - 1 - y : r.bottom;
        }
    map_free(&m);
    return r;
}

static void expect_fit(const char *text, int width, int height, double margin)
{
    static const struct vec3 rotations[] = {{55, 0, 25}, {0, 0, 0}, {100, 20, 300}};
    struct stage s;
    stage_make(&s, text);
    for (int i = 0; i < 6; i++) {
        struct camera c = CAMERA_DEFAULTS;
        c.orthographic = i % 2;
        c.rotation = rotations[i / 2];
        camera_fit(&c, width, height, margin, s.device, &s.model, &s.settings);
        struct sides f = free_sides(&s, &c, width, height);
        int across = f.left < f.right ? f.left : f.right;
        int upwards = f.top < f.bottom ? f.top : f.bottom;
        int tighter = across < upwards ? across : upwards;
        int other = across < upwards ? (f.left > f.right ? f.left : f.right)
                                     : (f.top > f.bottom ? f.top : f.bottom);
        if (tighter < margin || tighter >= margin + 1 || other >= margin + 2)
            fail_msg("%s, view %d: %d %d %d %d free, not %g", text, i, f.left, f.right, f.top,
                     f.bottom, margin);
    }
    stage_free(&s);
}

static void margins_hold(void **state)
{
    (void)state;
    expect_fit("cube(size=[10,10,10]);", 200, 200, 10);
    expect_fit("cube(size=[10,20,30]);", 300, 100, 0);
    expect_fit("sphere(r=7, $fn=24);", 100, 170, 20);
    expect_fit("cube(size=[100,1,1]);", 160, 120, 5);
}

static void large_pictures_are_exact_too(void **state)
{
    (void)state;
    expect_fit("cylinder(h=10, r1=5, r2=2, $fn=17);", 500, 450, 30);
}

static void only_what_shows_counts(void **state)
{
    (void)state;
    // a small rest of large objects, far from their middle
    expect_fit("difference() { cube(size=[100,100,100]); "
               "multmatrix([[1,0,0,-1],[0,1,0,-1],[0,0,1,3],[0,0,0,1]]) cube(size=[200,200,200]); "
               "multmatrix([[1,0,0,4],[0,1,0,-1],[0,0,1,-1],[0,0,0,1]]) cube(size=[200,200,200]);"
               "multmatrix([[1,0,0,-1],[0,1,0,-1],[0,0,1,-1],[0,0,0,1]]) cube(size=[200,96,200]);}",
               150, 150, 10);
}

static void long_and_thin_things_are_found(void **state)
{
    (void)state;
    struct stage s;
    stage_make(&s, "cube(size=[1,1,100000]);");
    for (int i = 0; i < 2; i++) {
        struct camera c = {.distance = 1, .fov = 22.5, .orthographic = i};
        camera_fit(&c, 100, 50, 5, s.device, &s.model, &s.settings);
        struct sides f = free_sides(&s, &c, 100, 50);
        if (f.left != 30 || f.right != 30 || f.top != 5 || f.bottom != 5)
            fail_msg("view %d: %d %d %d %d free", i, f.left, f.right, f.top, f.bottom);
    }
    stage_free(&s);
}

static void nothing_leaves_the_camera(void **state)
{
    (void)state;
    struct stage s;
    stage_make(&s, "intersection() { cube(size=[3,3,3]); "
                   "multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size=[3,3,3]); }");
    struct camera c = CAMERA_DEFAULTS;
    camera_fit(&c, 100, 100, 10, s.device, &s.model, &s.settings);
    assert_memory_equal(&c, &CAMERA_DEFAULTS, sizeof c);
    stage_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_hold),
        cmocka_unit_test(large_pictures_are_exact_too),
        cmocka_unit_test(only_what_shows_counts),
        cmocka_unit_test(long_and_thin_things_are_found),
        cmocka_unit_test(nothing_leaves_the_camera),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
