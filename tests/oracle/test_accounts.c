// test_accounts.c - every byte that the gl device has of the driver is on its accounts, and no
// frame takes more than its budget.
#include "base/hash.h"
#include "base/mem.h"
#include "subject.h"

#include <epoxy/gl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { NAMES = 1 << 16 };

// What the driver has been asked for, buffer by buffer.
static struct {
    size_t size[NAMES]; // by name
    size_t used, peak;
    PFNGLNAMEDBUFFERSTORAGEPROC storage;
    PFNGLDELETEBUFFERSPROC delete;
} driver;

static void EPOXY_CALLSPEC storage(GLuint name, GLsizeiptr size, const void *data, GLbitfield flags)
{
    assert_in_range(name, 1, NAMES - 1);
    assert_int_equal(driver.size[name], 0);
    driver.size[name] = (size_t)size;
    driver.used += (size_t)size;
    driver.peak = driver.used > driver.peak ? driver.used : driver.peak;
    driver.storage(name, size, data, flags);
}

static void EPOXY_CALLSPEC delete (GLsizei count, const GLuint *names)
{
    for (GLsizei i = 0; i < count; i++) {
        driver.used -= driver.size[names[i]];
        driver.size[names[i]] = 0;
    }
    driver.delete(count, names);
}

static void EPOXY_CALLSPEC no_storage(GLenum target, GLsizeiptr size, const void *data,
                                      GLbitfield f)
{
    (void)target, (void)size, (void)data, (void)f;
    fail_msg("a buffer that is not counted");
}

static void EPOXY_CALLSPEC no_data(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
    (void)target, (void)size, (void)data, (void)usage;
    fail_msg("a buffer that is not counted");
}

static void EPOXY_CALLSPEC no_named(GLuint name, GLsizeiptr size, const void *data, GLenum usage)
{
    (void)name, (void)size, (void)data, (void)usage;
    fail_msg("a buffer that is not counted");
}

static void see(void *context, uint32_t worker, const struct span_block *block)
{
    (void)context, (void)worker, (void)block;
}

// Draws one of the random trees and checks the accounts; returns the bytes that were counted.
static size_t draw(struct device *device, uint32_t tree, size_t budget, bool spans)
{
    struct random_scene scene;
    struct subject subject;
    struct render_stats stats;
    struct error why;
    random_scene_make(&scene, tree);
    subject_make(&subject, &scene);
    size_t n = (size_t)scene.rays.width * (size_t)scene.rays.height;
    struct surface_image image = {
        .depth = mem_zalloc(n * 4), .leaf = mem_zalloc(n * 4), .face = mem_zalloc(n * 4)};
    struct render_settings settings = {.epsilon = scene.epsilon, .memory = budget};
    driver.peak = 0; // what is there from the frame before goes first
    if (spans)
        device_spans(device, &subject.body, &scene.rays, &settings, see, NULL, &stats);
    else
        device_first_surface(device, &subject.body, &scene.rays, &settings, &image, NULL, NULL,
                             &stats);
    assert_false(device_failed(device, &why));
    assert_in_range(stats.peak_bytes, 1, budget);
    driver.peak = driver.used > driver.peak ? driver.used : driver.peak;
    assert_in_range(driver.peak, 0, stats.peak_bytes + stats.model_bytes);
    free(image.depth);
    free(image.leaf);
    free(image.face);
    subject_free(&subject);
    random_scene_free(&scene);
    return stats.peak_bytes + stats.model_bytes;
}

static void budgets_are_kept(void **state)
{
    (void)state;
    struct device *device = device_under_test(true);
    uint64_t random = 1;
    for (uint32_t i = 0; i < 14; i++) {
        double doublings = i % 3 ? 10 * random_unit(&random) : 0; // of 64 KB
        draw(device, i, (size_t)(65536 * exp2(doublings)), i % 2);
    }
    device_delete(device);
    assert_int_equal(driver.used, 0);
}

// A device that has drawn nothing before only takes more and more: peaks are reached together.
static void accounts_hold_nothing_else(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 2; i++) {
        struct device *device = device_under_test(true);
        size_t told = draw(device, i, 1 << 20, i % 2);
        assert_int_equal(told, driver.peak);
        device_delete(device);
    }
}

// Functions are only known to be there once they have been called.
static int setup(void **state)
{
    (void)state;
    struct device *device = device_under_test(true);
    draw(device, 0, 1 << 20, false);
    device_delete(device);
    driver.used = 0;
    driver.storage = epoxy_glNamedBufferStorage;
    driver.delete = epoxy_glDeleteBuffers;
    epoxy_glNamedBufferStorage = storage;
    epoxy_glDeleteBuffers = delete;
    epoxy_glBufferStorage = no_storage;
    epoxy_glBufferData = no_data;
    epoxy_glNamedBufferData = no_named;
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(budgets_are_kept),
        cmocka_unit_test(accounts_hold_nothing_else),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
