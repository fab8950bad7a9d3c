// test_map.c - depths, normals and leaves of a few boxes seen from above, as numbers and as files.
#include "render/map_image.h"

#include "unit.h"

enum { SIDE = 20, PIXELS = SIDE * SIDE };

// A plate of 12 x 12 up to z = 2 with a hole of 4 x 4 down to z = 1 in the middle, and a cube that
// stands on its right part up to z = 5.
static const char boxes[] =
    "difference() {\n"
    "  multmatrix([[1,0,0,-6],[0,1,0,-6],[0,0,1,0],[0,0,0,1]]) cube(size=[12,12,2]);\n"
    "  multmatrix([[1,0,0,-2],[0,1,0,-2],[0,0,1,1],[0,0,0,1]]) cube(size=[4,4,4]);\n"
    "}\n"
    "multmatrix([[1,0,0,4],[0,1,0,-1],[0,0,1,0],[0,0,0,1]]) cube(size=[2,2,5]);\n";

// Of the pixel whose lower left corner is at (x, y) mm.
static size_t at(int x, int y)
{
    return (size_t)((SIDE / 2 - 1 - y) * SIDE + SIDE / 2 + x);
}

static void draw(struct stage *s, struct map *m, const char *text)
{
    struct render_stats stats;
    struct rays rays = rays_from_above(SIDE);
    stage_make(s, text);
    map_draw(m, s->device, &s->model, &rays, &s->settings, &stats);
    assert_int_equal(map_pixels(m), PIXELS);
}

static void depths_are_millimetres(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {0};
    struct rays rays = rays_from_above(SIDE);
    float depths[PIXELS];
    uint16_t greys[PIXELS];
    draw(&s, &m, boxes);
    map_depths(&m, &rays, depths);
    struct depth_range range = map_depth_range(&m, &rays);
    map_greys(&m, &rays, range, greys);
    assert_float_equal(range.nearest, 95, 1e-4);
    assert_float_equal(range.farthest, 99, 1e-4);
    static const struct {
        int x, y;
        float depth;
        int grey;
    } expected[] = {
        {-6, -6, 98, 1 + 65534 / 4}, {0, 0, 99, 1},       {5, 0, 95, 65535},
        {-7, 0, INFINITY, 0},        {6, 0, INFINITY, 0}, {0, 6, INFINITY, 0},
    };
    for (size_t i = 0; i < array_count(expected); i++) {
        size_t pixel = at(expected[i].x, expected[i].y);
        if (isinf(expected[i].depth))
            assert_true(isinf(depths[pixel]));
        else
            assert_float_equal(depths[pixel], expected[i].depth, 1e-4);
        assert_in_range(greys[pixel], expected[i].grey - (expected[i].grey > 1 ? 1 : 0),
                        expected[i].grey + (expected[i].grey > 1 && expected[i].grey < 65535));
    }
    map_free(&m);
    stage_free(&s);
}

static void flat_picture_is_nearest(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {0};
    struct rays rays = rays_from_above(SIDE);
    uint16_t greys[PIXELS];
    draw(&s, &m, "cube(size=[4,4,4]);");
    map_greys(&m, &rays, map_depth_range(&m, &rays), greys);
    assert_int_equal(greys[at(0, 0)], 65535);
    assert_int_equal(greys[at(-1, 0)], 0);
    map_free(&m);
    stage_free(&s);
}

static void nothing_has_no_range(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {0};
    struct rays rays = rays_from_above(SIDE);
    draw(&s, &m, "");
    struct depth_range range = map_depth_range(&m, &rays);
    assert_true(range.nearest > range.farthest);
    for (size_t i = 0; i < PIXELS; i++)
        assert_true(map_is_empty_at(&m, i));
    char *legend = map_legend(&m, &s.model);
    assert_string_equal(legend, "");
    free(legend);
    map_free(&m);
    map_free(&m);
    stage_free(&s);
}

static void normals_look_at_the_viewer(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {0};
    struct rays rays = rays_from_above(SIDE);
    float normals[PIXELS][3];
    uint8_t rgb[3 * PIXELS];
    // a roof that falls to the right by 45 degrees
    draw(&s, &m,
         "difference() { multmatrix([[1,0,0,-6],[0,1,0,-6],[0,0,1,-9],[0,0,0,1]]) "
         "cube(size=[12,12,9]); multmatrix([[1,0,1,0],[0,1,0,-9],[-1,0,1,0],[0,0,0,1]]) "
         "cube(size=[18,18,18]); }");
    map_normals(&m, &s.shader, &rays, 2, normals);
    map_normal_colours(normals, PIXELS, rgb);
    const float *flat = normals[at(-3, 0)], *roof = normals[at(3, 0)], *none = normals[at(7, 0)];
    assert_float_equal(flat[2], 1, 1e-6);
    assert_float_equal(roof[0], sqrt(0.5), 1e-6);
    assert_float_equal(roof[1], 0, 1e-6);
    assert_float_equal(roof[2], sqrt(0.5), 1e-6);
    assert_true(none[0] == 0 && none[1] == 0 && none[2] == 0);
    assert_memory_equal(rgb + 3 * at(-3, 0), ((uint8_t[]){128, 128, 255}), 3);
    assert_memory_equal(rgb + 3 * at(3, 0), ((uint8_t[]){218, 128, 218}), 3);
    assert_memory_equal(rgb + 3 * at(7, 0), ((uint8_t[]){0, 0, 0}), 3);
    map_free(&m);
    stage_free(&s);
}

static void leaves_have_colours_and_a_legend(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {0};
    uint8_t rgb[3 * PIXELS];
    char expected[256];
    draw(&s, &m, boxes);
    map_ids(&m, &s.model, rgb);
    const uint8_t *plate = rgb + 3 * at(-6, 0), *hole = rgb + 3 * at(0, 0);
    const uint8_t *cube = rgb + 3 * at(5, 0), *none = rgb + 3 * at(7, 0);
    assert_memory_equal(none, ((uint8_t[]){0, 0, 0}), 3);
    snprintf(expected, sizeof expected,
             "#%02x%02x%02x unit.csg:2:59\n#%02x%02x%02x unit.csg:3:59\n"
             "#%02x%02x%02x unit.csg:5:56\n",
             plate[0], plate[1], plate[2], hole[0], hole[1], hole[2], cube[0], cube[1], cube[2]);
    char *legend = map_legend(&m, &s.model);
    assert_string_equal(legend, expected);
    free(legend);
    assert_memory_not_equal(plate, none, 3);
    assert_memory_not_equal(plate, hole, 3);
    assert_memory_not_equal(plate, cube, 3);
    map_free(&m);
    stage_free(&s);
}

static void nearest_body_counts(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {0};
    draw(&s, &m,
         "cube(size=[4,4,4]);\n%multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
         "cube(size=[4,4,5]);\n%cube(size=[4,4,1]);\n");
    assert_int_equal(m.body[at(0, 0)], 0);
    assert_int_not_equal(m.body[at(3, 0)], 0);
    map_free(&m);
    stage_free(&s);
}

// A plate of 12 x 12 with a hole that a # shows, on its right a cube with a #, beside it one with a
// %.
static void marks_are_no_part_of_the_model(void **state)
{
    (void)state;
    struct stage s;
    struct map m = {.model_only = true};
    float depths[PIXELS];
    draw(&s, &m,
         "difference() { multmatrix([[1,0,0,-6],[0,1,0,-6],[0,0,1,0],[0,0,0,1]]) "
         "cube(size=[12,12,2]);\n"
         "#multmatrix([[1,0,0,-2],[0,1,0,-2],[0,0,1,1],[0,0,0,1]]) cube(size=[4,4,4]); }\n"
         "#multmatrix([[1,0,0,4],[0,1,0,-1],[0,0,1,0],[0,0,0,1]]) cube(size=[2,2,5]);\n"
         "%multmatrix([[1,0,0,5],[0,1,0,-1],[0,0,1,0],[0,0,0,1]]) cube(size=[3,2,6]);\n");
    struct rays rays = rays_from_above(SIDE);
    map_depths(&m, &rays, depths);
    float plate = depths[at(-5, 0)];
    assert_true(depths[at(0, 0)] == plate + 1);
    assert_true(depths[at(4, 0)] == plate - 3);
    assert_true(depths[at(5, 0)] == plate - 3);
    assert_true(isinf(depths[at(7, 0)]));
    char *legend = map_legend(&m, &s.model), *line = strrchr(legend, ' ');
    assert_string_equal(line, " highlight\n");
    assert_memory_equal(line - 13, "unit.csg:3:57", 13);
    free(legend);
    map_free(&m);
    stage_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depths_are_millimetres),
        cmocka_unit_test(flat_picture_is_nearest),
        cmocka_unit_test(nothing_has_no_range),
        cmocka_unit_test(normals_look_at_the_viewer),
        cmocka_unit_test(leaves_have_colours_and_a_legend),
        cmocka_unit_test(nearest_body_counts),
        cmocka_unit_test(marks_are_no_part_of_the_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
