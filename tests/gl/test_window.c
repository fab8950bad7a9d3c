// test_window.c - a thread that draws into a window has its context back after ours, GLX's and
// EGL's.
#include "render/gl/current.h"
#include "unit.h"

#include <GLFW/glfw3.h>

static void assert_same(const struct gl_current *a, const struct gl_current *b)
{
    assert_true(a->display == b->display && a->draw == b->draw && a->read == b->read);
    assert_true(a->context == b->context && a->api == b->api);
    assert_true(a->x_display == b->x_display && a->x_context == b->x_context);
    assert_true(a->x_draw == b->x_draw && a->x_read == b->x_read);
}

static void window_keeps_its_context(int api)
{
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow *window = glfwCreateWindow(64, 64, "test", NULL, NULL);
    if (!window)
        skip();
    glfwMakeContextCurrent(window);
    struct gl_current before = gl_current_get();
    assert_true(api == GLFW_NATIVE_CONTEXT_API ? before.x_context != NULL : before.context != NULL);

    struct error err;
    struct gl_context *c = unit_context();
    struct gl_current now = gl_current_get();
    assert_same(&now, &before);
    assert_true(gl_context_enter(c, &err));
    now = gl_current_get();
    assert_null(now.x_context);
    assert_true(now.context && now.context != before.context);
    gl_context_leave(c);
    now = gl_current_get();
    assert_same(&now, &before);
    glfwSwapBuffers(window);
    gl_context_delete(c);
    glfwDestroyWindow(window);
}

static void of_glx(void **state)
{
    (void)state;
    window_keeps_its_context(GLFW_NATIVE_CONTEXT_API);
}

static void of_egl(void **state)
{
    (void)state;
    window_keeps_its_context(GLFW_EGL_CONTEXT_API);
}

int main(void)
{
    gl_context_delete(unit_context());
    if (!glfwInit()) {
        printf("skipped: no display\n");
        return 77;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_glx), cmocka_unit_test(of_egl)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    glfwTerminate();
    return failed;
}
