// test_live.c - random series of edits, each model made from the one before, show what a fresh
// start on the saved text shows, bit by bit.
#include "unit.h"

#include "base/hash.h"
#include "base/mem.h"
#include "render/camera.h"
#include "render/device.h"

enum { SIZE = 32, SERIES = 200, EDITS = 6 };

struct writer {
    FILE *out;
    uint64_t random;
};

static uint32_t below(uint64_t *random, uint32_t n)
{
    return (uint32_t)((random_next(random) >> 32) * n >> 32);
}

static void write_leaf(struct writer *w)
{
    double size = 3 + below(&w->random, 10);
    fprintf(w->out, "multmatrix([[1, 0, 0, %u], [0, 1, 0, %u], [0, 0, 1, %u], [0, 0, 0, 1]]) ",
            below(&w->random, 12), below(&w->random, 12), below(&w->random, 12));
    switch (below(&w->random, 5)) {
    case 0:
        fprintf(w->out, "sphere($fn = 6, r = %g);\n", size / 2);
        break;
    case 1:
        fprintf(w->out, "cylinder($fn = 5, h = %g, r1 = %g, r2 = 2, center = true);\n", size,
                size / 3);
        break;
    case 2: // a mesh, for all the device knows
        fprintf(w->out,
                "polyhedron(points = [[0, 0, 0], [%g, 0, 0], [0, 9, 0], [2, 2, 7], [1, 1, 1]], "
                "faces = [[0, 1, 2], [0, 3, 4], [4, 3, 1], [0, 4, 1], [1, 3, 2], [0, 2, 3]]);\n",
                size);
        break;
    default:
        fprintf(w->out, "cube(size = [%g, %g, 4], center = false);\n", size, size / 2);
    }
}

// Operations in up to three levels; %, # and colours now and then.
static void write_tree(struct writer *w, int depth)
{
    static const char *const names[] = {"union",      "difference", "intersection",
                                        "difference", "group",      "hull"};
    uint32_t count = 2 + below(&w->random, 4);
    fprintf(w->out, "%s() {\n", names[below(&w->random, depth ? 5 : 3)]);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t kind = below(&w->random, 12);
        fputs(kind == 0   ? "#"
              : kind == 1 ? "%"
              : kind == 2 ? "color([1, 0, 0, 0.5]) "
                          : "",
              w->out);
        if (depth < 2 && below(&w->random, 3))
            write_tree(w, depth + 1);
        else
            write_leaf(w);
    }
    fputs("}\n", w->out);
}

static char *random_text(uint64_t seed)
{
    struct writer w = {.random = seed};
    char *text;
    size_t size;
    w.out = open_memstream(&text, &size);
    write_tree(&w, 0);
    if (below(&w.random, 2))
        write_tree(&w, 0);
    fclose(w.out);
    return text;
}

// Sums and hulls of booleans take their time: few of them.
static const char *const operations[] = {
    "union", "difference", "intersection", "group", "union", "difference",
    "union", "difference", "intersection", "hull",  "union", "intersection"};

static bool edit_something(struct edit *e, uint64_t *random)
{
    struct error err;
    struct csg_value v;
    const struct source *s = edit_source(e);
    switch (below(random, 8)) {
    case 0:
        return edit_undo(e);
    case 1:
        return edit_redo(e);
    }
    for (int tries = 0; tries < 20; tries++) {
        uint32_t n = below(random, s->node_count), a = below(random, 4), i = below(random, 15);
        if (edit_is_operation(edit_name(e, n)) && below(random, 2))
            return edit_set_operation(e, n, operations[below(random, array_count(operations))],
                                      &err);
        if (!edit_scalar(e, n, a, i, &v) || strcmp(edit_name(e, n), "color") == 0)
            continue;
        if (v.kind == CSG_BOOL)
            return edit_set_boolean(e, n, a, i, !v.boolean, &err);
        if (v.kind == CSG_NUMBER)
            return edit_set_number(e, n, a, i, v.number + below(random, 7) - 3.0, &err);
    }
    return false;
}

static void build(struct model *out, const struct csg_tree *tree, struct solid_store *store,
                  const struct model *before)
{
    struct messages messages = {0};
    struct model_options options = MODEL_DEFAULTS;
    options.before = before;
    model_build(out, tree, store, &options, &messages);
    messages_free(&messages);
}

struct view {
    float depth[SIZE * SIZE];
    uint32_t leaf[SIZE * SIZE], face[SIZE * SIZE];
};

static void look(struct view *out, struct device *d, const struct body *body, enum walk walk)
{
    struct camera c = CAMERA_DEFAULTS;
    struct render_settings settings = {.epsilon = 1e-4, .threads = 1, .walk = walk};
    struct surface_image image = {SIZE, SIZE, out->depth, out->leaf, out->face};
    c.centre = (struct vec3){8, 8, 6};
    c.distance = 80;
    struct rays rays = camera_rays(&c, SIZE, SIZE, (struct box){{0, 0, 0}, {20, 20, 20}});
    memset(out, 0, sizeof *out);
    device_first_surface(d, body, &rays, &settings, &image, NULL, NULL, NULL);
}

static void check_same(struct device *d, const struct model *a, const struct model *b)
{
    static struct view p, q;
    assert_int_equal(a->body_count, b->body_count);
    assert_memory_equal(&a->bounds, &b->bounds, sizeof a->bounds);
    for (uint32_t i = 0; i < a->body_count; i++) {
        const struct body *x = &a->bodies[i], *y = &b->bodies[i];
        assert_int_equal(x->kind, y->kind);
        assert_int_equal(x->leaf_count, y->leaf_count);
        for (enum walk walk = WALK_AUTO; walk <= WALK_HASH; walk++) {
            look(&p, d, x, walk);
            look(&q, d, y, walk);
            assert_memory_equal(&p, &q, sizeof p);
        }
        for (uint32_t l = 0; l < x->leaf_count; l++) {
            assert_memory_equal(x->leaves[l].colour, y->leaves[l].colour,
                                sizeof x->leaves[l].colour);
            assert_int_equal(x->leaves[l].subtracted, y->leaves[l].subtracted);
        }
    }
}

struct seen { // that the test tests something
    uint32_t edits, carried;
};

static uint32_t combinations(const struct model *m)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < m->body_count; i++)
        sum += discovery_stats(m->bodies[i].table).combinations;
    return sum;
}

static void check_fresh(struct device *d, const struct edit *e, const struct model *live,
                        struct seen *seen)
{
    struct messages messages = {0};
    struct error err;
    struct csg_tree tree;
    struct model fresh;
    char *text;
    size_t size;
    if (!edit_text(e, &text, &size, &err))
        fail_msg("%s", err.text);
    assert_true(csg_parse(&tree, "unit.csg", text, size, &messages));
    struct solid_store *store = solid_store_new();
    build(&fresh, &tree, store, NULL);
    csg_free(&tree);
    seen->carried += combinations(live);
    check_same(d, live, &fresh);
    model_free(&fresh);
    solid_store_delete(store);
    free(text);
    messages_free(&messages);
}

static void run_series(struct device *d, uint64_t seed, struct seen *seen)
{
    uint64_t random = hash_mix(seed);
    char *text = random_text(seed);
    struct edit *e = edit_of_text(text);
    struct solid_store *store = solid_store_new();
    struct model before = {0};
    for (int i = 0; i <= EDITS; i++) {
        struct csg_tree tree;
        struct model now;
        if (i)
            seen->edits += edit_something(e, &random);
        edit_tree(e, &tree);
        build(&now, &tree, store, i ? &before : NULL);
        csg_free(&tree);
        model_free(&before);
        before = now;
        check_fresh(d, e, &before, seen);
    }
    model_free(&before);
    solid_store_delete(store);
    edit_delete(e);
    free(text);
}

static void edits_show_what_the_saved_text_shows(void **state)
{
    (void)state;
    struct device *d = cpu_device_new();
    struct seen seen = {0};
    for (uint64_t seed = 1; seed <= SERIES; seed++)
        run_series(d, seed, &seen);
    device_delete(d);
    assert_true(seen.edits > SERIES * EDITS / 2);
    assert_true(seen.carried > SERIES * EDITS);
}

// A hidden node is as if it were not there, one alone as if nothing else were.
static void marks_show_what_modifiers_show(void **state)
{
    (void)state;
    static const struct {
        uint8_t modifiers;
        const char *text;
    } cases[] = {
        {CSG_DISABLE, "difference() { cube(9); *sphere(5); cylinder(20); }"},
        {CSG_ROOT, "difference() { cube(9); !sphere(5); cylinder(20); }"},
        {CSG_BACKGROUND, "difference() { cube(9); %sphere(5); cylinder(20); }"},
        {CSG_HIGHLIGHT, "difference() { cube(9); #sphere(5); cylinder(20); }"},
    };
    struct device *d = cpu_device_new();
    for (size_t i = 0; i < array_count(cases); i++) {
        struct edit *e = edit_of_text("difference() { cube(9); sphere(5); cylinder(20); }");
        struct edit *marked = edit_of_text(cases[i].text);
        struct solid_store *store = solid_store_new();
        struct csg_tree tree;
        struct model before, now, fresh;
        edit_tree(e, &tree);
        build(&before, &tree, store, NULL);
        csg_free(&tree);
        edit_mark(e, 2, cases[i].modifiers);
        edit_tree(e, &tree);
        build(&now, &tree, store, &before);
        csg_free(&tree);
        build(&fresh, &edit_source(marked)->tree, store, NULL);
        check_same(d, &now, &fresh);
        model_free(&before);
        model_free(&now);
        model_free(&fresh);
        solid_store_delete(store);
        edit_delete(e);
        edit_delete(marked);
    }
    device_delete(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_show_what_the_saved_text_shows),
        cmocka_unit_test(marks_show_what_modifiers_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
