// test_watch.c - saving in all the ways that editors know.
#include "app/watch.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <uv.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static char folder[64];
static uv_loop_t loop;
static struct watch *watch;
static int saves;
static double seen_at, noticed_at;

static void on_saved(void *context, double noticed)
{
    (void)context;
    saves++;
    noticed_at = noticed;
    seen_at = clock_seconds();
}

static char *path_of(const char *name)
{
    return file_join(folder, name);
}

static void put(const char *name, const char *text)
{
    char *path = path_of(name);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    free(path);
}

static void on_end(uv_timer_t *timer)
{
    uv_stop(timer->loop);
}

// Lets the loop run; returns how many saves were seen.
static int seen_within(uint64_t ms)
{
    uv_timer_t timer;
    saves = 0;
    uv_timer_init(&loop, &timer);
    uv_timer_start(&timer, on_end, ms, 0);
    uv_run(&loop, UV_RUN_DEFAULT);
    uv_close((uv_handle_t *)&timer, NULL);
    uv_run(&loop, UV_RUN_NOWAIT);
    return saves;
}

// Lets the loop run until a save was seen, however busy the machine is, and a little longer:
// returns how many there were.
static int seen_soon(void)
{
    int first = 0;
    for (int i = 0; i < 250 && !first; i++)
        first = seen_within(20);
    return first + seen_within(60);
}

static void watch_since(const char *a, const char *b, double since)
{
    char *paths[2] = {path_of(a), b ? path_of(b) : NULL};
    watch_set(watch, paths, b ? 2 : 1, since);
    free(paths[0]);
    free(paths[1]);
}

static void watch_files(const char *a, const char *b)
{
    watch_since(a, b, INFINITY);
}

static int begin(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/hcsg-watch-XXXXXX");
    if (!mkdtemp(folder) || uv_loop_init(&loop) != 0)
        return -1;
    put("a.csg", "one");
    watch = watch_new(&loop, on_saved, NULL);
    watch_files("a.csg", NULL);
    return 0;
}

static int end(void **state)
{
    (void)state;
    char command[100];
    watch_delete(watch);
    uv_run(&loop, UV_RUN_DEFAULT);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return uv_loop_close(&loop) != 0 || system(command) != 0;
}

static void a_save_is_one_save(void **state)
{
    (void)state;
    assert_int_equal(seen_within(30), 0);
    double before = clock_seconds();
    put("a.csg", "two");
    assert_int_equal(seen_soon(), 1);
    assert_true(noticed_at >= before && seen_at >= noticed_at);
}

static void others_in_the_folder_do_not_matter(void **state)
{
    (void)state;
    put("b.csg", "two");
    put("a.csg~", "two");
    assert_int_equal(seen_within(60), 0);
}

static void renaming_over_it_is_a_save(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        put("a.csg.new", "two");
        char *from = path_of("a.csg.new"), *to = path_of("a.csg");
        assert_int_equal(rename(from, to), 0);
        free(from);
        free(to);
        assert_int_equal(seen_soon(), 1);
    }
}

static void deleting_and_coming_back_are_seen(void **state)
{
    (void)state;
    char *path = path_of("a.csg");
    unlink(path);
    assert_int_equal(seen_soon(), 1);
    put("a.csg", "back");
    assert_int_equal(seen_soon(), 1);
    free(path);
}

static uv_timer_t writer;
static int pieces;

static void write_piece(uv_timer_t *timer)
{
    char *path = path_of("a.csg");
    FILE *f = fopen(path, "a");
    fputs("piece", f);
    fclose(f);
    free(path);
    if (--pieces == 0)
        uv_timer_stop(timer);
}

static void pieces_that_follow_closely_are_one_save(void **state)
{
    (void)state;
    double begun = clock_seconds();
    int count = 0;
    pieces = 40;
    uv_timer_init(&loop, &writer);
    uv_timer_start(&writer, write_piece, 1, 1);
    while (pieces || !count)
        count += seen_within(20);
    uv_close((uv_handle_t *)&writer, NULL);
    count += seen_within(60);
    // one, but on a busy machine the pieces may take longer than a save is put off
    assert_in_range(count, 1, 1 + (int)((clock_seconds() - begun) / 0.25));
}

static void a_link_is_followed(void **state)
{
    (void)state;
    char *other = path_of("other"), *link = path_of("link.csg");
    assert_int_equal(mkdir(other, 0755), 0);
    put("other/real.csg", "one");
    assert_int_equal(symlink("other/real.csg", link), 0);
    watch_files("link.csg", NULL);
    put("other/real.csg", "two");
    assert_int_equal(seen_soon(), 1);
    free(other);
    free(link);
}

static void a_folder_may_come_later_and_go(void **state)
{
    (void)state;
    char *late = path_of("late");
    watch_files("a.csg", "late/b.csg");
    assert_int_equal(mkdir(late, 0755), 0);
    put("late/b.csg", "one");
    assert_int_equal(seen_soon(), 1); // by looking
    put("late/b.csg", "two");
    assert_int_equal(seen_soon(), 1); // by events
    free(late);
}

static void watching_can_change(void **state)
{
    (void)state;
    put("b.csg", "one");
    watch_files("b.csg", "a.csg");
    put("b.csg", "two");
    assert_int_equal(seen_soon(), 1);
    watch_files("b.csg", NULL);
    put("a.csg", "two");
    assert_int_equal(seen_within(60), 0);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, begin, end)

static void what_changed_before_it_was_known_counts(void **state)
{
    (void)state;
    double before = clock_seconds();
    put("b.csg", "one");
    watch_since("a.csg", "b.csg", before);
    assert_int_equal(seen_soon(), 1);
    watch_since("a.csg", "c.csg", before); // not there
    assert_int_equal(seen_within(50), 0);
    put("c.csg", "one");
    watch_since("a.csg", "b.csg", INFINITY);
    assert_int_equal(seen_within(50), 0);
}

static void a_save_is_not_lost_while_files_are_set(void **state)
{
    (void)state;
    assert_int_equal(seen_within(30), 0);
    put("a.csg", "two");
    watch_files("a.csg", "b.csg");
    assert_int_equal(seen_soon(), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_save_is_one_save),
        TEST(others_in_the_folder_do_not_matter),
        TEST(renaming_over_it_is_a_save),
        TEST(deleting_and_coming_back_are_seen),
        TEST(pieces_that_follow_closely_are_one_save),
        TEST(a_link_is_followed),
        TEST(a_folder_may_come_later_and_go),
        TEST(watching_can_change),
        TEST(what_changed_before_it_was_known_counts),
        TEST(a_save_is_not_lost_while_files_are_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
