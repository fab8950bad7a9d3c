// test_context.c - a context comes without a display, is left as it was found, and tells its
// errors.
#include "unit.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <pthread.h>

static void facts_are_those_of_the_driver(void **state)
{
    struct gl_context *c = *state;
    const struct gl_facts *f = gl_context_facts(c);
    struct error err;
    print_message("%s | %s | %s | %s%s\n", f->vendor, f->renderer, f->version, f->found,
                  f->software ? " | software" : "");
    print_message("storage %zu bytes, %d blocks, %d bindings, alignment %d\n", f->storage_size,
                  f->storage_blocks, f->storage_bindings, f->storage_alignment);
    print_message("groups %d %d %d of %d %d %d, at most %d, sharing %zu bytes\n", f->group_count[0],
                  f->group_count[1], f->group_count[2], f->group_size[0], f->group_size[1],
                  f->group_size[2], f->group_invocations, f->shared_size);
    print_message("int64 %d, atomics %d, subgroups of %d, tells loss %d\n", f->int64, f->atomic64,
                  f->subgroup, f->tells_loss);
    assert_int_equal(f->software, strstr(f->renderer, "llvmpipe") != NULL);
    assert_true(gl_facts_suffice(f, &err));
    struct gl_facts small = *f;
    small.storage_blocks = 8;
    assert_false(gl_facts_suffice(&small, &err));
    assert_non_null(strstr(err.text, "a shader can use 8 buffers"));
}

static void what_was_current_comes_back(void **state)
{
    struct gl_context *c = *state, *other = unit_context();
    struct error err;
    assert_null(eglGetCurrentContext());
    assert_true(gl_context_enter(other, &err));
    EGLContext first = eglGetCurrentContext();
    assert_non_null(first);
    assert_true(gl_context_enter(c, &err));
    EGLContext second = eglGetCurrentContext();
    assert_non_null(second);
    assert_ptr_not_equal(first, second);
    gl_context_leave(c);
    assert_ptr_equal(eglGetCurrentContext(), first);
    gl_context_leave(other);
    assert_null(eglGetCurrentContext());
    gl_context_delete(other);
    // And it outlives the other one.
    assert_true(gl_context_enter(c, &err));
    assert_false(gl_context_failed(c, &err));
    gl_context_leave(c);
}

static void *use(void *context)
{
    struct error err;
    if (!gl_context_enter(context, &err))
        return "not entered";
    bool good = glGetString(GL_RENDERER) && !gl_context_failed(context, &err);
    gl_context_leave(context);
    return !good ? "failed" : eglGetCurrentContext() ? "not left" : NULL;
}

static void other_threads_can_use_it(void **state)
{
    struct gl_context *c = *state;
    struct error err;
    for (int i = 0; i < 3; i++) {
        pthread_t thread;
        void *wrong;
        assert_int_equal(pthread_create(&thread, NULL, use, c), 0);
        pthread_join(thread, &wrong);
        if (wrong)
            fail_msg("%s", (char *)wrong);
    }
    assert_true(gl_context_enter(c, &err));
    gl_context_leave(c);
}

static void wrong_use_is_told_once(void **state)
{
    struct gl_context *c = *state;
    struct error err;
    assert_true(gl_context_enter(c, &err));
    assert_int_equal(unit_said, 0);
    glBindBuffer(GL_ARRAY_BUFFER, 12345);
    assert_int_equal(unit_said, 1);
    assert_true(gl_context_failed(c, &err));
    assert_non_null(strstr(err.text, "OpenGL error 0x502"));
    assert_false(gl_context_failed(c, &err));
    gl_context_leave(c);
}

int main(void)
{
    struct gl_context *c = unit_context();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(facts_are_those_of_the_driver, c),
        cmocka_unit_test_prestate(what_was_current_comes_back, c),
        cmocka_unit_test_prestate(other_threads_can_use_it, c),
        cmocka_unit_test_prestate(wrong_use_is_told_once, c),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    gl_context_delete(c);
    return failed;
}
