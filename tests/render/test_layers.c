// test_layers.c - see-through objects in OpenSCAD's order.
//
// The colours are those of the pixel in the middle as OpenSCAD 2021.01 draws it with
// --camera=0,0,0,0,0,0,100 --projection=o --imgsize=64,64.
#include "render/picture.h"

#include "unit.h"

enum { SIZE = 64 };

#define UP   "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,8],[0,0,0,1]])"
#define HALF "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,1],[0,0,0,1]])"
#define RED  "color([1,0,0,0.4]) cube(size=[10,10,4],center=true);"
#define BLUE "color([0,0,1,0.6]) cube(size=[8,8,4],center=true);"

static const struct {
    const char *name, *text;
    int rgb[3];
} cases[] = {
    {"red, then blue above it", RED " " UP " " BLUE, {35, 15, 180}},
    {"blue, then red below it", UP " " BLUE " " RED, {41, 41, 203}},
    {"invisible, and hides all the same",
     UP " color([0,1,0,0]) cube(size=[8,8,4],center=true); cube(size=[9,9,9],center=true);",
     {255, 255, 229}},
    {"opaque, then red around it", "cube(size=[2,2,2],center=true); " RED, {195, 100, 20}},
    {"red, then opaque in it", RED " cube(size=[2,2,2],center=true);", {218, 92, 82}},
    {"cut: its nearest surface",
     "difference() { " RED
     " multmatrix([[1,0,0,5],[0,1,0,5],[0,0,1,0],[0,0,0,1]]) cube(size=[4,4,9],center=true); }",
     {232, 153, 137}},
    {"cut by what its box misses: both sides",
     "difference() { " RED
     " multmatrix([[1,0,0,9],[0,1,0,9],[0,0,1,0],[0,0,0,1]]) cube(size=[4,4,9],center=true); }",
     {218, 92, 82}},
    {"the floor of a cut", "difference() { " RED " " HALF " " BLUE " }", {102, 102, 211}},
    {"a union that is cut: two products",
     "difference() { union() { " RED " " HALF
     " color([0,1,0,0.8]) cube(size=[6,6,4],center=true); } "
     "multmatrix([[1,0,0,4],[0,1,0,4],[0,0,1,0],[0,0,0,1]]) cube(size=[3,3,9],center=true); }",
     {46, 189, 27}},
    {"a - (b - c) = a - b + a c",
     "difference() { " RED " difference() { " HALF " " BLUE " " HALF
     " color([0,1,0,0.2]) cube(size=[3,3,3],center=true); } }",
     {140, 61, 127}},
    {"intersection with a union: what is left of it twice shows twice",
     "intersection() { " RED " union() { " HALF " " BLUE
     " color([0,1,0,0.2]) cylinder($fn=8,h=3.2,r1=3,r2=3,center=true); } }",
     {218, 92, 82}},
    {"background after the model", "%" UP " cube(size=[8,8,4],center=true); " RED, {159, 128, 125}},
    {"of backgrounds that begin a union the first one comes last",
     "color([1,0,0,0.4]) %cube(size=[10,10,4],center=true); color([0,0,1,0.6]) %" UP
     " cube(size=[8,8,4],center=true); multmatrix([[1,0,0,20],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
     "cube(size=[1,1,1]);",
     {41, 41, 203}},
    {"background, then highlight",
     "#" UP " cube(size=[8,8,4],center=true); %" HALF " cube(size=[8,8,4],center=true); " RED,
     {193, 77, 75}},
    {"highlight on what is alone",
     "#color([0,0,1,0.2]) cube(size=[10,10,4],center=true);",
     {180, 113, 141}},
    {"halves of an alpha go to the even number",
     "difference() { color([0,0,1,0.3]) cube(size=[10,10,4],center=true); "
     "multmatrix([[1,0,0,5],[0,1,0,5],[0,0,1,0],[0,0,0,1]]) cube(size=[4,4,9],center=true); }",
     {179, 179, 220}},
    {"a hole in one member of a union shows the other",
     "difference() { union() { " UP " " BLUE " " RED " } " UP " cube(size=[2,2,9],center=true); }",
     {218, 92, 82}},
    {"no two backgrounds are cut from each other",
     "difference() { %cube(size=[10,10,4],center=true); %" HALF
     " cube(size=[8,8,4],center=true); }",
     {168, 168, 162}},
    {"what is marked further in comes first",
     "multmatrix([[1,0,0,20],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size=[1,1,1]); "
     "color([1,0,0,0.4]) %cube(size=[10,10,4],center=true); group() { "
     "multmatrix([[1,0,0,20],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size=[1,1,1]); "
     "color([0,0,1,0.6]) %" UP " cube(size=[8,8,4],center=true); }",
     {41, 41, 203}},
    {"a marked tool that misses the marked object is shown",
     "difference() { #cube(size=[10,10,4],center=true); #" UP " cube(size=[8,8,4],center=true); }",
     {197, 89, 56}},
    {"a marked tool that cuts the marked object is not",
     "difference() { #cube(size=[10,10,4],center=true); #" HALF
     " cube(size=[8,8,4],center=true); }",
     {160, 111, 63}},
};

static void draw(struct picture *p, const char *text, bool by_file)
{
    struct stage s;
    struct render_stats stats;
    struct camera camera = {.distance = 100, .fov = 22.5, .orthographic = true};
    stage_make(&s, text);
    struct layers *layers = layers_new(&s.shader);
    s.shader.layers = by_file ? layers : NULL;
    struct rays rays = camera_rays(&camera, SIZE, SIZE, s.model.bounds);
    picture_draw(p, s.device, &s.shader, &rays, &s.settings, &stats);
    layers_delete(layers);
    stage_free(&s);
}

static const uint8_t *middle(const struct picture *p)
{
    return p->rgb + 3 * ((SIZE / 2 - 1) * SIZE + SIZE / 2);
}

static void openscads_pixels(void **state)
{
    (void)state;
    struct picture p = {0};
    for (size_t i = 0; i < array_count(cases); i++) {
        draw(&p, cases[i].text, true);
        const uint8_t *c = middle(&p);
        const int *w = cases[i].rgb;
        if (c[0] != w[0] || c[1] != w[1] || c[2] != w[2])
            fail_msg("%s: (%d,%d,%d), not (%d,%d,%d)", cases[i].name, c[0], c[1], c[2], w[0], w[1],
                     w[2]);
    }
    picture_free(&p);
}

static void sorted_does_not_depend_on_the_order(void **state)
{
    (void)state;
    struct picture p = {0}, q = {0};
    draw(&p, RED UP BLUE, false);
    draw(&q, UP BLUE RED, false);
    assert_memory_equal(p.rgb, q.rgb, 3 * SIZE * SIZE);
    assert_memory_equal(middle(&p), ((uint8_t[]){35, 15, 180}), 3); // as OpenSCAD's first case
    picture_free(&p);
    picture_free(&q);
}

// Opaque objects that follow each other are one layer, and an opaque body has none.
static void layers_are_few(void **state)
{
    (void)state;
    struct stage s;
    stage_make(&s, "cube(size=[1,1,1]); sphere($fn=8,r=1); difference() { cube(size=[2,2,2]); "
                   "cube(size=[1,1,1]); }" RED
                   "cube(size=[1,1,1]); sphere($fn=8,r=1); %cube(size=[1,1,1]);"
                   "color([1,0,0,1]) %cube(size=[1,1,1]);");
    struct layers *layers = layers_new(&s.shader);
    assert_int_equal(layers->body_count, 3);
    assert_int_equal(layers->bodies[0].count, 3);
    assert_int_equal(layers->bodies[0].items[0].body.leaf_count, 4);
    assert_false(layers->bodies[0].items[0].see_through);
    assert_true(layers->bodies[0].items[1].both_sides);
    assert_int_equal(layers->bodies[0].items[1].leaf_of[0], 4);
    assert_int_equal(layers->bodies[0].items[2].body.leaf_count, 2);
    assert_int_equal(layers->bodies[1].count, 1);
    assert_int_equal(layers->bodies[2].count, 0);
    assert_false(layers->repeat);
    layers_delete(layers);
    stage_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(openscads_pixels),
        cmocka_unit_test(sorted_does_not_depend_on_the_order),
        cmocka_unit_test(layers_are_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
