// test_modes.c - pictures of the modes, pixel by pixel against OpenSCAD's own.
#include "render/extent.h"
#include "render/layers.h"
#include "render/picture.h"
#include "unit.h"

#define AT(x, y, z) "multmatrix([[1,0,0," #x "],[0,1,0," #y "],[0,0,1," #z "],[0,0,0,1]]) "

enum { SIZE = 512 };

struct probe {
    int x, y;
    int r, g, b; // as OpenSCAD 2021.01 drew it
};

static void draw(struct picture *p, struct stage *s, const struct camera *camera)
{
    struct render_stats stats;
    struct rays rays = camera_rays(camera, SIZE, SIZE, s->model.bounds);
    struct layers *layers = layers_new(&s->shader);
    s->shader.layers = layers;
    picture_draw(p, s->device, &s->shader, &rays, &s->settings, &stats);
    layers_delete(layers);
}

// With OpenSCAD's default camera unless another one is given.
static void expect(enum model_mode mode, const char *scheme, const char *camera_text,
                   const char *text, const struct probe *probes, size_t count)
{
    struct stage s;
    struct picture p = {0};
    struct error err;
    struct camera camera = CAMERA_DEFAULTS;
    stage_make_as(&s, mode, text);
    shader_free(&s.shader);
    shader_init(&s.shader, &s.model, scheme_find(scheme, &err));
    struct box box = mode == MODEL_RENDER && !s.model.flat
                         ? extent_find(s.device, &s.model, &s.settings)
                         : s.model.bounds;
    if (camera_text) {
        assert_true(camera_parse(&camera, camera_text, &err));
    } else {
        camera_autocenter(&camera, box);
        camera_viewall(&camera, box);
    }
    draw(&p, &s, &camera);
    for (size_t i = 0; i < count; i++) {
        const uint8_t *rgb = p.rgb + 3 * ((size_t)probes[i].y * SIZE + (size_t)probes[i].x);
        if (abs(rgb[0] - probes[i].r) > 1 || abs(rgb[1] - probes[i].g) > 1 ||
            abs(rgb[2] - probes[i].b) > 1)
            fail_msg("%s at %d, %d: (%d, %d, %d)", text, probes[i].x, probes[i].y, rgb[0], rgb[1],
                     rgb[2]);
    }
    picture_free(&p);
    stage_free(&s);
}
#define EXPECT(mode, scheme, camera, text, ...)                                                    \
    expect(mode, scheme, camera, text, (const struct probe[]){__VA_ARGS__},                        \
           sizeof((const struct probe[]){__VA_ARGS__}) / sizeof(struct probe))

static const char cut_twice[] = "color([1,0,0]) difference() { cube(10); difference() { " AT(
    3, -3, 3) "cube(10);" AT(5, -5, 5) "cube([3,20,3]); } }";

static void geometry_tells_material_from_cuts(void **state)
{
    (void)state;
    EXPECT(MODEL_RENDER, "Tomorrow", NULL, cut_twice, {250, 60, 62, 154, 160},
           {150, 280, 155, 121, 0}, {260, 200, 62, 154, 160}, {280, 330, 41, 101, 105});
    // A shape of its own has the colour of previews.
    EXPECT(MODEL_RENDER, "Tomorrow", NULL, "color([1,0,0]) cube(10);", {250, 100, 66, 113, 175});
}

static void flat_models_are_unlit(void **state)
{
    (void)state;
    EXPECT(MODEL_RENDER, "Tomorrow", NULL, "square([10,5]); circle(2);", {250, 250, 113, 140, 0});
    // Their borders are two pixels wide: here the lower one of a square as large as the picture.
    EXPECT(MODEL_RENDER, "Cornfield", "0,0,0,0,0,0,643.49", "square(128, center = true);",
           {256, 383, 255, 0, 0}, {256, 384, 255, 0, 0}, {256, 381, 0, 191, 153},
           {256, 386, 255, 255, 229});
}

static const char inside_out[] =
    "polyhedron(points = [[0,0,0],[10,0,0],[10,10,0],[0,10,0],[0,0,10],[10,0,10],[10,10,10],"
    "[0,10,10]], faces = [[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]);";
static const char one_face_turned[] =
    "polyhedron(points = [[0,0,0],[10,0,0],[10,10,0],[0,10,0],[0,0,10],[10,0,10],[10,10,10],"
    "[0,10,10]], faces = [[0,1,2,3],[4,5,6,7],[4,5,1,0],[5,6,2,1],[6,7,3,2],[7,4,0,3]]);";

static void back_faces_are_magenta(void **state)
{
    (void)state;
    EXPECT(MODEL_THROWN_TOGETHER, "Cornfield", NULL, inside_out, {250, 100, 255, 0, 255},
           {150, 300, 146, 0, 146}, {400, 300, 169, 0, 169});
    EXPECT(MODEL_THROWN_TOGETHER, "Cornfield", NULL, one_face_turned, {250, 100, 255, 0, 255},
           {150, 300, 143, 123, 25}, {400, 300, 165, 143, 29});
    // The eye inside of a cube that holds two others.
    EXPECT(MODEL_THROWN_TOGETHER, "Cornfield", "0,0,0,55,0,25,60",
           "cube(100, center = true); sphere(10, $fn = 20); color([1,0,0]) " AT(
               0, 40, 0) "cube([30, 40, 60], center = true);",
           {50, 50, 146, 0, 146}, {400, 60, 146, 0, 0}, {250, 250, 191, 165, 34},
           {50, 450, 255, 0, 255}, {480, 480, 146, 0, 0});
    // render() is one shape: the walls of its holes face outward.
    EXPECT(MODEL_THROWN_TOGETHER, "Cornfield", "0,0,0,0,0,0,50",
           "render() difference() { cube(10, center = true); " AT(
               0, 0, 2) "cube([5, 5, 10], center = true); }",
           {256, 256, 194, 167, 34});
}

static void shapes_show_whole(void **state)
{
    (void)state;
    EXPECT(MODEL_THROWN_TOGETHER, "Cornfield", NULL, "color([1,0,0]) cube(10); cube(10);",
           {250, 100, 250, 216, 44});
    EXPECT(MODEL_THROWN_TOGETHER, "Cornfield", NULL,
           "#difference() { cube(10); " AT(5, -5, 5) "cube(10); }", {60, 300, 173, 98, 91},
           {300, 60, 255, 125, 118}, {300, 300, 159, 72, 68});
}

static void marked_shapes_are_drawn_face_by_face(void **state)
{
    (void)state;
    EXPECT(
        MODEL_THROWN_TOGETHER, "Cornfield", NULL,
        "cube(10); %" AT(12, 0, 0) "cube(10); #" AT(24, 0, 0) "cube(10); %difference() { " AT(
            0, 12,
            0) "cube(10); " AT(5, 5,
                               5) "cube(10); } #difference() { " AT(12, 12,
                                                                    0) "cube(10); " AT(17, 5,
                                                                                       5) "cube(10)"
                                                                                          "; }",
        {30, 250, 143, 123, 25}, {150, 330, 179, 179, 166}, {300, 350, 200, 150, 137});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(geometry_tells_material_from_cuts),
        cmocka_unit_test(flat_models_are_unlit),
        cmocka_unit_test(back_faces_are_magenta),
        cmocka_unit_test(shapes_show_whole),
        cmocka_unit_test(marked_shapes_are_drawn_face_by_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
