// test_program.c - shaders compile, say where they are wrong, and are read again when they change.
#include "base/file.h"
#include "render/gl/program.h"
#include "render/gl/source.h"
#include "shaders/shared.h"
#include "unit.h"

#include <epoxy/gl.h>
#include <unistd.h>

static char folder[] = "/tmp/hcsg-test-program-XXXXXX";

static void put(const char *name, const char *text)
{
    struct error err;
    char *path = file_join(folder, name);
    assert_true(file_write(path, text, strlen(text), &err));
    free(path);
}

static void all_shaders_compile(void **state)
{
    (void)state;
    struct gl_programs p = {0};
    for (size_t i = 0; i < gl_file_count; i++) {
        char name[100];
        snprintf(name, sizeof name, "%s", gl_files[i].name);
        char *end = strstr(name, ".comp.glsl");
        if (!end)
            continue;
        *end = 0;
        struct error err;
        if (!gl_program(&p, name, "", &err))
            fail_msg("%s", err.text);
    }
    gl_programs_free(&p);
}

static void what_c_and_shaders_share_compiles(void **state)
{
    (void)state;
    struct gl_programs p = {.folder = folder};
    struct error err;
    for (size_t i = 0; i < gl_file_count; i++)
        if (!strcmp(gl_files[i].name, "shared.h"))
            put("shared.h", gl_files[i].text);
    put("share.comp.glsl", "#include \"shared.h\"\n"
                           "layout(local_size_x = GROUP_SIZE) in;\n"
                           "void main() {}\n");
    unsigned program = gl_program(&p, "share", "", &err);
    if (!program)
        fail_msg("%s", err.text);
    GLint group[3];
    glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, group);
    assert_int_equal(group[0], GROUP_SIZE);
    gl_programs_free(&p);
}

static void assert_wrong(const char *text)
{
    struct gl_programs p = {.folder = folder};
    struct error err;
    assert_int_equal(gl_program(&p, "wrong", "", &err), 0);
    if (strncmp(err.text, text, strlen(text)))
        fail_msg("'%s' instead of '%s'", err.text, text);
    assert_null(strchr(err.text, '\n'));
    gl_programs_free(&p);
}

static void errors_have_their_place(void **state)
{
    (void)state;
    put("part.glsl", "#pragma once\n\nint two() { return 2; }\n");
    put("wrong.comp.glsl", "#include \"part.glsl\"\n#include \"part.glsl\"\n"
                           "layout(local_size_x = 1) in;\nvoid main() { three(); }\n");
    assert_wrong("shaders/wrong.comp.glsl:4: ");
    put("part.glsl", "\n\nint two() { return x; }\n");
    assert_wrong("shaders/part.glsl:3: ");
    put("wrong.comp.glsl", "\n  #include \"nothing.glsl\"\nvoid main() {}\n");
    assert_wrong("shaders/wrong.comp.glsl:2: ");
}

static void logs_of_other_compilers(void **state)
{
    (void)state;
    char *names[] = {"a.comp.glsl", "b.glsl"};
    struct gl_line lines[] = {{0, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 2}, {0, 3}};
    const struct gl_source s = {.files = names,
                                .file_count = 2,
                                .lines = lines,
                                .line_count = sizeof lines / sizeof *lines};
    static const char *const cases[][2] = {
        {"0:3(2): warning: odd\n0:5(5): error: `x' undeclared\n",
         "shaders/b.glsl:2: error: `x' undeclared"},
        {"0(4) : error C1008: undefined variable \"x\"\n0(6) : error C0000: more\n",
         "shaders/b.glsl:1: error C1008: undefined variable \"x\""},
        {"ERROR: 0:6: 'x' : undeclared identifier \nERROR: 1 compilation errors\n",
         "shaders/a.comp.glsl:3: 'x' : undeclared identifier "},
        {"error: too many buffers", "shaders/a.comp.glsl: error: too many buffers"},
        {"0:1(1): error: odd #define", "shaders/a.comp.glsl: 0:1(1): error: odd #define"},
        {"0:7(1): error: no such line", "shaders/a.comp.glsl: 0:7(1): error: no such line"},
        {"0:0: error", "shaders/a.comp.glsl: 0:0: error"},
        {"", "shaders/a.comp.glsl: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error err;
        gl_source_error(&s, cases[i][0], &err);
        assert_string_equal(err.text, cases[i][1]);
    }
}

static int said;
static char last[1024];

static void hear(void *context, const char *line)
{
    (void)context;
    snprintf(last, sizeof last, "%s", line);
    said++;
}

static void put_group(int size, const char *end)
{
    char text[200];
    snprintf(text, sizeof text, "layout(local_size_x = %d * TIMES) in;\n%s\n", size, end);
    put("size.glsl", text);
}

static int group_of(unsigned program)
{
    GLint group[3] = {0};
    glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, group);
    return group[0];
}

static void changed_shaders_are_read_again(void **state)
{
    (void)state;
    struct gl_programs p;
    struct error err;
    setenv("HCSG_SHADERS", folder, 1);
    gl_programs_init(&p, &(struct gl_log){hear, NULL});
    put("live.comp.glsl", "#include \"size.glsl\"\nvoid main() {}\n");
    put_group(8, "");
    unsigned single = gl_program(&p, "live", "TIMES=1", &err);
    unsigned twice = gl_program(&p, "live", "TIMES=2 OTHER", &err);
    assert_int_equal(group_of(single), 8);
    assert_int_equal(group_of(twice), 16);
    assert_int_equal(gl_program(&p, "live", "TIMES=1", &err), single);

    put_group(4, "");
    assert_int_equal(group_of(gl_program(&p, "live", "TIMES=1", &err)), 4);
    assert_int_equal(said, 0);

    put_group(4, "wrong");
    unsigned kept = gl_program(&p, "live", "TIMES=1", &err);
    assert_int_equal(group_of(kept), 4);
    assert_int_equal(said, 1);
    assert_memory_equal(last, "shaders/", 8);
    assert_int_equal(gl_program(&p, "live", "TIMES=1", &err), kept);
    assert_int_equal(said, 1);
    put_group(32, "");
    assert_int_equal(group_of(gl_program(&p, "live", "TIMES=1", &err)), 32);
    gl_programs_free(&p);
    unsetenv("HCSG_SHADERS");
}

int main(void)
{
    struct error err;
    struct gl_context *c = unit_context();
    if (!mkdtemp(folder) || !gl_context_enter(c, &err))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_shaders_compile),
        cmocka_unit_test(what_c_and_shaders_share_compiles),
        cmocka_unit_test(errors_have_their_place),
        cmocka_unit_test(logs_of_other_compilers),
        cmocka_unit_test(changed_shaders_are_read_again),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    gl_context_leave(c);
    gl_context_delete(c);
    static const char *const left[] = {"shared.h",        "share.comp.glsl", "part.glsl",
                                       "wrong.comp.glsl", "size.glsl",       "live.comp.glsl"};
    for (size_t i = 0; i < sizeof left / sizeof *left; i++) {
        char *path = file_join(folder, left[i]);
        unlink(path);
        free(path);
    }
    rmdir(folder);
    return failed;
}
