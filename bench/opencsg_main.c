// opencsg_main.c - hcsg-bench-opencsg: frame times of OpenCSG on a scene, for hcsg-bench.
//
// As OpenSCAD uses it: the expression becomes a union of products; OpenCSG writes the depth of each
// product of more than one primitive, and what has that depth is drawn lit. A product of one
// primitive is drawn plainly. Prints "key value" lines, "frame MS" as soon as each is drawn.
#include "base/clock.h"
#include "base/mem.h"
#include "csg/csg.h"
#include "drawn.h"
#include "io/write_png.h"
#include "opencsg_c.h"
#include "products.h"
#include "program.h"
#include "turn.h"

#include <stdlib.h>
#include <string.h>

static struct {
    const char *algorithm, *picture;
    bool boxes;
    uint32_t size, frames;
    double limit;
} given = {.algorithm = "automatic", .size = 1024, .frames = TURN_VIEWS, .limit = 6};

static const struct option options[] = {
    {"algorithm", 0, OPTION_TEXT, "NAME", "automatic (default), scs or goldfeather",
     &given.algorithm, 0, 0},
    {"boxes", 0, OPTION_FLAG, NULL, "tell OpenCSG the boxes of the primitives", &given.boxes, 0, 0},
    {"size", 0, OPTION_COUNT, "N", "side of the picture in pixels (default 1024)", &given.size, 16,
     8192},
    {"frames", 0, OPTION_COUNT, "N", "views to draw after the first (default 13)", &given.frames, 1,
     1000},
    {"limit", 0, OPTION_NUMBER, "S", "draw no further view after so many seconds (default 6)",
     &given.limit, 0, 1e6},
    {"picture", 0, OPTION_TEXT, "FILE", "write the first view as PNG", &given.picture, 0, 0},
};

static const struct program program = {
    .name = "hcsg-bench-opencsg",
    .version = HCSG_VERSION,
    .summary = "Frame times of OpenCSG, drawing a .csg file.",
    .operands = "FILE",
    .options = options,
    .option_count = array_count(options),
};

// Per leaf, products being drawn one after the other.
struct opponent {
    struct drawn *drawn;
    struct products products;
    struct opencsg_product **primitives; // NULL for products of one primitive
};

static void draw_depth(void *context, uint32_t leaf)
{
    drawn_depth(context, leaf);
}

static bool parse_algorithm(enum opencsg_algorithm *out, struct error *err)
{
    static const char *const names[] = {"automatic", "scs", "goldfeather"};
    for (size_t i = 0; i < array_count(names); i++) {
        if (strcmp(names[i], given.algorithm) == 0) {
            *out = (enum opencsg_algorithm)i;
            return true;
        }
    }
    error_set(err, "--algorithm: expected automatic, scs or goldfeather, got '%s'",
              given.algorithm);
    return false;
}

static bool opponent_init(struct opponent *o, const struct body *body, struct error *err)
{
    enum opencsg_algorithm algorithm;
    if (!parse_algorithm(&algorithm, err) || !drawn_new(&o->drawn, body, (int)given.size, err))
        return false;
    opencsg_choose(algorithm);

    struct box *boxes = mem_alloc((body->leaf_count + 1) * sizeof *boxes);
    uint32_t convexity = 1;
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        boxes[i] = body->leaves[i].box;
        if (!body->leaves[i].solid->convex)
            convexity = 10; // what OpenSCAD's users write when one is not enough
    }
    products_build(&o->products, &body->expr, boxes);
    free(boxes);
    o->primitives = mem_zalloc((o->products.count + 1) * sizeof(struct opencsg_product *));
    for (uint32_t i = 0; i < o->products.count; i++) {
        const struct product *p = &o->products.items[i];
        if (p->count > 1)
            o->primitives[i] = opencsg_product_new(p->leaves, p->intersected, p->count, convexity,
                                                   draw_depth, o->drawn);
    }
    return true;
}

static void opponent_free(struct opponent *o)
{
    for (uint32_t i = 0; i < o->products.count; i++)
        opencsg_product_delete(o->primitives[i]);
    free(o->primitives);
    products_free(&o->products);
    drawn_delete(o->drawn);
    *o = (struct opponent){0};
}

static void draw_product(struct opponent *o, uint32_t i)
{
    const struct product *p = &o->products.items[i];
    if (!o->primitives[i]) {
        drawn_colour(o->drawn, p->leaves[0], DRAWN_OUTSIDE);
        return;
    }
    for (uint32_t n = 0; given.boxes && n < p->count; n++) {
        float box[6];
        drawn_box(o->drawn, p->leaves[n], box);
        opencsg_product_box(o->primitives[i], n, box);
    }
    opencsg_render(o->primitives[i]);
    drawn_equal(true);
    for (uint32_t n = 0; n < p->count; n++)
        drawn_colour(o->drawn, p->leaves[n], n < p->intersected ? DRAWN_OUTSIDE : DRAWN_INSIDE);
    drawn_equal(false);
}

static double draw_view(struct opponent *o, struct box scene, uint32_t view)
{
    struct rays rays = turn_view(scene, view, (int)given.size);
    double start = clock_seconds();
    drawn_begin(o->drawn, &rays);
    for (uint32_t i = 0; i < o->products.count; i++)
        draw_product(o, i);
    drawn_end(o->drawn);
    double seconds = clock_seconds() - start;
    printf("frame %.4f\n", seconds * 1e3);
    fflush(stdout);
    return seconds;
}

static bool bench(const struct model *m, struct error *err)
{
    struct opponent o = {0};
    bool ok = opponent_init(&o, &m->bodies[0], err);
    if (!ok)
        goto done;
    uint32_t literals = 0;
    for (uint32_t i = 0; i < o.products.count; i++)
        literals += o.products.items[i].count;
    printf("renderer %s\nproducts %u\nliterals %u\n", drawn_renderer(), o.products.count, literals);

    double seconds = draw_view(&o, m->bounds, 0);
    if (given.picture) {
        uint8_t *rgb = drawn_picture(o.drawn);
        ok = write_png(given.picture, rgb, (int)given.size, (int)given.size, err);
        free(rgb);
    }
    for (uint32_t view = 0; ok && view < given.frames && seconds < given.limit; view++)
        seconds += draw_view(&o, m->bounds, view);
done:
    opponent_free(&o);
    return ok;
}

static bool run(char **operands, int count, struct error *err)
{
    if (count != 1) {
        error_set(err, "expected one file; --help shows the options");
        return false;
    }
    struct messages messages = {0};
    struct csg_tree tree = {0};
    struct model model = {0};
    if (csg_parse_file(&tree, operands[0], &messages)) {
        struct solid_store *solids = solid_store_new();
        model_build(&model, &tree, solids, &MODEL_DEFAULTS, &messages);
        solid_store_delete(solids);
    }
    messages_print(&messages, stderr);
    bool drawable = model.body_count && model.bodies[0].leaf_count;
    if (!drawable)
        error_set(err, "%s: nothing to draw", operands[0]);
    bool ok = drawable && bench(&model, err);
    model_free(&model);
    csg_free(&tree);
    messages_free(&messages);
    return ok;
}

int main(int argc, char **argv)
{
    return program_main(&program, argc, argv, run);
}
