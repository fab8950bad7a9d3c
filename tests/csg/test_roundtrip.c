// test_roundtrip.c - OpenSCAD's own exports come out of parse and print byte for byte.
#include "base/file.h"
#include "csg/csg.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>
// clang-format on

enum difference {
    NONE,
    FINAL_LINE, // OpenSCAD ends an export with an empty line; older exports lack it
    LAYOUT,     // the expected file was put together by hand: its outermost levels are not indented
    DIGITS,     // written by an older OpenSCAD, which printed matrices with 11 digits
    REFUSED,    // holds a bare word of an older OpenSCAD (join_type = round), no value to any other
};

static const struct {
    const char *file;
    enum difference difference;
} exceptions[] = {
    {"hull-tests-expected.csg", LAYOUT},
    {"minkowski-tests-expected.csg", LAYOUT},
    {"polygon-illegal-winding-expected.csg", LAYOUT},
    {"polyset-reduce-crash-expected.csg", LAYOUT},
    {"intersecting-expected.csg", DIGITS},
    {"surface-expected.csg", DIGITS},
    {"translate-expected.csg", DIGITS},
    {"example025-expected.csg", REFUSED},
};

static const char *const folders[] = {"dumptest", "dumptest-examples", "lazyunion-dump"};
#define DATA "/usr/share/openscad/regression/"

static char *print_again(const char *text, size_t length)
{
    struct messages messages = {0};
    struct csg_tree tree;
    char *copy = mem_zalloc(length + 2);
    size_t size;

    memcpy(copy, text, length);
    assert_true(csg_parse(&tree, "printed", copy, length, &messages));
    free(copy);
    copy = csg_print(&tree, &size);
    csg_free(&tree);
    messages_free(&messages);
    return copy;
}

static void without_blanks(char *text)
{
    char *out = text;

    for (; *text; text++)
        if (!strchr(" \t\n", *text))
            *out++ = *text;
    *out = 0;
}

static enum difference compare(char *printed, char *expected)
{
    size_t length = strlen(expected);

    if (strcmp(printed, expected) == 0)
        return NONE;
    if (strncmp(printed, expected, length) == 0 && strcmp(printed + length, "\n") == 0)
        return FINAL_LINE;
    without_blanks(printed);
    without_blanks(expected);
    return strcmp(printed, expected) == 0 ? LAYOUT : DIGITS;
}

static enum difference round_trip(const char *path)
{
    struct messages messages = {0};
    struct csg_tree tree;
    struct error err;
    char *expected, *printed, *again;
    size_t size;

    if (!csg_parse_file(&tree, path, &messages)) {
        messages_free(&messages);
        return REFUSED;
    }
    assert_true(file_read(path, 1 << 24, &expected, &size, &err));
    printed = csg_print(&tree, &size);
    assert_int_equal(size, strlen(printed));
    again = print_again(printed, size);
    assert_string_equal(printed, again);
    enum difference difference = compare(printed, expected);
    csg_free(&tree);
    free(expected);
    free(printed);
    free(again);
    return difference;
}

static enum difference allowed(const char *folder, const char *file)
{
    for (size_t i = 0; i < array_count(exceptions); i++)
        if (strcmp(exceptions[i].file, file) == 0 &&
            (exceptions[i].difference == LAYOUT) == (strcmp(folder, "dumptest") == 0))
            return exceptions[i].difference;
    return FINAL_LINE;
}

static void exports_come_back(void **state)
{
    int files = 0, wrong = 0;

    (void)state;
    for (size_t i = 0; i < array_count(folders); i++) {
        char path[512];
        snprintf(path, sizeof path, DATA "%s", folders[i]);
        DIR *dir = opendir(path);
        for (struct dirent *entry; dir && (entry = readdir(dir));) {
            if (strcmp(file_extension(entry->d_name), "csg") != 0)
                continue;
            snprintf(path, sizeof path, DATA "%s/%s", folders[i], entry->d_name);
            enum difference found = round_trip(path), most = allowed(folders[i], entry->d_name);
            files++;
            if (found == most || (found == NONE && most == FINAL_LINE))
                continue;
            printf("%s: difference %d, allowed %d\n", path, found, most);
            wrong++;
        }
        if (dir)
            closedir(dir);
    }
    printf("%d files\n", files);
    assert_int_equal(wrong, 0);
    assert_true(files > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(exports_come_back)};
    DIR *dir = opendir(DATA "dumptest");

    if (!dir) {
        printf("skipped: needs the package openscad-testing-data\n");
        return 77;
    }
    closedir(dir);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
