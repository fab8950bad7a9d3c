// test_live.c - edits on their way through the loader, among saves of the file.
#include "app/loader.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

struct window {
    char folder[64], path[96];
    struct loader *loader;
    pthread_mutex_t mutex;
    pthread_cond_t news;
    uint32_t woken;
    struct loaded *loaded;
};

static void woken(void *context)
{
    struct window *w = context;
    pthread_mutex_lock(&w->mutex);
    w->woken++;
    pthread_cond_signal(&w->news);
    pthread_mutex_unlock(&w->mutex);
}

static void save(struct window *w, const char *text)
{
    struct error err;
    assert_true(file_write(w->path, text, strlen(text), &err));
}

// The next model.
static struct loaded *wait_for_model(struct window *w)
{
    double until = clock_seconds() + 20;
    while (clock_seconds() < until) {
        struct loader_news news;
        if (loader_take(w->loader, &news)) {
            report_free(&news.report);
            if (news.loaded) {
                loaded_release(w->loaded);
                return w->loaded = news.loaded;
            }
            continue;
        }
        pthread_mutex_lock(&w->mutex);
        struct timespec t;
        clock_gettime(CLOCK_REALTIME, &t);
        t.tv_sec++;
        if (!w->woken)
            pthread_cond_timedwait(&w->news, &w->mutex, &t);
        w->woken = 0;
        pthread_mutex_unlock(&w->mutex);
    }
    fail_msg("no model came");
    return NULL;
}

static void open_window(struct window *w, const char *text)
{
    struct error err;
    *w = (struct window){0};
    strcpy(w->folder, "/tmp/hcsg-live-XXXXXX");
    assert_non_null(mkdtemp(w->folder));
    snprintf(w->path, sizeof w->path, "%s/part.csg", w->folder);
    pthread_mutex_init(&w->mutex, NULL);
    pthread_cond_init(&w->news, NULL);
    save(w, text);
    struct loader_options options = {
        .path = w->path, .epsilon = -1, .watch = true, .woken = woken, .context = w};
    w->loader = loader_start(&options, &err);
    assert_non_null(w->loader);
}

static void close_window(struct window *w)
{
    loaded_release(w->loaded);
    loader_stop(w->loader);
    unlink(w->path);
    rmdir(w->folder);
    pthread_mutex_destroy(&w->mutex);
    pthread_cond_destroy(&w->news);
}

static double width(const struct loaded *s)
{
    return s->model.bounds.max.x;
}

// A save may be noticed twice.
static struct loaded *wait_for_width(struct window *w, double wanted)
{
    double before = w->loaded ? width(w->loaded) : wanted;
    for (;;) {
        struct loaded *s = wait_for_model(w);
        if (width(s) == wanted)
            return s;
        assert_true(width(s) == before);
    }
}

static void edits_come_through(void **state)
{
    (void)state;
    struct window w;
    struct error err;
    open_window(&w, "cube(5);");
    struct loaded *s = wait_for_model(&w);
    assert_true(width(s) == 5 && s->version == 0);
    struct edit *e = edit_new(s->source);
    for (int i = 1; i <= 200; i++) { // a slider: some are left out, the last is not
        assert_true(edit_set_number(e, 0, 0, 0, 5 + i, &err));
        loader_edit(w.loader, e);
    }
    do
        s = wait_for_model(&w);
    while (s->version != edit_version(e));
    assert_true(width(s) == 205);
    assert_ptr_equal(s->source, edit_source(e));
    assert_true(edit_undo(e));
    loader_edit(w.loader, e);
    wait_for_width(&w, 5);
    edit_delete(e);
    close_window(&w);
}

// Once a newer file is there, edits of the older one are over.
static void a_save_ends_edits(void **state)
{
    (void)state;
    struct window w;
    struct error err;
    open_window(&w, "cube(5);");
    struct edit *e = edit_new(wait_for_model(&w)->source);
    save(&w, "cube(7);");
    struct loaded *s = wait_for_width(&w, 7);
    assert_true(edit_set_number(e, 0, 0, 0, 100, &err));
    loader_edit(w.loader, e);
    edit_delete(e);
    e = edit_new(s->source);
    assert_true(edit_set_number(e, 0, 0, 0, 9, &err));
    loader_edit(w.loader, e);
    s = wait_for_width(&w, 9); // not 100
    // What was edited is saved: the same again, from the file.
    char *text;
    size_t size;
    assert_true(edit_text(e, &text, &size, &err));
    save(&w, text);
    free(text);
    s = wait_for_width(&w, 9);
    assert_true(s->version == 0 && s->source != edit_source(e));
    edit_delete(e);
    close_window(&w);
}

static void a_window_closes_among_edits(void **state)
{
    (void)state;
    for (int round = 0; round < 20; round++) {
        struct window w;
        struct error err;
        open_window(&w, "difference() { cube(5); sphere(4); }");
        struct edit *e = edit_new(wait_for_model(&w)->source);
        for (int i = 0; i < round; i++) {
            assert_true(edit_set_number(e, 1, 0, 0, 6 + i, &err));
            loader_edit(w.loader, e);
        }
        edit_delete(e);
        close_window(&w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_come_through),
        cmocka_unit_test(a_save_ends_edits),
        cmocka_unit_test(a_window_closes_among_edits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
