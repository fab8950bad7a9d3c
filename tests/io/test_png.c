// test_png.c - what is written as PNG reads back the same.
#include "io/write_png.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"

#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static char folder[] = "/tmp/hcsg-png-XXXXXX", path[64];

static int setup(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/a.png", folder);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder); // fails when a temporary file was left
}

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
    assert_true(write_png(path, rgb, width, height, &err));
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, path));
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
        assert_true(write_png(path, rgb, 64, 64, &err));
        assert_true(file_read(path, 1 << 20, &data[i], &size[i], &err));
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
    snprintf(missing, sizeof missing, "%s/none/a.png", folder);
    assert_false(write_png(missing, rgb, 64, 64, &err));
    assert_non_null(strstr(err.text, "none/a.png"));
    assert_false(write_png("/dev/full", rgb, 64, 64, &err));
    assert_non_null(strstr(err.text, "/dev/full"));
    assert_false(write_png(folder, rgb, 64, 64, &err));
    free(rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_back_the_same),
        cmocka_unit_test(same_picture_same_bytes),
        cmocka_unit_test(failures_leave_nothing),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
