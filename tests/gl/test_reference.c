// test_reference.c - Khronos' reference compiler takes every shader: what one driver lets pass,
// another one refuses. Skipped where there is no glslangValidator.
#include "base/error.h"
#include "render/gl/source.h"
#include "unit.h"

#include <stdlib.h>

// As src/render/gl builds them.
static const struct {
    const char *name, *defines;
} builds[] = {
    {"leaf_view", ""},
    {"select", ""},
    {"scan", "SCAN"},
    {"scan", "IN_PLACE"},
    {"scan", "ADD"},
    {"arguments", ""},
    {"arguments", "TRIANGLES"},
    {"fragments", ""},
    {"fragments", "PIECES"},
    {"fragments", "COUNT"},
    {"fragments", "COUNT PIECES"},
    {"fragments", "HISTOGRAM"},
    {"fragments", "HISTOGRAM PIECES"},
    {"fragments", "LINKED"},
    {"fragments", "LINKED PIECES"},
    {"resolve", "SURFACE LINKED"},
    {"resolve", "SPANS LINKED"},
    {"resolve", "SURFACE"},
    {"resolve", "SPANS"},
    {"resolve", "SURFACE OVER_FRAMES"},
    {"resolve", "SPANS OVER_FRAMES"},
    {"resolve", "SURFACE OVER_FRAMES CARRY"},
    {"resolve", "SPANS OVER_FRAMES CARRY"},
    {"resolve", "SURFACE OVER_FRAMES CARRY"},
    {"resolve", "SPANS OVER_FRAMES CARRY"},
    {"reduce", ""},
    {"resolve", "SURFACE ARRAY VALUES=9 NODES=17"},
    {"resolve", "SPANS ARRAY VALUES=9 NODES=17"},
};

// False with its first complaint in *err.
static bool accepted(const char *name, const char *defines, struct error *err)
{
    struct gl_source source;
    char file[100], command[200], path[] = "/tmp/hcsg-test-reference-XXXXXX", line[300];
    snprintf(file, sizeof file, "%s.comp.glsl", name);
    if (!gl_source_read(&source, NULL, file, defines, err))
        return false;
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    FILE *out = fdopen(fd, "w");
    assert_true(out && fputs(source.text, out) >= 0 && fclose(out) == 0);
    snprintf(command, sizeof command, "glslangValidator -S comp %s", path);
    FILE *said = popen(command, "r");
    assert_non_null(said);
    bool complained = false;
    while (fgets(line, sizeof line, said))
        if (!complained && strstr(line, "ERROR")) {
            gl_source_error(&source, line, err);
            complained = true;
        }
    bool fine = pclose(said) == 0;
    if (!fine && !complained)
        error_set(err, "shaders/%s: glslangValidator failed", file);
    remove(path);
    gl_source_free(&source);
    return fine;
}

static void reference_compiler_takes_all(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        struct error err;
        if (!accepted(builds[i].name, builds[i].defines, &err))
            fail_msg("%s (%s)", err.text, builds[i].defines);
    }
}

// With the place of the mistake.
static void it_can_refuse(void **state)
{
    (void)state;
    struct error err;
    assert_false(accepted("resolve", "SURFACE ARRAY VALUES=none NODES=17", &err));
    assert_non_null(strstr(err.text, "shaders/array.glsl:"));
}

int main(void)
{
    if (system("glslangValidator --version >/dev/null 2>&1"))
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_compiler_takes_all),
        cmocka_unit_test(it_can_refuse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
