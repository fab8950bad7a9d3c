// test_dxf.c - DXF drawings: entities, blocks, layers, joined lines, and hostile files.
#include "flat.h"
#include "io/read_dxf.h"

#define DXF(blocks, entities)                                                                      \
    "0\nSECTION\n2\nBLOCKS\n" blocks "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" entities               \
    "0\nENDSEC\n0\nEOF\n"
#define LINE(x1, y1, x2, y2) "0\nLINE\n10\n" #x1 "\n20\n" #y1 "\n11\n" #x2 "\n21\n" #y2 "\n"
#define TRIANGLE             "0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n10\n10\n20\n5\n"
#define BLOCK                "0\nBLOCK\n2\nb\n10\n5\n20\n5\n" TRIANGLE "0\nENDBLK\n"
#define INSERT               "0\nINSERT\n2\nb\n10\n1\n20\n2\n"

static const struct dxf_options plain = {.scale = 1, .detail = {0, 12, 2}};

static struct outline read_sized(const char *text, size_t size, struct dxf_options options,
                                 uint32_t warnings)
{
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    char *copy = exact_copy(text, size);
    if (!read_dxf("a.dxf", copy, size, &options, &o, &messages, &err))
        fail_msg("%s", err.text);
    assert_int_equal(messages.warnings, warnings);
    messages_free(&messages);
    free(copy);
    return o;
}

static struct outline read_text(const char *text, struct dxf_options options)
{
    return read_sized(text, strlen(text), options, 0);
}

static void polylines_are_scaled_about_the_origin(void **state)
{
    (void)state;
    struct outline o = read_text(DXF("", TRIANGLE), plain);
    EXPECT(o, {0, 0}, {10, 0}, {10, 5});
    struct dxf_options moved = plain;
    moved.origin_x = 1;
    moved.origin_y = 2;
    moved.scale = 2;
    o = read_text(DXF("", TRIANGLE), moved);
    EXPECT(o, {18, 6}, {-2, -4}, {18, -4});
}

static void curves_have_fragments(void **state)
{
    (void)state;
    struct dxf_options four = plain;
    four.detail.fn = 4;
    struct outline o = read_text(DXF("", "0\nCIRCLE\n10\n1\n20\n2\n40\n5\n"), four);
    EXPECT(o, {6, 2}, {1, 7}, {-4, 2}, {1, -3});
    o = read_text(DXF("", "0\nELLIPSE\n10\n1\n20\n2\n11\n-3\n21\n4\n40\n0.5\n41\n0\n"
                          "42\n6.283185307\n"),
                  four);
    EXPECT(o, {3, 3.5}, {-2, 6}, {-1, 0.5}, {4, -2});
    four.detail.fn = 8;
    o = read_text(DXF("", "0\nARC\n10\n1\n20\n2\n40\n5\n50\n270\n51\n20\n"), four);
    EXPECT(o, {3.985352, -2.010742}, {5.790039, 0.566406}, {5.698242, 3.709961}, {1, -3});
}

static void blocks_are_inserted(void **state)
{
    (void)state;
    struct outline o = read_text(DXF(BLOCK, INSERT), plain);
    EXPECT(o, {11, 7}, {1, 2}, {11, 2});
    o = read_text(DXF(BLOCK, INSERT "41\n2\n42\n3\n50\n90\n"), plain);
    EXPECT(o, {1, 22}, {-14, 22}, {1, 2});
    o = read_text(DXF(BLOCK "0\nBLOCK\n2\nc\n" INSERT "50\n90\n41\n2\n0\nENDBLK\n",
                      "0\nINSERT\n2\nc\n10\n1\n20\n2\n"),
                  plain);
    EXPECT(o, {2, 24}, {-3, 24}, {2, 4});
}

static void layers_are_chosen(void **state)
{
    (void)state;
    struct dxf_options layer = plain;
    layer.layer = "Q r";
    struct outline o = read_text(
        DXF("", TRIANGLE "8\nQ r\n0\nLWPOLYLINE\n8\nother\n10\n3\n20\n3\n10\n4\n20\n4\n10\n5\n20\n"
                         "3\n"),
        layer);
    EXPECT(o, {0, 0}, {10, 0}, {10, 5});
}

static void lines_are_joined(void **state)
{
    (void)state;
    // In any order and direction; ends within a cell of 1/1024 meet; open chains are closed.
    struct outline o = read_text(DXF("", LINE(0, 0, 4, 0) LINE(4, 3, 4.0009, 0) LINE(0, 0, 4, 3)
                                             LINE(10, 0, 12, 0) LINE(12, 5, 12, 0)),
                                 plain);
    EXPECT(o, {0, 0}, {4, 0}, {4, 3}, {10, 0}, {12, 0}, {12, 5});
    // A loop with odd junctions, as OpenSCAD joins it.
    o = read_text(DXF("", LINE(50, 140, 0, 140) LINE(140, 0, 0, 0) LINE(0, 0, 0, 140)
                              LINE(50, 140, 0, 0) LINE(50, 140, 45, 100) LINE(45, 100, 60, 80)
                                  LINE(0, 0, 45, 100) LINE(45, 50, 140, 0) LINE(60, 80, 45, 50)
                                      LINE(45, 50, 0, 0) LINE(45, 100, 45, 50)),
                  plain);
    assert_int_equal(o.point_count, 13);
    assert_true(has_point(&o, (struct vec2){47.586197, 96.551712}));
    outline_free(&o);
}

static void what_is_left_out_is_said(void **state)
{
    (void)state;
    static const char *const texts[] = {
        DXF("", "0\nPOINT\n10\n1\n20\n1\n0\nPOINT\n10\n1\n20\n1\n" TRIANGLE),
        DXF("", LINE(nan, 0, 1, 1) TRIANGLE),
        DXF("", "0\nLINE\n10\n1\n20\n1\n" TRIANGLE),
        DXF("", TRIANGLE "0\nPOINT\nx\n1\n"),
    };
    static const uint32_t warnings[] = {1, 2, 1, 1};
    for (size_t i = 0; i < array_count(texts); i++) {
        struct outline o = read_sized(texts[i], strlen(texts[i]), plain, warnings[i]);
        EXPECT(o, {0, 0}, {10, 0}, {10, 5});
    }
    const char *far = DXF("", TRIANGLE LINE(0, 0, 1e30, 1));
    struct outline o = read_sized(far, strlen(far), plain, 1);
    assert_int_equal(o.point_count, 0);
    outline_free(&o);
}

static void truncated_files_are_read_until_their_end(void **state)
{
    (void)state;
    static const char text[] = DXF(BLOCK, INSERT TRIANGLE LINE(0, 0, 1, 1));
    for (size_t size = 0; size < sizeof text; size++) {
        struct outline o = {0};
        struct messages messages = {0};
        struct error err;
        char *copy = exact_copy(text, size);
        assert_true(read_dxf("a.dxf", copy, size, &plain, &o, &messages, &err));
        outline_free(&o);
        messages_free(&messages);
        free(copy);
    }
}

// Each block inserts the one before it twice: 2^60 lines, were there no limit.
static void blocks_that_blow_up_are_refused(void **state)
{
    (void)state;
    char text[20000];
    int at = snprintf(text, sizeof text, "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb0\n" TRIANGLE);
    for (int i = 1; i < 60; i++)
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "0\nBLOCK\n2\nb%d\n0\nINSERT\n2\nb%d\n10\n0\n20\n0\n"
                       "0\nINSERT\n2\nb%d\n10\n0\n20\n0\n",
                       i, i - 1, i - 1);
    snprintf(text + at, sizeof text - (size_t)at, "0\nENDSEC\n0\nEOF\n");
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    assert_false(read_dxf("a.dxf", text, strlen(text), &plain, &o, &messages, &err));
    assert_string_equal(err.text, "a.dxf: more than 16777216 lines");
    messages_free(&messages);

    o = read_text(DXF("0\nBLOCK\n2\nb\n" TRIANGLE INSERT "0\nENDBLK\n", INSERT), plain);
    assert_int_equal(o.point_count, 10); // the triangle twice
    outline_free(&o);
}

static void binary_files_are_refused(void **state)
{
    (void)state;
    static const char text[] = "AutoCAD Binary DXF\r\n\x1a";
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    assert_false(read_dxf("a.dxf", text, sizeof text, &plain, &o, &messages, &err));
    assert_string_equal(err.text, "a.dxf: binary DXF files cannot be read");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polylines_are_scaled_about_the_origin),
        cmocka_unit_test(curves_have_fragments),
        cmocka_unit_test(blocks_are_inserted),
        cmocka_unit_test(layers_are_chosen),
        cmocka_unit_test(lines_are_joined),
        cmocka_unit_test(what_is_left_out_is_said),
        cmocka_unit_test(truncated_files_are_read_until_their_end),
        cmocka_unit_test(blocks_that_blow_up_are_refused),
        cmocka_unit_test(binary_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
