// test_surface.c - height fields: values of OpenSCAD 2021.01, closed meshes, and hostile files.
#include "io/heights.h"
#include "io/read_surface.h"

#include "reading.h"

#include <png.h>

static bool read_with(const struct surface_options *options, const void *data, size_t size,
                      struct mesh *out, struct messages *messages, struct error *err)
{
    char *copy = exact_copy(data, size);
    err->text[0] = 0;
    bool ok = read_surface("file", copy, size, options, out, messages, err);
    if (ok != (err->text[0] == 0) || strchr(err->text, '\n'))
        fail_msg("'%s' from a reader that returned %d", err->text, ok);
    free(copy);
    return ok;
}

static struct mesh accept(const char *text, bool center, const char *warning)
{
    struct surface_options options = {.center = center, .invert = true};
    struct messages messages = {0};
    struct mesh m;
    struct error err;
    if (!read_with(&options, text, strlen(text), &m, &messages, &err))
        fail_msg("%s", err.text);
    assert_int_equal(messages.count, warning != NULL);
    if (warning)
        assert_string_equal(messages.items[0].text, warning);
    messages_free(&messages);
    return m;
}

static void refuse(const void *data, size_t size, const char *message)
{
    struct mesh m = {.vertex_count = 77};
    struct messages messages = {0};
    struct error err;
    assert_false(read_with(&(struct surface_options){0}, data, size, &m, &messages, &err));
    assert_int_equal(m.vertex_count, 77);
    assert_int_equal(messages.count, 0);
    if (message)
        assert_string_equal(err.text, message);
}

static void text_files(void **state)
{
    (void)state;
    struct mesh m = accept("1 2\n3 4.5", false, NULL);
    assert_mesh(&m, 9, 14, 2.625);
    assert_int_equal(m.face_count, 9);
    assert_true(mesh_has_vertex(&m, 0.5, 0.5, 2.625) && mesh_has_vertex(&m, 1, 0, 2));
    assert_true(mesh_has_vertex(&m, 0, 1, 3) && mesh_has_vertex(&m, 1, 1, 0));
    assert_true(mesh_is_closed(&m));
    mesh_free(&m);

    m = accept("0 1\r\n\r\n  # Comment\r\n2\t3 \r\n\r\n", true, NULL);
    assert_mesh(&m, 9, 14, 2.5);
    assert_true(mesh_has_vertex(&m, -0.5, -0.5, 0) && mesh_has_vertex(&m, 0.5, 0.5, -1));
    mesh_free(&m);

    m = accept("+5 .6\n7. 1e0\n1 -2\n", false, NULL);
    assert_mesh(&m, 14, 24, 11.15);
    mesh_free(&m);
}

// What short rows lack is 0, which may be the level of the base.
static void short_rows(void **state)
{
    (void)state;
    struct mesh m = accept("9 6 7\n6 8 9\n5 3 2\n2\n", false, NULL);
    assert_mesh(&m, 26, 48, 29.5);
    assert_int_equal(m.face_count, 34);
    mesh_free(&m);

    m = accept("2 2 2\n2 2 2\n2\n", false, NULL);
    assert_mesh(&m, 19, 34, 6.5);
    assert_true(mesh_is_closed(&m));
    mesh_free(&m);
}

static void reading_ends_at_what_is_no_number(void **state)
{
    (void)state;
    const char *warning = "file:2: expected a number; the rest of the file is left out";
    const char *texts[] = {"5 6\n7 x 9\n1 2\n", "5 6\n7 nan\n1 2\n", "5 6\n7 0x10\n1 2\n",
                           "5 6\n7 1e301\n"};
    for (size_t i = 0; i < array_count(texts); i++) {
        struct mesh m = accept(texts[i], false, warning);
        assert_mesh(&m, 8, 12, 4.5);
        mesh_free(&m);
    }
    struct mesh m = accept("5 6\n7 8 # 9\n1 2\n", false, warning);
    assert_mesh(&m, 9, 14, 6.5);
    mesh_free(&m);
}

static void one_row_encloses_nothing(void **state)
{
    (void)state;
    struct mesh m = accept("5 6 7\n", false, "file: a surface of 1 x 3 heights encloses nothing");
    assert_mesh(&m, 0, 0, 0);
    m = accept("1\n2\n3", false, "file: a surface of 3 x 1 heights encloses nothing");
    assert_mesh(&m, 0, 0, 0);
    m = accept("", false, "file: a surface of 0 x 0 heights encloses nothing");
    assert_mesh(&m, 0, 0, 0);
}

// Random heights on grids of all small sizes: closed, as many triangles as a closed mesh over these
// vertices has, and the volume of the prisms of its cells.
static void all_small_grids_are_closed(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (uint32_t rows = 2; rows <= 7; rows++)
        for (uint32_t columns = 2; columns <= 7; columns++) {
            char text[512];
            size_t used = 0;
            double z[7][7], sum = 0, lowest = 1e9;
            for (uint32_t i = 0; i < rows; i++)
                for (uint32_t j = 0; j < columns; j++) {
                    seed = seed * 6364136223846793005u + 1442695040888963407u;
                    z[i][j] = (double)(seed >> 60) - 5;
                    lowest = fmin(lowest, z[i][j]);
                    used += (size_t)snprintf(text + used, sizeof text - used, "%g%c", z[i][j],
                                             j + 1 < columns ? ' ' : '\n');
                }
            double base = fmin(0, lowest - 1);
            for (uint32_t i = 1; i < rows; i++)
                for (uint32_t j = 1; j < columns; j++)
                    sum += (z[i][j] + z[i - 1][j] + z[i][j - 1] + z[i - 1][j - 1]) / 4 - base;
            struct mesh m = accept(text, seed >> 40 & 1, NULL);
            uint32_t cells = (rows - 1) * (columns - 1), border = 2 * (rows + columns - 2);
            uint32_t vertices = rows * columns + cells + border;
            assert_mesh(&m, vertices, 2 * vertices - 4, sum);
            assert_int_equal(m.face_count, 4 * cells + border + 1);
            assert_true(mesh_is_closed(&m));
            mesh_free(&m);
        }
}

struct bytes {
    uint8_t *items;
    uint32_t count, room;
};

static void write_bytes(png_structp png, png_bytep data, size_t length)
{
    struct bytes *b = png_get_io_ptr(png);
    array_reserve(&b->items, &b->room, b->count + length);
    memcpy(b->items + b->count, data, length);
    b->count += (uint32_t)length;
}

// A picture of 2 x 2 pixels of four bytes or less.
static struct bytes make_png(int type, int depth, int interlace, const uint8_t *rows,
                             size_t row_size)
{
    struct bytes b = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_color palette[2] = {{200, 100, 50}, {0, 0, 0}};
    if (setjmp(png_jmpbuf(png)))
        fail();
    png_set_write_fn(png, &b, write_bytes, NULL);
    png_set_IHDR(png, info, 2, 2, depth, type, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 2);
    png_write_info(png, info);
    for (int pass = png_set_interlace_handling(png); pass; pass--)
        for (size_t y = 0; y < 2; y++)
            png_write_row(png, rows + y * row_size);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return b;
}

// Heights at (0, 0), (1, 0), (0, 1) and (1, 1); frees the picture.
static void expect_heights(struct bytes png, bool invert, double a, double b, double c, double d)
{
    struct surface_options options = {.invert = invert};
    struct messages messages = {0};
    struct mesh m;
    struct error err;
    if (!read_with(&options, png.items, png.count, &m, &messages, &err))
        fail_msg("%s", err.text);
    assert_true(mesh_has_vertex(&m, 0, 0, a) && mesh_has_vertex(&m, 1, 0, b));
    assert_true(mesh_has_vertex(&m, 0, 1, c) && mesh_has_vertex(&m, 1, 1, d));
    assert_true(mesh_is_closed(&m));
    mesh_free(&m);
    free(png.items);
}

static void pictures(void **state)
{
    (void)state;
    static const uint8_t grey[] = {0, 51, 102, 255}; // the top row is the largest y
    static const uint8_t rgb[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
    static const uint8_t rgba[] = {0, 0, 0, 0, 51, 51, 51, 7, 102, 102, 102, 0, 255, 255, 255, 9};
    static const uint8_t deep[] = {0, 255, 51, 255, 102, 255, 255, 255};
    static const uint8_t bits[] = {0x40, 0x80}; // 0 1 above 1 0
    static const uint8_t quarters[] = {0x10, 0xb0};
    expect_heights(make_png(PNG_COLOR_TYPE_GRAY, 8, 0, grey, 2), false, 40, 100, 0, 20);
    expect_heights(make_png(PNG_COLOR_TYPE_GRAY, 8, 1, grey, 2), false, 40, 100, 0, 20);
    expect_heights(make_png(PNG_COLOR_TYPE_GRAY, 16, 0, deep, 4), false, 40, 100, 0, 20);
    expect_heights(make_png(PNG_COLOR_TYPE_RGBA, 8, 0, rgba, 8), false, 40, 100, 0, 20);
    expect_heights(make_png(PNG_COLOR_TYPE_GRAY, 8, 0, grey, 2), true, -39.607843137254903,
                   -99.607843137254903, 0.39215686274509803, -19.607843137254903);
    expect_heights(make_png(PNG_COLOR_TYPE_RGB, 8, 0, rgb, 6), false, 7.22, 100, 21.26, 71.52);
    expect_heights(make_png(PNG_COLOR_TYPE_GRAY, 1, 0, bits, 1), false, 100, 0, 0, 100);
    expect_heights(make_png(PNG_COLOR_TYPE_GRAY, 2, 0, quarters, 1), false, 200 / 3.0, 100, 0,
                   100 / 3.0);
    double bright = (0.2126 * 200 + 0.7152 * 100 + 0.0722 * 50) * 100 / 255;
    expect_heights(make_png(PNG_COLOR_TYPE_PALETTE, 1, 0, bits, 1), false, 0, bright, bright, 0);
}

static void broken_pictures(void **state)
{
    (void)state;
    static const uint8_t grey[] = {0, 51, 102, 255};
    struct bytes png = make_png(PNG_COLOR_TYPE_GRAY, 8, 0, grey, 2);
    for (uint32_t size = 8; size < png.count - 12; size++)
        refuse(png.items, size, NULL);
    refuse(png.items, 8, "file: PNG: the file ends too early");
    free(png.items);
}

static void too_many_heights(void **state)
{
    (void)state;
    // The header of a picture of 40,000 x 25,000, with its checksum.
    static const char picture[] =
        "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x9c\x40\0\0\x61\xa8\x08\0\0\0\0"
        "\x8b\xd9\x93\x2f\0\0\0\0IDAT";
    refuse(picture, sizeof picture - 1,
           "file: a surface of 25000 x 40000 heights, more than the limit of 16777216");

    // One long row and many short ones ask for what a small file cannot hold.
    enum { SIDE = 5000 };
    char *text = mem_alloc(4 * SIDE);
    for (int i = 0; i < SIDE; i++) {
        memcpy(text + 2 * i, "1 ", 2);
        memcpy(text + 2 * (SIDE + i), "\n1", 2);
    }
    refuse(text, 4 * SIDE,
           "file: a surface of 5001 x 5000 heights, more than the limit of 16777216");
    free(text);
}

static void noise_is_survived(void **state)
{
    (void)state;
    static const uint8_t grey[] = {0, 51, 102, 255};
    struct bytes png = make_png(PNG_COLOR_TYPE_GRAY, 8, 0, grey, 2);
    char text[] = "1 2 3\n# 4\n5 6 7\n8 9\n";
    uint64_t seed = 3;
    for (int round = 0; round < 4000; round++) {
        char data[256];
        size_t size = round & 1 ? png.count : sizeof text - 1;
        memcpy(data, round & 1 ? (const char *)png.items : text, size);
        size = spoil(&seed, data, size);
        struct mesh m = {0};
        struct messages messages = {0};
        struct error err;
        read_with(&(struct surface_options){0}, data, size, &m, &messages, &err);
        mesh_free(&m);
        messages_free(&messages);
    }
    free(png.items);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_files),
        cmocka_unit_test(short_rows),
        cmocka_unit_test(reading_ends_at_what_is_no_number),
        cmocka_unit_test(one_row_encloses_nothing),
        cmocka_unit_test(all_small_grids_are_closed),
        cmocka_unit_test(pictures),
        cmocka_unit_test(broken_pictures),
        cmocka_unit_test(too_many_heights),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
