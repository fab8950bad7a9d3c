// test_window.c - a thread that draws into a window has its context back after ours, GLX's and
// EGL's; and a window lends its context.
#include "render/gl/current.h"
#include "unit.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <pthread.h>

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

struct wish {
    int api, minor;
    GLFWwindow *window;
};

static bool open_window(void *context, struct error *err)
{
    struct wish *w = context;
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, w->api);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, w->minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    w->window = glfwCreateWindow(64, 64, "test", NULL, NULL);
    if (!w->window)
        skip();
    glfwMakeContextCurrent(w->window);
    error_set(err, "the window is for another one");
    return w->minor >= 5;
}

static void *use(void *adopted)
{
    struct error err;
    struct gl_current none = {0}, now;
    if (!gl_context_enter(adopted, &err))
        return "not entered";
    bool good = glGetString(GL_RENDERER) && !gl_context_failed(adopted, &err);
    gl_context_leave(adopted);
    now = gl_current_get();
    return !good ? "failed" : now.context != none.context || now.x_context ? "not left" : NULL;
}

// A device draws with it on a thread of its own, while another window draws on the first.
static void window_lends_its_context(int api)
{
    struct error err;
    struct wish wish = {.api = api, .minor = 5};
    struct gl_context *own = unit_context();
    assert_true(gl_context_enter(own, &err));
    struct gl_current before = gl_current_get(), now;
    struct gl_context *c = gl_context_adopt(open_window, &wish, NULL, &err);
    assert_non_null(c);
    now = gl_current_get();
    assert_same(&now, &before);
    gl_context_leave(own);
    assert_string_equal(gl_context_facts(c)->found, "window");
    assert_true(gl_facts_suffice(gl_context_facts(c), &err));

    GLFWwindow *shown = glfwCreateWindow(64, 64, "test", NULL, NULL);
    glfwMakeContextCurrent(shown);
    pthread_t thread;
    void *wrong;
    assert_int_equal(pthread_create(&thread, NULL, use, c), 0);
    pthread_join(thread, &wrong);
    if (wrong)
        fail_msg("%s", (char *)wrong);
    glfwSwapBuffers(shown);
    gl_context_delete(c);
    gl_context_delete(own);
    glfwDestroyWindow(shown);
    glfwDestroyWindow(wish.window);
}

static void a_window_refuses(void **state)
{
    (void)state;
    struct error err;
    struct wish wish = {.api = GLFW_NATIVE_CONTEXT_API, .minor = 3};
    struct gl_current none = gl_current_get(), now;
    assert_null(gl_context_adopt(open_window, &wish, NULL, &err));
    assert_string_equal(err.text, "the window is for another one");
    now = gl_current_get();
    assert_same(&now, &none);
    glfwDestroyWindow(wish.window);
}

static void lent_by_glx(void **state)
{
    (void)state;
    window_lends_its_context(GLFW_NATIVE_CONTEXT_API);
}

static void lent_by_egl(void **state)
{
    (void)state;
    window_lends_its_context(GLFW_EGL_CONTEXT_API);
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_glx),           cmocka_unit_test(of_egl),
        cmocka_unit_test(lent_by_glx),      cmocka_unit_test(lent_by_egl),
        cmocka_unit_test(a_window_refuses),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    glfwTerminate();
    return failed;
}
