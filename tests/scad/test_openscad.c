// test_openscad.c - openscad as a child process, played by small shell scripts.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "scad/openscad.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <uv.h>

// A folder for each test: "program" plays openscad, TMPDIR is "tmp" in it.
static char folder[64];

static char *in_folder(const char *name)
{
    static char path[8][160];
    static int turn;
    char *p = path[turn++ % 8];
    snprintf(p, sizeof path[0], "%s/%s", folder, name);
    return p;
}

// $2 is the export, $4 the rule, $5 the design.
static char *play(const char *script)
{
    char text[2000];
    int n = snprintf(text, sizeof text, "#!/bin/sh\n%s\n", script);
    assert_true(file_write(in_folder("program"), text, (size_t)n, NULL));
    chmod(in_folder("program"), 0755);
    return in_folder("program");
}

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/hcsg-test-XXXXXX");
    if (!mkdtemp(folder) || mkdir(in_folder("tmp"), 0755) != 0)
        return -1;
    return setenv("TMPDIR", in_folder("tmp"), 1);
}

static bool run_export(const char *path, const char *program, struct scad_result *out,
                       struct error *err)
{
    return scad_export(path, &(struct scad_options){.program = program}, out, err);
}

static int entries(const char *path)
{
    int count = 0;
    DIR *d = opendir(path);
    while (d && readdir(d))
        count++;
    if (d)
        closedir(d);
    return count - 2;
}

static int remove_folder(void **state)
{
    (void)state;
    int left = entries(in_folder("tmp"));
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) != 0 || left != 0; // nothing stays behind in TMPDIR
}

static void text_files_and_messages(void **state)
{
    (void)state;
    char *program =
        play("echo 'cube(1);' > $2\n"
             "printf '%s: \\\\\\n\\t/lib/in\\\\ clude.scad \\\\\\n\\t%s\\n' $2 \"$5\" > $4\n"
             "echo 'ECHO: 1' >&2; echo 'noise'");
    struct scad_result r = {0};
    struct error err;
    assert_true(run_export("dir/a part.scad", program, &r, &err));
    assert_string_equal(r.text, "cube(1);\n");
    assert_int_equal(r.size, 9);
    assert_int_equal(r.text[10], 0); // the second zero byte
    assert_string_equal(r.name, "dir/a part.scad (exported)");
    assert_int_equal(r.file_count, 2);
    assert_string_equal(r.files[0], "dir/a part.scad");
    assert_string_equal(r.files[1], "/lib/in clude.scad");
    assert_string_equal(r.log, "ECHO: 1\n");
    scad_result_free(&r);
    scad_result_free(&r);
}

static void expect_failure(const char *script, const char *message)
{
    struct scad_result r = {0};
    struct error err;
    assert_false(run_export("dir/p.scad", play(script), &r, &err));
    assert_null(r.text);
    if (!strstr(err.text, message))
        fail_msg("%s", err.text);
    assert_true(r.file_count >= 1);
    assert_string_equal(r.files[0], "dir/p.scad");
    scad_result_free(&r);
}

static void failures_say_why(void **state)
{
    (void)state;
    expect_failure("echo 'WARNING: w' >&2\n"
                   "echo 'ERROR: Parser error: syntax error in file p.scad, line 4' >&2\n"
                   "echo 'no' >&2; exit 1",
                   "dir/p.scad:4: Parser error: syntax error");
    expect_failure(
        "echo > $2; echo \"ERROR: Assertion 'a' failed in file sub/q.scad, line 12\" >&2",
        "dir/p.scad: Assertion 'a' failed in file sub/q.scad, line 12");
    expect_failure("echo 'Cannot do it' >&2; exit 3", "dir/p.scad: openscad: Cannot do it");
    expect_failure("exit 3", "dir/p.scad: openscad: failed without a message");
    expect_failure("exit 0", "wrote no file");
    expect_failure("kill -SEGV $$", "signal 11");
}

static void named_files_are_known_after_a_failure(void **state)
{
    (void)state;
    struct scad_result r = {0};
    struct error err;
    char expected[200];
    assert_true(file_write(in_folder("q.scad"), "", 0, NULL));
    snprintf(expected, sizeof expected, "%s:7: bad", in_folder("q.scad"));
    assert_false(run_export(in_folder("p.scad"),
                            play("echo 'ERROR: bad in file q.scad, line 7' >&2; exit 1"), &r,
                            &err));
    assert_int_equal(r.file_count, 2);
    assert_string_equal(r.files[1], in_folder("q.scad"));
    assert_string_equal(err.text, expected);
    scad_result_free(&r);
}

static void an_error_beside_a_tree_is_no_failure(void **state)
{
    (void)state;
    struct scad_result r = {0};
    assert_true(
        run_export("p.scad", play("echo 'cube();' > $2; echo 'ERROR: points' >&2"), &r, NULL));
    assert_string_equal(r.log, "ERROR: points\n");
    scad_result_free(&r);
}

static void an_empty_design_is_no_failure(void **state)
{
    (void)state;
    struct scad_result r = {0};
    assert_true(run_export("p.scad", play("echo > $2"), &r, NULL));
    assert_string_equal(r.text, "\n");
    scad_result_free(&r);
}

static void of_endless_messages_the_newest_stay(void **state)
{
    (void)state;
    struct scad_result r = {0};
    struct error err;
    assert_false(run_export("p.scad",
                            play("head -c 20000000 /dev/zero | tr '\\0' 'x' >&2\n"
                                 "yes 'ECHO: again' | head -n 300000 >&2\n"
                                 "echo 'ERROR: last' >&2; exit 1"),
                            &r, &err));
    assert_true(strlen(r.log) <= 1 << 19);
    assert_non_null(strstr(err.text, "last"));
    scad_result_free(&r);
}

static void missing_program_is_named(void **state)
{
    (void)state;
    struct scad_result r = {0};
    struct error err;
    assert_false(run_export("p.scad", "/no/such/openscad", &r, &err));
    assert_non_null(strstr(err.text, "/no/such/openscad: no such file"));
    scad_result_free(&r);
}

static void program_comes_from_the_environment(void **state)
{
    (void)state;
    struct scad_result r = {0};
    setenv("OPENSCAD", play("echo 'sphere();' > $2"), 1);
    assert_true(run_export("p.scad", NULL, &r, NULL));
    unsetenv("OPENSCAD");
    assert_string_equal(r.text, "sphere();\n");
    scad_result_free(&r);
}

static void arguments_are_handed_on(void **state)
{
    (void)state;
    struct scad_result r = {0};
    const char *const words[] = {"-D", "a=\"b c\"", "--render"};
    const struct scad_options options = {.program =
                                             play("printf '%s|' \"$5\" \"$6\" \"$7\" \"$8\" > $2"),
                                         .arguments = words,
                                         .argument_count = array_count(words)};
    assert_true(scad_export("p.scad", &options, &r, NULL));
    assert_string_equal(r.text, "-D|a=\"b c\"|--render|p.scad|");
    scad_result_free(&r);
}

static void animations_have_a_text_for_each_frame(void **state)
{
    (void)state;
    struct scad_result r = {0};
    struct scad_options options = {
        .program = play("for i in 0 1 2; do echo \"$5 $6 $i\" > ${2%.csg}0000$i.csg; done"),
        .frames = 3};
    assert_true(scad_export("p.scad", &options, &r, NULL));
    assert_null(r.text);
    assert_int_equal(r.frames.count, 3);
    assert_int_equal(entries(in_folder("tmp")), 0);
    for (uint32_t i = 3; i--;) {
        struct scad_text text;
        char expected[32];
        int n = snprintf(expected, sizeof expected, "--animate 3 %u\n", i);
        assert_true(scad_read_frame(&r.frames, i, &text, NULL));
        assert_memory_equal(text.text, expected, (size_t)n + 1);
        assert_int_equal(text.size, n);
        assert_int_equal(text.text[text.size + 1], 0);
        free(text.text);
    }
    scad_result_free(&r);
    struct error err;
    options.frames = 4;
    assert_false(scad_export("p.scad", &options, &r, &err));
    assert_int_equal(r.frames.count, 0);
    assert_non_null(strstr(err.text, "wrote no file (frame 00003)"));
    scad_result_free(&r);
}

static void a_dash_in_front_is_no_option(void **state)
{
    (void)state;
    struct scad_result r = {0};
    assert_true(run_export("-o.scad", play("echo \"$5\" > $2"), &r, NULL));
    assert_string_equal(r.text, "./-o.scad\n");
    scad_result_free(&r);
}

static void count_done(void *context, struct scad_result *result, const struct error *err)
{
    (void)err;
    ++*(int *)context;
    scad_result_free(result);
}

static void cancel(uv_timer_t *timer)
{
    scad_cancel(timer->data);
    uv_close((uv_handle_t *)timer, NULL);
}

static void cancelling_kills_the_whole_family(void **state)
{
    (void)state;
    char script[300];
    snprintf(script, sizeof script, "sh -c 'sleep 20; touch %s'; touch %s", in_folder("child"),
             in_folder("parent"));
    uv_loop_t loop;
    uv_timer_t timer;
    int done = 0;
    uv_loop_init(&loop);
    double start = clock_seconds();
    const struct scad_options options = {.program = play(script)};
    timer.data = scad_start(&loop, "p.scad", &options, count_done, &done);
    assert_true(clock_seconds() - start < 1);
    uv_timer_init(&loop, &timer);
    uv_timer_start(&timer, cancel, 100, 0);
    uv_run(&loop, UV_RUN_DEFAULT);
    assert_int_equal(uv_loop_close(&loop), 0);
    assert_true(clock_seconds() - start < 5);
    assert_int_equal(done, 0);
    assert_int_not_equal(access(in_folder("parent"), F_OK), 0);
}

static void write_text(const char *path, const char *text)
{
    assert_true(file_write(path, text, strlen(text), NULL));
}

static void includes_are_known_without_a_rule(void **state)
{
    (void)state;
    struct scad_result r = {0};
    mkdir(in_folder("sub"), 0755);
    write_text(in_folder("p.scad"), "include<a.scad>\nuse\t <sub/b.scad> reuse <no.scad>\n"
                                    "x = 1 < 2; include <> include <far.scad");
    write_text(in_folder("a.scad"), "include <p.scad> include <sub/../a.scad>");
    write_text(in_folder("sub/b.scad"), "use <../a.scad> use <missing.scad>");
    assert_false(run_export(in_folder("p.scad"), play("echo 'ERROR: no' >&2; exit 1"), &r, NULL));
    assert_int_equal(r.file_count, 4);
    assert_string_equal(r.files[0], in_folder("p.scad"));
    assert_string_equal(r.files[1], in_folder("a.scad"));
    assert_string_equal(r.files[2], in_folder("sub/b.scad"));
    assert_string_equal(r.files[3], in_folder("sub/missing.scad"));
    scad_result_free(&r);
}

static void signals_end_openscad_first(void **state)
{
    (void)state;
    char script[300];
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    snprintf(script, sizeof script, "touch $2; touch %s; sleep 20", in_folder("begun"));
    char *program = mem_strdup(play(script));
    for (size_t i = 0; i < array_count(numbers); i++) {
        pid_t child = fork();
        if (child == 0) {
            struct scad_result r = {0};
            signal(numbers[i], SIG_DFL);
            run_export("p.scad", program, &r, NULL);
            _exit(0);
        }
        for (int wait = 0; wait < 1000 && access(in_folder("begun"), F_OK) != 0; wait++)
            usleep(10000);
        unlink(in_folder("begun"));
        int status;
        kill(child, numbers[i]);
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status));
        assert_int_equal(WTERMSIG(status), numbers[i]);
        assert_int_equal(entries(in_folder("tmp")), 0);
    }
    free(program);
}

static void the_real_program(void **state)
{
    (void)state;
    if (system("command -v openscad > /dev/null") != 0)
        skip();
    struct scad_result r = {0};
    struct error err;
    char *path = mem_strdup(in_folder("real.scad"));
    static const char good[] = "for (i = [0 : 2]) translate([i, 0, 0]) cube(1);";
    static const char bad[] = "cube(1);\ncube(2\n";
    assert_true(file_write(path, good, strlen(good), NULL));
    assert_true(run_export(path, "openscad", &r, &err));
    assert_non_null(strstr(r.text, "cube(size = [1, 1, 1]"));
    assert_int_equal(r.file_count, 1);
    scad_result_free(&r);
    assert_true(file_write(path, bad, strlen(bad), NULL));
    assert_false(run_export(path, "openscad", &r, &err));
    assert_memory_equal(err.text, path, strlen(path));
    assert_non_null(strstr(err.text, "real.scad:4: Parser error"));
    scad_result_free(&r);
    free(path);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(text_files_and_messages),
        TEST(failures_say_why),
        TEST(named_files_are_known_after_a_failure),
        TEST(an_error_beside_a_tree_is_no_failure),
        TEST(an_empty_design_is_no_failure),
        TEST(of_endless_messages_the_newest_stay),
        TEST(missing_program_is_named),
        TEST(program_comes_from_the_environment),
        TEST(arguments_are_handed_on),
        TEST(animations_have_a_text_for_each_frame),
        TEST(a_dash_in_front_is_no_option),
        TEST(cancelling_kills_the_whole_family),
        TEST(includes_are_known_without_a_rule),
        TEST(signals_end_openscad_first),
        TEST(the_real_program),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
