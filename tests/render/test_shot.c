// test_shot.c - averaged pictures, alpha and effects, seen from above.
#include "render/shot.h"

#include "unit.h"

enum { SIDE = 20, PIXELS = SIDE * SIDE };

static const uint8_t paper[3] = {255, 255, 229}, top[3] = {194, 167, 34};

static size_t at(int x, int y) // of the pixel whose lower left corner is at (x, y) mm
{
    return (size_t)((SIDE / 2 - 1 - y) * SIDE + SIDE / 2 + x);
}

static void draw(struct shot *out, struct stage *s, int size, struct shot_style style,
                 uint32_t threads)
{
    struct rays rays = rays_from_above(size);
    struct render_stats stats;
    s->settings.threads = threads;
    shot_draw(out, s->device, &s->shader, &rays, &s->settings, &style, &stats);
}

static void one_sample_is_the_picture(void **state)
{
    (void)state;
    struct stage s;
    struct shot shot = {0};
    struct picture picture = {0};
    struct rays rays = rays_from_above(SIDE);
    struct render_stats stats;
    stage_make(&s, "sphere(r=7);");
    draw(&shot, &s, SIDE, (struct shot_style){.samples = 1}, 2);
    picture_draw(&picture, s.device, &s.shader, &rays, &s.settings, &stats);
    assert_int_equal(shot.channels, 3);
    assert_memory_equal(shot.pixels, picture.rgb, 3 * PIXELS);
    picture_free(&picture);
    shot_free(&shot);
    stage_free(&s);
}

// A plate whose left border runs through a pixel and covers `covered` of four samples, whatever
// their pattern: they stand in the middles of four columns.
static void expect_average(const char *text, int covered)
{
    struct stage s;
    struct shot shot = {0};
    stage_make(&s, text);
    draw(&shot, &s, SIDE, (struct shot_style){.samples = 4}, 2);
    for (int k = 0; k < 3; k++) {
        int sum = covered * top[k] + (4 - covered) * paper[k];
        assert_int_equal(shot.pixels[3 * at(2, 2) + (size_t)k], (sum + 2) / 4);
        assert_int_equal(shot.pixels[3 * at(4, 2) + (size_t)k], top[k]);
        assert_int_equal(shot.pixels[3 * at(-4, 2) + (size_t)k], paper[k]);
    }
    shot_free(&shot);
    stage_free(&s);
}

static void borders_are_averaged(void **state)
{
    (void)state;
#define PLATE(x) "multmatrix([[1,0,0," x "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size=[5,5,1]);"
    expect_average(PLATE("2.01"), 4);
    expect_average(PLATE("2.25"), 3);
    expect_average(PLATE("2.5"), 2);
    expect_average(PLATE("2.75"), 1);
    expect_average(PLATE("2.99"), 0);
    // where material was cut away too
    expect_average("difference() { cube(size=[7,7,1]); "
                   "multmatrix([[1,0,0,-1],[0,1,0,-1],[0,0,1,-1],[0,0,0,1]]) "
                   "cube(size=[3.5,9,9]); }",
                   2);
}

// The mean of the pattern is the centre of the pixel: a plate that is symmetrical stays so.
static void patterns_are_centred(void **state)
{
    (void)state;
    struct stage s;
    struct shot shot = {0};
    stage_make(&s, "cube(size=[8.7,8.7,1], center=true);");
    for (uint32_t samples = 1; samples <= SAMPLES_MOST; samples++) {
        draw(&shot, &s, SIDE, (struct shot_style){.samples = samples}, 1);
        int sums[4] = {0}; // of blue along the four sides
        for (int i = -3; i < 3; i++) {
            sums[0] += shot.pixels[3 * at(-5, i) + 2];
            sums[1] += shot.pixels[3 * at(4, i) + 2];
            sums[2] += shot.pixels[3 * at(i, -5) + 2];
            sums[3] += shot.pixels[3 * at(i, 4) + 2];
        }
        int step = 6 * (229 - 35) / (int)samples + 6; // one sample more or less on a side
        for (int i = 1; i < 4; i++)
            assert_in_range(sums[i] - sums[0] + step, 0, 2 * step);
    }
    shot_free(&shot);
    stage_free(&s);
}

static void alpha_is_coverage(void **state)
{
    (void)state;
    struct stage s;
    struct shot shot = {0};
    stage_make(&s, PLATE("2.25"));
    draw(&shot, &s, SIDE, (struct shot_style){.samples = 4, .transparent = true}, 2);
    assert_int_equal(shot.channels, 4);
    const uint8_t *border = shot.pixels + 4 * at(2, 2), *inside = shot.pixels + 4 * at(4, 2);
    assert_int_equal(shot.pixels[4 * at(-4, 2) + 3], 0);
    assert_int_equal(border[3], (3 * 255 + 2) / 4);
    assert_memory_equal(border, top, 3); // not darkened by what is not there
    assert_int_equal(inside[3], 255);
    assert_memory_equal(inside, top, 3);
    shot_free(&shot);
    stage_free(&s);
}

static void see_through_objects_keep_their_alpha(void **state)
{
    (void)state;
    struct stage s;
    struct shot shot = {0};
    stage_make(&s, "difference() { color([1,0,0,0.5]) cube(size=[5,5,1]); cube(size=[2,2,2]); }");
    draw(&shot, &s, SIDE, (struct shot_style){.samples = 1, .transparent = true}, 2);
    const uint8_t *glass = shot.pixels + 4 * at(4, 4);
    assert_int_equal(glass[3], 128);
    assert_in_range(glass[0], 197, 199); // 255 * (0.2 + 1 / sqrt(3))
    assert_int_equal(glass[1], 0);
    shot_free(&shot);
    stage_free(&s);
}

static const char corner[] =
    "cube(size=[9,9,1]); cube(size=[1,9,9]); "
    "multmatrix([[1,0,0,4],[0,1,0,4],[0,0,1,0],[0,0,0,1]]) sphere(r=2.5); %cube(size=[3,2,4]);";

static void threads_do_not_matter(void **state)
{
    (void)state;
    struct stage s;
    struct shot one = {0}, many = {0};
    stage_make(&s, corner);
    for (uint32_t samples = 1; samples <= 5; samples += 2) {
        struct shot_style style = {samples, samples == 3, EFFECT_OCCLUSION | EFFECT_OUTLINE};
        draw(&one, &s, 150, style, 1);
        draw(&many, &s, 150, style, 7);
        assert_memory_equal(one.pixels, many.pixels, (size_t)150 * 150 * one.channels);
    }
    shot_free(&one);
    shot_free(&many);
    shot_free(&many);
    stage_free(&s);
}

static void corners_are_darker_and_planes_are_not(void **state)
{
    (void)state;
    enum { LARGE = 40 };
    struct stage s;
    struct shot plain = {0}, dark = {0};
    stage_make(&s, "cube(size=[40,40,1], center=true); "
                   "multmatrix([[1,0,0,0],[0,1,0,-20],[0,0,1,0],[0,0,0,1]]) cube(size=[3,40,9]);");
    draw(&plain, &s, LARGE, (struct shot_style){.samples = 1}, 2);
    draw(&dark, &s, LARGE, (struct shot_style){.samples = 1, .effects = EFFECT_OCCLUSION}, 2);
    int before = 255;
    for (int x = 3; x < 20; x++) { // away from the wall
        size_t pixel = 3 * (size_t)(LARGE / 2 * LARGE + LARGE / 2 + x);
        int share = 255 * dark.pixels[pixel] / plain.pixels[pixel];
        if (x == 3)
            assert_in_range(share, 100, 230);
        else
            assert_true(share >= before);
        if (x >= 3 + LARGE / 8)
            assert_int_equal(share, 255);
        before = share;
    }
    size_t on_wall = 3 * (size_t)(LARGE / 2 * LARGE + LARGE / 2 + 1);
    assert_memory_equal(dark.pixels + on_wall, plain.pixels + on_wall, 3);
    shot_free(&plain);
    shot_free(&dark);
    stage_free(&s);
}

static void outlines_are_two_pixels_inside(void **state)
{
    (void)state;
    struct stage s;
    struct shot shot = {0};
    stage_make(&s, "cube(size=[10,10,1], center=true);");
    draw(&shot, &s, SIDE, (struct shot_style){.samples = 1, .effects = EFFECT_OUTLINE}, 2);
    assert_memory_equal(shot.pixels + 3 * at(-6, 0), paper, 3);
    assert_true(shot.pixels[3 * at(-5, 0)] < 50);
    assert_true(shot.pixels[3 * at(-4, 0)] < 50);
    assert_memory_equal(shot.pixels + 3 * at(-3, 0), top, 3);
    assert_memory_equal(shot.pixels + 3 * at(0, 0), top, 3);
    shot_free(&shot);
    stage_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_sample_is_the_picture),
        cmocka_unit_test(borders_are_averaged),
        cmocka_unit_test(patterns_are_centred),
        cmocka_unit_test(alpha_is_coverage),
        cmocka_unit_test(see_through_objects_keep_their_alpha),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(corners_are_darker_and_planes_are_not),
        cmocka_unit_test(outlines_are_two_pixels_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
