// test_faults.c - where the driver is reset or has no more memory, pictures are whole nevertheless.
#include "../render/unit.h"
#include "render/gl/device.h"

#include <epoxy/gl.h>
#include <stdio.h>

enum { SIZE = 48, PIXELS = SIZE * SIZE };

// epoxy's functions are variables: the first `calls` calls go to the driver.
static struct fault {
    int calls;
    GLenum error; // for glGetError to say
} fault;

static bool is_faulty(void)
{
    return fault.calls-- <= 0;
}

static PFNGLGETGRAPHICSRESETSTATUSPROC driver_status;
static PFNGLGETERRORPROC driver_error;
static PFNGLNAMEDBUFFERSTORAGEPROC driver_storage;
static PFNGLDISPATCHCOMPUTEINDIRECTPROC driver_dispatch;
static PFNGLCLIENTWAITSYNCPROC driver_wait;
static PFNGLCOPYNAMEDBUFFERSUBDATAPROC driver_copy;

static GLenum APIENTRY error_of_fault(void)
{
    GLenum e = fault.error;
    fault.error = GL_NO_ERROR;
    return e ? e : driver_error();
}

static GLenum APIENTRY status_reset(void)
{
    return is_faulty() ? GL_UNKNOWN_CONTEXT_RESET : driver_status();
}

static void APIENTRY storage_full(GLuint buffer, GLsizeiptr size, const void *data, GLbitfield how)
{
    if (is_faulty())
        fault.error = GL_OUT_OF_MEMORY;
    else
        driver_storage(buffer, size, data, how);
}

static void APIENTRY dispatch_full(GLintptr from)
{
    if (is_faulty())
        fault.error = GL_OUT_OF_MEMORY;
    else
        driver_dispatch(from);
}

// After a reset nothing comes back, and waiting for it succeeds.
static void APIENTRY copy_lost(GLuint from, GLuint to, GLintptr at, GLintptr into, GLsizeiptr size)
{
    if (!is_faulty())
        driver_copy(from, to, at, into, size);
}

static GLenum APIENTRY status_lost(void)
{
    return fault.calls < 0 ? GL_UNKNOWN_CONTEXT_RESET : driver_status();
}

static GLenum APIENTRY wait_fails(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    return is_faulty() ? GL_WAIT_FAILED : driver_wait(sync, flags, timeout);
}

static void break_status(void)
{
    epoxy_glGetGraphicsResetStatus = status_reset;
}

static void break_storage(void)
{
    epoxy_glNamedBufferStorage = storage_full;
}

static void break_dispatch(void)
{
    epoxy_glDispatchComputeIndirect = dispatch_full;
}

static void break_copy(void)
{
    epoxy_glCopyNamedBufferSubData = copy_lost;
    epoxy_glGetGraphicsResetStatus = status_lost;
}

static void break_wait(void)
{
    epoxy_glClientWaitSync = wait_fails;
}

// Once a context has been used, the variables lead to the driver.
static void learn_driver(void)
{
    driver_status = epoxy_glGetGraphicsResetStatus;
    driver_error = epoxy_glGetError;
    driver_storage = epoxy_glNamedBufferStorage;
    driver_dispatch = epoxy_glDispatchComputeIndirect;
    driver_wait = epoxy_glClientWaitSync;
    driver_copy = epoxy_glCopyNamedBufferSubData;
}

static void mend(void)
{
    epoxy_glGetGraphicsResetStatus = driver_status;
    epoxy_glGetError = driver_error;
    epoxy_glNamedBufferStorage = driver_storage;
    epoxy_glDispatchComputeIndirect = driver_dispatch;
    epoxy_glClientWaitSync = driver_wait;
    epoxy_glCopyNamedBufferSubData = driver_copy;
}

static const char text[] = "difference() { cube(size = [30, 30, 8], center = true);"
                           "cylinder($fn = 24, h = 20, r1 = 9, r2 = 12, center = true); }";

struct seen {
    float depth[PIXELS];
    uint32_t leaf[PIXELS], face[PIXELS];
    double inside[PIXELS]; // of all intervals
    int visits[PIXELS];
};

static void see(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    struct seen *s = context;
    for (int y = block->y0, i = 0; y < block->y1; y++)
        for (int x = block->x0; x < block->x1; x++, i++) {
            s->visits[y * SIZE + x]++;
            for (uint32_t k = block->first[i]; k < block->first[i + 1]; k++)
                s->inside[y * SIZE + x] += block->spans[k].leave - block->spans[k].enter;
        }
}

static void draw(struct seen *out, struct device *device, struct stage *s)
{
    struct rays rays = rays_from_above(SIZE);
    struct surface_image image = {.depth = out->depth, .leaf = out->leaf, .face = out->face};
    memset(out, 0, sizeof *out);
    device_first_surface(device, s->model.bodies, &rays, &s->settings, &image, NULL, NULL, NULL);
    device_spans(device, s->model.bodies, &rays, &s->settings, see, out, NULL);
}

static void assert_same_picture(const struct seen *a, const struct seen *b)
{
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(a->leaf[i], b->leaf[i]);
        assert_int_equal(a->visits[i], 1);
        assert_float_equal(a->inside[i], b->inside[i], 1e-4);
        if (a->leaf[i] != SURFACE_NONE)
            assert_float_equal(a->depth[i], b->depth[i], 1e-4);
    }
}

static const struct kind {
    const char *says;
    void (*spoil)(void);
} kinds[] = {
    {"the driver was reset", break_status}, {"memory", break_storage},
    {"out of memory", break_dispatch},      {"the driver was reset", break_wait},
    {"the driver was reset", break_copy},
};

// The fault comes at once, in the middle of a picture of several bands, in the second picture.
static void faults_leave_pictures_whole(void **state)
{
    (void)state;
    static const int calls[] = {0, 1, 5, 12, 40};
    static struct seen expected, seen;
    struct stage s;
    struct error why;
    stage_make(&s, text);
    s.settings.memory = 64 << 10;
    draw(&expected, s.device, &s);
    int failures = 0;
    for (size_t k = 0; k < array_count(kinds); k++)
        for (size_t i = 0; i < array_count(calls); i++) {
            struct device *device = gl_device_new(true, NULL, &why);
            assert_non_null(device);
            fault = (struct fault){.calls = calls[i]};
            epoxy_glGetError = error_of_fault;
            kinds[k].spoil();
            draw(&seen, device, &s);
            mend();
            assert_same_picture(&seen, &expected);
            bool failed = device_failed(device, &why);
            failures += failed;
            assert_true(failed || fault.calls >= 0);
            if (failed && (!strstr(why.text, kinds[k].says) || strchr(why.text, '\n') ||
                           !strstr(why.text, "the processor draws from here on")))
                fail_msg("fault %zu after %d: %s", k, calls[i], why.text);
            device_delete(device);
        }
    print_message("%d failures\n", failures);
    assert_true(failures >= 10);
    stage_free(&s);
}

int main(void)
{
    static struct seen seen;
    struct stage s;
    struct error err;
    struct device *device = gl_device_new(true, NULL, &err);
    if (!device) {
        printf("skipped: %s\n", err.text);
        return 77;
    }
    stage_make(&s, text);
    draw(&seen, device, &s);
    device_delete(device);
    stage_free(&s);
    learn_driver();
    const struct CMUnitTest tests[] = {cmocka_unit_test(faults_leave_pictures_whole)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
