// test_buffer.c - buffers hold what was put there, count against the budget, and come back.
#include "base/file.h"
#include "render/gl/buffer.h"
#include "render/gl/program.h"
#include "render/gl/readback.h"
#include "render/gl/timer.h"
#include "unit.h"

#include <epoxy/gl.h>
#include <unistd.h>

static void budget_is_kept(void **state)
{
    (void)state;
    struct error err;
    struct gl_memory memory = {.budget = 1000};
    struct gl_buffer a = {0}, b = {0};
    assert_true(gl_buffer_fit(&a, &memory, "a", 600, &err));
    assert_false(gl_buffer_fit(&b, &memory, "b", 401, &err));
    assert_string_equal(err.text,
                        "b: 401 bytes beside 600 others are more than the budget of 1000");
    assert_int_equal(b.id, 0);
    assert_true(gl_buffer_fit(&b, &memory, "b", 400, &err));
    assert_int_equal(memory.used, 1000);

    assert_false(gl_buffer_grow(&a, &memory, "a", 601, &err));
    assert_int_equal(a.size, 600); // as it was
    assert_true(gl_buffer_grow(&a, &memory, "a", 300, &err));
    assert_int_equal(a.size, 600);
    assert_true(gl_buffer_fit(&a, &memory, "a", 300, &err));
    assert_int_equal(memory.used, 700);
    assert_true(gl_buffer_grow(&b, &memory, "b", 700, &err)); // the old one does not count
    assert_int_equal(memory.used, 1000);
    assert_false(gl_buffer_fit(&b, &memory, "b", SIZE_MAX, &err));

    memory.largest = 500;
    assert_false(gl_buffer_fit(&a, &memory, "a", 501, &err));
    assert_string_equal(err.text, "a: 501 bytes, of which shaders can use no more than 500");
    assert_int_equal(a.size, 300);

    gl_buffer_free(&a);
    gl_buffer_free(&a);
    gl_buffer_free(&b);
    assert_int_equal(memory.used, 0);
    assert_int_equal(memory.peak, 1000);
}

static void bytes_come_back(void **state)
{
    (void)state;
    struct error err;
    struct gl_memory memory = {.budget = SIZE_MAX};
    struct gl_buffer a = {0}, b = {0};
    struct gl_readback r = {0};
    uint32_t numbers[100];
    for (uint32_t i = 0; i < 100; i++)
        numbers[i] = i;
    assert_true(gl_buffer_fit(&a, &memory, "a", sizeof numbers, &err));
    assert_true(gl_buffer_fit(&b, &memory, "b", sizeof numbers, &err));
    gl_buffer_write(&a, 0, numbers, sizeof numbers);
    gl_buffer_write(&a, 40, &(uint32_t){1000}, 4);
    gl_buffer_fill(&a, 80, 8, 77);
    gl_buffer_fill(&b, 0, b.size, UINT32_MAX);
    gl_buffer_copy(&a, 20, &b, 40, 80);

    assert_true(
        gl_readback_start(&r, &memory, "read", &(struct gl_part){&b, 0, b.size, NULL}, 1, &err));
    const uint32_t *back = gl_readback_wait(&r, &err);
    assert_non_null(back);
    for (uint32_t i = 0; i < 100; i++) {
        uint32_t from = i - 5;
        uint32_t expected = i < 10 || i >= 30          ? UINT32_MAX
                            : from == 10               ? 1000
                            : from == 20 || from == 21 ? 77
                                                       : from;
        assert_int_equal(back[i], expected);
    }
    assert_int_equal(memory.used, 3 * sizeof numbers);
    assert_true(gl_readback_start(&r, &memory, "read", &(struct gl_part){&a, 12, 4, NULL}, 1,
                                  &err)); // gives up nothing
    assert_true(gl_readback_start(&r, &memory, "read", &(struct gl_part){&a, 8, 4, NULL}, 1, &err));
    while (!gl_readback_ready(&r))
        ;
    back = gl_readback_wait(&r, &err);
    assert_int_equal(back[0], 2);
    gl_readback_free(&r);
    gl_buffer_free(&a);
    gl_buffer_free(&b);
    assert_int_equal(memory.used, 0);
}

// A pass that takes some time, measured as often as the ring holds and more.
static void passes_are_measured(void **state)
{
    (void)state;
    char folder[] = "/tmp/hcsg-test-buffer-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char *path = file_join(folder, "work.comp.glsl");
    static const char text[] = "layout(local_size_x = 64) in;\n"
                               "layout(std430, binding = 3) buffer numbers { uint n[]; };\n"
                               "void main() {\n"
                               "    uint sum = 0u;\n"
                               "    for (uint i = 0u; i < STEPS; i++)\n"
                               "        sum = sum * 3u + i;\n"
                               "    n[gl_GlobalInvocationID.x] += sum;\n"
                               "}\n";
    struct error err;
    assert_true(file_write(path, text, sizeof text - 1, &err));
    struct gl_programs programs = {.folder = folder};
    unsigned work = gl_program(&programs, "work", "STEPS=1000u", &err);
    if (!work)
        fail_msg("%s", err.text);
    struct gl_memory memory = {.budget = SIZE_MAX};
    struct gl_buffer n = {0};
    struct gl_timers timers = {0};
    assert_true(gl_buffer_fit(&n, &memory, "numbers", 256 + 4 * 640, &err));
    gl_buffer_fill(&n, 0, n.size, 1);
    gl_buffer_bind_part(&n, 3, 256, 4 * 640);
    glUseProgram(work);
    for (int i = 0; i < 200; i++) {
        gl_timer_begin(&timers, "outer");
        gl_timer_begin(&timers, i % 2 ? "odd" : "even");
        glDispatchCompute(10, 1, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        gl_timer_end(&timers);
        gl_timer_end(&timers);
        gl_timers_collect(&timers, false);
    }
    gl_timers_collect(&timers, true);
    assert_int_equal(timers.count, 3);
    double outer = 0, inner = 0;
    for (uint32_t i = 0; i < timers.count; i++) {
        const struct gl_pass *p = &timers.passes[i];
        bool whole = !strcmp(p->name, "outer");
        assert_int_equal(p->count, whole ? 200 : 100);
        assert_true(p->least <= p->last && p->last <= p->most && p->most <= p->seconds);
        *(whole ? &outer : &inner) += p->seconds;
    }
    assert_true(inner > 0 && inner <= outer);

    uint32_t sum = 0;
    for (uint32_t i = 0; i < 1000; i++)
        sum = sum * 3 + i;
    struct gl_readback r = {0};
    assert_true(
        gl_readback_start(&r, &memory, "read", &(struct gl_part){&n, 0, n.size, NULL}, 1, &err));
    const uint32_t *back = gl_readback_wait(&r, &err);
    assert_int_equal(back[63], 1);
    assert_int_equal(back[64], 1 + 200 * sum);
    assert_int_equal(back[64 + 639], 1 + 200 * sum);
    gl_readback_free(&r);
    gl_timers_free(&timers);
    gl_buffer_free(&n);
    gl_programs_free(&programs);
    unlink(path);
    rmdir(folder);
    free(path);
}

static void nothing_was_wrong(void **state)
{
    struct error err;
    if (gl_context_failed(*state, &err))
        fail_msg("%s", err.text);
    assert_int_equal(unit_said, 0);
}

int main(void)
{
    struct error err;
    struct gl_context *c = unit_context();
    if (!gl_context_enter(c, &err))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(budget_is_kept),
        cmocka_unit_test(bytes_come_back),
        cmocka_unit_test(passes_are_measured),
        cmocka_unit_test_prestate(nothing_was_wrong, c),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    gl_context_leave(c);
    gl_context_delete(c);
    return failed;
}
