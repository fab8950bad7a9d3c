// test_picture.c - bodies laid over each other, with a device that answers from a script.
#include "render/picture.h"

#include "base/mem.h"
#include "render/camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

enum { WIDTH = 4, HEIGHT = 37, PIXELS = WIDTH * HEIGHT, BODIES = 3, SPANS = 3 };

// What the device below answers for every pixel of a body.
struct script {
    struct span spans[SPANS];
    uint32_t count;
};
static struct script scripts[BODIES];
static struct body bodies[BODIES];

static int first_surface(struct device *d, const struct body *body, const struct rays *rays,
                         const struct render_settings *settings, struct surface_image *out,
                         void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                         void *context, struct render_stats *stats, struct error *err)
{
    (void)d, (void)settings, (void)err;
    const struct script *s = &scripts[body - bodies];
    for (int i = 0; i < rays->width * rays->height; i++) {
        out->leaf[i] = s->count ? s->spans[0].enter_leaf : SURFACE_NONE;
        out->face[i] = s->spans[0].enter_face;
        out->depth[i] = s->count ? s->spans[0].enter : INFINITY;
    }
    drawn(context, (struct pixel_rect){0, 0, rays->width, rays->height}, !s->count);
    stats->fragments = 1;
    return rays->height;
}

static int spans_of(struct device *d, const struct body *body, const struct rays *rays,
                    const struct render_settings *settings,
                    void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                    void *context, struct render_stats *stats, struct error *err)
{
    (void)d, (void)settings, (void)err;
    const struct script *s = &scripts[body - bodies];
    uint32_t first[WIDTH + 1];
    struct span spans[WIDTH * SPANS];
    for (uint32_t x = 0; x <= WIDTH; x++)
        first[x] = x * s->count;
    for (uint32_t i = 0; i < WIDTH * s->count; i++)
        spans[i] = s->spans[i % s->count];
    for (int y = 0; y < rays->height; y++)
        sink(context, 0, &(struct span_block){0, y, WIDTH, y + 1, first, spans});
    stats->fragments = 10;
    return rays->height;
}

static const struct device_kind kind = {.first_surface = first_surface, .spans = spans_of};
static struct device device = {.kind = &kind};

static double nx[8] = {-1, 1, 0, 0, 0, 0, -1, -1}, ny[8] = {0, 0, -1, 1},
              nz[8] = {0, 0, 0, 0, -1, 1}, plane_d[8] = {0, 1, 0, 1, 0, 1};
static const struct solid cube = {.convex = true, .planes = {nx, ny, nz, plane_d, 6, 8}};
enum { TOP = 5 };

// Three leaves per body; 0 and 1 are an intersection, 2 stands alone.
static struct leaf leaves[BODIES][3];
static struct expr_node nodes[] = {
    {.op = EXPR_LEAF, .parent = 2, .minus = EXPR_NONE, .leaf = 0},
    {.op = EXPR_LEAF, .parent = 2, .minus = EXPR_NONE, .leaf = 1},
    {.op = EXPR_INTERSECTION, .parent = 4, .first = 0, .count = 2, .minus = EXPR_NONE},
    {.op = EXPR_LEAF, .parent = 4, .minus = EXPR_NONE, .leaf = 2},
    {.op = EXPR_UNION, .parent = EXPR_NONE, .first = 2, .count = 2, .minus = EXPR_NONE},
};
static uint32_t kids[] = {0, 1, 2, 3}, leaf_node[] = {0, 1, 3};

static int setup(void **state)
{
    (void)state;
    static const enum body_kind kinds[BODIES] = {BODY_MAIN, BODY_BACKGROUND, BODY_HIGHLIGHT};
    memset(scripts, 0, sizeof scripts);
    for (int b = 0; b < BODIES; b++) {
        for (int i = 0; i < 3; i++)
            leaves[b][i] = (struct leaf){.solid = &cube,
                                         .to_world = AFFINE_IDENTITY,
                                         .to_local = AFFINE_IDENTITY,
                                         .colour = {-1, -1, -1, -1}};
        bodies[b] = (struct body){
            .kind = kinds[b],
            .leaves = leaves[b],
            .leaf_count = 3,
            .expr = {.nodes = nodes,
                     .node_count = 5,
                     .kids = kids,
                     .root = 4,
                     .leaf_node = leaf_node,
                     .leaf_count = 3},
        };
    }
    return 0;
}

static struct span solid_span(float enter, float leave, uint32_t leaf)
{
    return (struct span){enter, leave, leaf, TOP, leaf, TOP};
}

// Draws the bodies and checks that all pixels have this colour and this nearest depth.
static void expect(int body_count, const char *scheme, int r, int g, int b, float depth)
{
    struct error err;
    const struct model model = {.bodies = bodies, .body_count = (uint32_t)body_count};
    struct shader shader;
    shader_init(&shader, &model, scheme_find(scheme, &err));
    struct camera c = CAMERA_DEFAULTS;
    struct rays rays = camera_rays(&c, WIDTH, HEIGHT, BOX_EMPTY);
    struct render_settings settings = {.epsilon = 1e-3, .threads = 2};
    struct render_stats stats;
    struct picture p = {0};
    picture_draw(&p, &device, &shader, &rays, &settings, &stats);
    for (int i = 0; i < PIXELS; i++) {
        if (p.rgb[3 * i] != r || p.rgb[3 * i + 1] != g || p.rgb[3 * i + 2] != b)
            fail_msg("pixel %d: (%d,%d,%d), not (%d,%d,%d)", i, p.rgb[3 * i], p.rgb[3 * i + 1],
                     p.rgb[3 * i + 2], r, g, b);
        assert_true(p.depth[i] == depth);
    }
    picture_free(&p);
    shader_free(&shader);
}

static void nothing_is_the_background(void **state)
{
    (void)state;
    expect(0, "Cornfield", 255, 255, 229, INFINITY);
    expect(1, "Cornfield", 255, 255, 229, INFINITY);
    expect(3, "Metallic", 170, 170, 255, INFINITY);
}

static void opaque_body_shows(void **state)
{
    (void)state;
    scripts[0] = (struct script){{solid_span(3, 5, 0)}, 1};
    expect(1, "Cornfield", 250, 216, 44, 3);
}

static void lone_background_shows_both_sides(void **state)
{
    (void)state;
    scripts[1] = (struct script){{solid_span(3, 5, 2)}, 1};
    // 181 twice over (255, 255, 229), each time with 128/255
    expect(2, "Cornfield", 200, 200, 193, 3);
}

static void cut_background_shows_its_nearest_surface(void **state)
{
    (void)state;
    scripts[1] = (struct script){{solid_span(3, 5, 0), solid_span(7, 8, 1)}, 2};
    expect(2, "Cornfield", 218, 218, 205, 3);
}

static void highlight_on_the_model_mixes(void **state)
{
    (void)state;
    scripts[0] = (struct script){{solid_span(3, 5, 2)}, 1};
    scripts[2] = (struct script){{solid_span(3.0005f, 5, 2)}, 1};
    expect(3, "Cornfield", 253, 149, 63, 3.0005f);
}

static void hidden_bodies_stay_hidden(void **state)
{
    (void)state;
    scripts[0] = (struct script){{solid_span(3, 5, 2)}, 1};
    scripts[1] = scripts[2] = (struct script){{solid_span(4, 6, 2)}, 1};
    expect(3, "Cornfield", 250, 216, 44, 3);
    memcpy(leaves[1][2].colour, (float[4]){1, 0, 0, 1}, sizeof(float[4])); // opaque, and still
    expect(3, "Cornfield", 250, 216, 44, 3);
}

static void opaque_background_in_front_hides(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++)
        memcpy(leaves[1][i].colour, (float[4]){1, 0, 0, 1}, sizeof(float[4]));
    scripts[0] = (struct script){{solid_span(3, 5, 2)}, 1};
    scripts[1] = (struct script){{solid_span(2, 6, 2)}, 1};
    expect(3, "Cornfield", 255, 0, 0, 2);
}

static void glass_in_front_of_opaque(void **state)
{
    (void)state;
    leaves[0][2].colour[3] = 0.5f;
    scripts[0] =
        (struct script){{solid_span(1, 2, 2), solid_span(3, 4, 0), solid_span(5, 6, 2)}, 3};
    expect(1, "Cornfield", 250, 216, 44, 1); // yellow on yellow on yellow
    memcpy(leaves[0][2].colour, (float[4]){0, 0, 1, 0}, sizeof(float[4]));
    expect(1, "Cornfield", 250, 216, 44, 1); // invisible, and in the depth all the same
}

static void solid_at_the_far_end_has_no_far_side(void **state)
{
    (void)state;
    scripts[1] = (struct script){{solid_span(3, 5, 2)}, 1};
    scripts[1].spans[0].leave_leaf = SURFACE_NONE;
    expect(2, "Cornfield", 218, 218, 205, 3);
}

static void gradient_runs_from_top_to_bottom(void **state)
{
    (void)state;
    struct error err;
    const struct model model = {0};
    struct shader shader;
    shader_init(&shader, &model, scheme_find("ClearSky", &err));
    struct camera c = CAMERA_DEFAULTS;
    struct rays rays = camera_rays(&c, 3, 200, BOX_EMPTY);
    struct render_stats stats;
    struct picture p = {0};
    picture_draw(&p, &device, &shader, &rays, &(struct render_settings){0}, &stats);
    assert_memory_equal(p.rgb, "\x87\xce\xeb", 3);
    assert_memory_equal(p.rgb + 3 * (3 * 200 - 1), "\xc9\xe9\xf6", 3);
    picture_free(&p);
    picture_free(&p);
    shader_free(&shader);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(nothing_is_the_background, setup),
        cmocka_unit_test_setup(opaque_body_shows, setup),
        cmocka_unit_test_setup(lone_background_shows_both_sides, setup),
        cmocka_unit_test_setup(cut_background_shows_its_nearest_surface, setup),
        cmocka_unit_test_setup(highlight_on_the_model_mixes, setup),
        cmocka_unit_test_setup(hidden_bodies_stay_hidden, setup),
        cmocka_unit_test_setup(opaque_background_in_front_hides, setup),
        cmocka_unit_test_setup(glass_in_front_of_opaque, setup),
        cmocka_unit_test_setup(solid_at_the_far_end_has_no_far_side, setup),
        cmocka_unit_test(gradient_runs_from_top_to_bottom),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
