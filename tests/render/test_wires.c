// test_wires.c - edges and vertices of a result, against OpenSCAD's picture of the same model.
#include "render/wires.h"

#include "csg/csg.h"
#include "render/camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

enum { WIDTH = 72, HEIGHT = 60 };

// Two cubes that are flush, as one body, and a pit.
static const char text[] = "difference() { union() { cube(size = [10, 10, 10], center = false);"
                           " multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {"
                           " cube(size = [10, 10, 5], center = false); } }"
                           " multmatrix([[1,0,0,3],[0,1,0,3],[0,0,1,2],[0,0,0,1]]) {"
                           " cube(size = [4, 4, 20], center = false); } }";

// --render --view=wireframe --imgsize=72,60 --camera=10,5,5,50,0,30,60, rows from the top: edges
// and vertices, in capitals, of what was added (e) and taken away (b)
static const char expected[] =
    "........................................................................"
    "........................................................................"
    "................EEEEEEEEEE.............................................."
    "................EEEEEEEEEE.............................................."
    "................EEEEEeEEEE.............................................."
    "................EEEEeeeeeE.............................................."
    "................EEEeeeeeeeee............................................"
    "................EEBBBBBBBBBBeeee........................................"
    "................eeBBBBBBBBBBeeeeeee..EEEEEEEEEE........................."
    "...............eeeBBBBBBBBBBeeeeeeeeeEEEEEEEEEE........................."
    "..............eeeeBBBBbBbbBBBBBBBBBBBEEEEEEEEEE........................."
    ".............eeeeeBBBbbBbbbBBBBBBBBBBEEEEEEEEEE........................."
    "...........eeBBBBBBBBBBBbbbBBBBBBBBBBEEEEEEEEEE........................."
    "..........eeeBBBBBBBBBBBbbbBBBBbBBBBBEEEeeeeeEE........................."
    "..EEEEEEEEEEeBBBBBBBBBBBbbbBBBbbBBBBBEEeeeeeEEE........................."
    "..EEEEEEEEEEeBBBBBbbBBBBBBBBBBBbBBBBBEeeeeeEEEE........................."
    "..EEEEeEEEEEeBBBBBbbbBBBBBBBBBBbBBBBBeeeeeEEEEE........................."
    "..EEEEeeeeEE.BBBBBbbbBBBBBBBBBBbBBBBeeeeeEEEEEE........................."
    "..EEEEeeeeeeeBBBBBbbbBBBBBbBBBBBBBBeeeeeeeeeeEE........................."
    "..EEEEeeeeeeeeeBBBbbbBBBBBbBBBBBBBeeeeeEeeeeeEE........................."
    "..EEEEeeeeeeeeeeeeBBbBBBBBbBBBBbbeeeeeEEeeeeeEE........................."
    "..EEEEEeeeeeeeeeeeeeeBBBBBbBBBBbeeeeeEEEeeeeeEE........................."
    "..EEEEEEEEeeeeeeeeeeeeeBEEEEEEEEEEee.EEeeeeeeee........................."
    "..EEEEEEEEEE.eeeeeeeeeeeEEEEEEEEEEe..EEeeeeeeeeeee......................"
    ".....eeeee.....eeeeeeeeeEEEEEEEEEEb..Eeeeeeeeeeeeeee...................."
    ".....eeeee......bbeeeeeeEEEEEEEEEEb..Eeeeeeeeeeeeeeeeee................."
    ".....eeeee......bbbbbeeeEEEEEEEEEEbBBeeeeeEEeeeeeeeeeeeeee.EEEEEEEEEE..."
    ".....eeeee......bbbbbBbeEEEEEEEEEEbBeeeeeEEEEEEeeeeeeeeeeeeEEEEEEEEEE..."
    "......eeeee...BBbbbbbBBBEEEEEEEEEEbeeeee..........eeeeeeeeeEEEEEEEEEE..."
    "......eeeee...BBbbbbbBBBEEEEEEEEEEeeeeeee...........eeeeeeeEEEEEEEEEE..."
    "......eeeee...BBbbbbbBBBEEEEEEEEEEeeeeeeeee............eeeeEEEEEEEEEE..."
    "......eeeee...BBBbbbbbBBEEEEEEEEEEeeeeeeeeeeee............eEEEeeeeeEE..."
    "......eeeee..eBBBbbbbbBBEEEeeeeeEEeeBeeeeeeeeeeee..........EEeeeeeEEE..."
    ".....EeeeeeEEEBBBBBbbbBBEEEeeeeeEEeBB.eeeeeeeeeeeee........EeeeeeEEEE..."
    ".....EEeeeeeEEBBBBBbbbBBEEEeeeeeEEBBB....eeeeeeeeeeeee.....EeeeeeEEEE..."
    ".....EEeeeeeEEBBBBBBbbBBEEEeeeeeEEBBB......eeeeeeeeeeeeee.EeeeeeEEEEE..."
    ".....EEeeeeeEEBBBBBBBBBBEEEeeeeeeE............eeeeeeeeeeeeeeeeeeeeEE...."
    ".....EEeeeeeeeBBBBBBBBBBEEEEEeeeeeee.............eeeeeeeeeeeeeeeeeEE...."
    ".....EEEEEeeeeee......BBEEEEEeeeeeeeee.............eeeeeeeeeeeeeeeEE...."
    ".....EEEEEeeeeeeeee...BBEEEEEeeeeeeeeeeee.............eeeeeeeeeeeEEE...."
    ".....EEEEEeeeeeeeeeee.BBEEEEEEEeeeeeeeeeeee.............eeeeeeeeeEEE...."
    ".....EEEEEEEeeeeeeeeeeeeEEEEEEEEEeeeeeeeeeeeee.........eeeeeeeeeeEEE...."
    ".....EEEEEEEEEeeeeeeeeeeee..........eeeeeeeeeeee.EEEEEEEEEEeeeeeEEEE...."
    "................eeeeeeeeeeee..........eeeeeeeeeeeEEEEEEEEEEeeeeEEEEE...."
    "...................eeeeeeeeeeee..........eeeeeeeeEEEEEEEEEEeeeeEEEEE...."
    ".....................eeeeeeeeeeee..........eeeeeeEEEEEEEEEEeee.........."
    "........................eeeeeeeeeee...........eeeEEEEEEEEEEee..........."
    "..........................eeeeeeeeeeee..........eEEEEEEEEEEee..........."
    "............................eeeeeeeeeeee.........EEEEEEEEEEe............"
    "...............................eeeeeeeeeee.......EEEEEEEEEE............."
    ".................................eeeeeeeeeeee....EEEEEEEEEE............."
    "...................................eeeeeeeeeeee.EEEEEEEEEEE............."
    "......................................eeeeeeeeeeEEeeeeeEEE.............."
    "........................................eeeeeeeeEEeeeeeEEE.............."
    "..........................................eeeeeeEEeeeeeEEE.............."
    ".............................................eeeEEeeeeeEEE.............."
    "...............................................eEEEEEEEEEE.............."
    "................................................EEEEEEEEEE.............."
    "................................................EEEEEEEEEE.............."
    "................................................EEEEEEEEEE..............";

static char letter_of(const uint8_t *p, const struct scheme *s)
{
    const struct rgb colours[] = {s->background, s->edge_front, s->edge_back};
    for (int i = 0; i < 3; i++)
        if (memcmp(p, &colours[i], 3) == 0)
            return ".eb"[i];
    return p[0] == 255 ? 'E' : 'B';
}

static void wires_are_those_of_openscad(void **state)
{
    (void)state;
    uint32_t count;
    const struct scheme *scheme = scheme_list(&count);
    struct csg_tree tree;
    struct messages messages = {0};
    char copy[sizeof text + 1] = {0};
    memcpy(copy, text, sizeof text);
    assert_true(csg_parse(&tree, "x.csg", copy, strlen(text), &messages));
    struct model_options options = MODEL_DEFAULTS;
    options.mode = MODEL_RENDER;
    struct solid_store *store = solid_store_new();
    struct model model;
    model_build(&model, &tree, store, &options, &messages);
    assert_int_equal(messages.count, 0);

    static uint8_t rgb[3 * WIDTH * HEIGHT];
    static float depth[WIDTH * HEIGHT];
    const struct canvas c = {WIDTH, HEIGHT, rgb, depth};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        memcpy(rgb + 3 * i, &scheme->background, 3);
        depth[i] = INFINITY;
    }
    struct camera camera = {{10, 5, 5}, {50, 0, 30}, 60, 22.5, false};
    struct rays rays = camera_rays(&camera, WIDTH, HEIGHT, model.bounds);
    struct facets *facets = facets_new(&model);
    struct device *device = cpu_device_new();
    const struct render_settings settings = {.epsilon = 1e-4};
    wires_draw(&c, device, &model, scheme, facets, &rays, &settings);

    // What lies at the same depth, a vertex and the edge through it, is told apart by rounding.
    int differences = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        differences += letter_of(rgb + 3 * i, scheme) != expected[i];
    if (differences > 26)
        fail_msg("%d pixels differ", differences);
    device_delete(device);
    facets_delete(facets);
    model_free(&model);
    solid_store_delete(store);
    csg_free(&tree);
    messages_free(&messages);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(wires_are_those_of_openscad)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
