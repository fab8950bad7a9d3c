// test_png.c - what is written as PNG or PFM reads back the same.
#include "io/read_png.h"
#include "io/write_pfm.h"
#include "io/write_png.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"

#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
// cmocka.h wants the four above first
#include <cmocka.h>

#include "written.h"

static uint8_t *noise(int width, int height)
{
    uint64_t state = 5;
    size_t size = 3 * (size_t)width * (size_t)height;
    uint8_t *rgb = mem_alloc(size);
    for (size_t i = 0; i < size; i++)
        rgb[i] = i % 7 ? 200 : (uint8_t)random_next(&state);
    return rgb;
}

static void round_trip(int width, int height)
{
    struct error err;
    uint8_t *rgb = noise(width, height);
    assert_true(write_png(written_path, rgb, width, height, &err));
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, written_path));
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    assert_int_equal(image.format, PNG_FORMAT_RGB);
    uint8_t *back = mem_alloc(PNG_IMAGE_SIZE(image));
    assert_true(png_image_finish_read(&image, NULL, back, 0, NULL));
    assert_memory_equal(rgb, back, 3 * (size_t)width * (size_t)height);
    free(back);
    free(rgb);
}

static void reads_back_the_same(void **state)
{
    (void)state;
    round_trip(1, 1);
    round_trip(3, 500);
    round_trip(1021, 17);
    round_trip(30000, 1);
}

static void same_picture_same_bytes(void **state)
{
    (void)state;
    struct error err;
    uint8_t *rgb = noise(64, 64);
    char *data[2];
    size_t size[2];
    for (int i = 0; i < 2; i++) {
        assert_true(write_png(written_path, rgb, 64, 64, &err));
        assert_true(file_read(written_path, 1 << 20, &data[i], &size[i], &err));
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(data[0], data[1], size[0]);
    free(data[0]);
    free(data[1]);
    free(rgb);
}

static void failures_leave_nothing(void **state)
{
    (void)state;
    struct error err = {0};
    uint8_t *rgb = noise(64, 64);
    char missing[96];
    snprintf(missing, sizeof missing, "%s/none/a.png", written_folder);
    assert_false(write_png(missing, rgb, 64, 64, &err));
    assert_non_null(strstr(err.text, "none/a.png"));
    assert_false(write_png("/dev/full", rgb, 64, 64, &err));
    assert_non_null(strstr(err.text, "/dev/full"));
    assert_false(write_png(written_folder, rgb, 64, 64, &err));
    free(rgb);
}

static bool any_size(const char *name, uint64_t rows, uint64_t columns, struct error *err)
{
    (void)name, (void)rows, (void)columns, (void)err;
    return true;
}

static bool no_size(const char *name, uint64_t rows, uint64_t columns, struct error *err)
{
    error_set(err, "%s: %d by %d", name, (int)rows, (int)columns);
    return false;
}

static void load(char **data, size_t *size)
{
    struct error err;
    if (!file_read(written_path, 1 << 20, data, size, &err))
        fail_msg("%s", err.text);
}

static void write_some(enum png_kind kind, int width, int height, const void *pixels)
{
    static const struct png_note note = {"Title", "one line"};
    struct error err;
    assert_true(write_png_picture(written_path,
                                  &(struct png_picture){.width = width,
                                                        .height = height,
                                                        .kind = kind,
                                                        .pixels = pixels,
                                                        .notes = &note,
                                                        .note_count = 1},
                                  &err));
}

static void alpha_reads_back(void **state)
{
    (void)state;
    static const uint8_t rgba[8] = {1, 2, 3, 0, 250, 251, 252, 128};
    char *data;
    size_t size;
    struct error err;
    struct pixels p;
    write_some(PNG_KIND_RGBA, 1, 2, rgba);
    load(&data, &size);
    assert_non_null(memmem(data, size, "tEXtTitle\0one line", 18));
    assert_true(read_png(written_path, data, size, any_size, &p, &err));
    assert_int_equal(p.width, 1);
    assert_int_equal(p.height, 2);
    assert_memory_equal(p.rgba, rgba, sizeof rgba);
    free(p.rgba);
    assert_false(read_png("name", data, size, no_size, &p, &err));
    assert_string_equal(err.text, "name: 2 by 1");
    for (size_t cut = 0; cut < size - 12; cut++) { // the last chunk is empty
        assert_false(read_png("cut", data, cut, any_size, &p, &err));
        assert_ptr_equal(strchr(err.text, '\n'), NULL);
    }
    free(data);
}

static void sixteen_bits_read_back(void **state)
{
    (void)state;
    static const uint16_t grey[3] = {0x1234, 0, 0xffff};
    static const uint8_t upper[12] = {0x12, 0x12, 0x12, 255, 0, 0, 0, 255, 255, 255, 255, 255};
    char *data;
    size_t size;
    struct error err;
    struct pixels p;
    write_some(PNG_KIND_GREY16, 3, 1, grey);
    load(&data, &size);
    assert_int_equal(data[24], 16); // bits of a channel
    assert_int_equal(data[25], 0);  // grey
    assert_true(read_png(written_path, data, size, any_size, &p, &err));
    assert_memory_equal(p.rgba, upper, sizeof upper);
    free(p.rgba);
    free(data);
    png_image image = {.version = PNG_IMAGE_VERSION};
    uint16_t back[3];
    assert_true(png_image_begin_read_from_file(&image, written_path));
    image.format = PNG_FORMAT_LINEAR_Y;
    assert_true(png_image_finish_read(&image, NULL, back, 0, NULL));
    assert_memory_equal(back, grey, sizeof grey);
}

static void pfm_is_upside_down_and_little_endian(void **state)
{
    (void)state;
    static const float values[6] = {1, 2, -0.5f, INFINITY, 5, 6};
    static const char expected[] = "Pf\n2 3\n-1.0\n"
                                   "\0\0\xa0\x40\0\0\xc0\x40"
                                   "\0\0\0\xbf\0\0\x80\x7f"
                                   "\0\0\x80\x3f\0\0\0\x40";
    char *data;
    size_t size;
    struct error err;
    assert_true(write_pfm(written_path, values, 2, 3, &err));
    load(&data, &size);
    assert_int_equal(size, sizeof expected - 1);
    assert_memory_equal(data, expected, size);
    free(data);
    assert_false(write_pfm("/dev/full", values, 2, 3, &err));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_back_the_same),
        cmocka_unit_test(same_picture_same_bytes),
        cmocka_unit_test(failures_leave_nothing),
        cmocka_unit_test(alpha_reads_back),
        cmocka_unit_test(sixteen_bits_read_back),
        cmocka_unit_test(pfm_is_upside_down_and_little_endian),
    };
    return cmocka_run_group_tests(tests, written_setup, written_teardown);
}
