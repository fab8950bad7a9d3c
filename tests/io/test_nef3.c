// test_nef3.c - NEF3 files: two that OpenSCAD wrote, changed ones, and hostile ones.
#include "base/file.h"
#include "io/read_nef3.h"

#include "reading.h"

// intersection() { cube([1, 2, 3]); translate([0.25, 0, 0]) cube(4); }
#define BOX "box.nef3"
// difference() { cube(10); translate([2, 2, -1]) cube([2, 2, 20]); translate([6, 6, 5]) cube(2); }
#define HOLES "holes.nef3"

static char *seed_of(const char *name, size_t *size)
{
    char path[1000], *data;
    struct error err;
    snprintf(path, sizeof path, "%s/%s", FOLDER, name);
    if (!file_read(path, 1 << 20, &data, size, &err))
        fail_msg("%s", err.text);
    return data;
}

// The box with the first place of `old` changed.
static char *changed(const char *old, const char *new, size_t *size)
{
    char *data = seed_of(BOX, size), *at = strstr(data, old);
    assert_non_null(at);
    size_t before = (size_t)(at - data), more = strlen(new), after = strlen(at + strlen(old));
    char *out = mem_alloc(before + more + after + 1);
    memcpy(out, data, before);
    memcpy(out + before, new, more);
    memcpy(out + before + more, at + strlen(old), after + 1);
    free(data);
    *size = before + more + after;
    return out;
}

static void accept(char *data, size_t size, uint32_t vertices, uint32_t triangles, double volume)
{
    struct mesh m;
    struct error err;
    if (!read_mesh(read_nef3, "file", data, size, &m, &err))
        fail_msg("%s", err.text);
    assert_mesh(&m, vertices, triangles, volume);
    assert_true(mesh_is_closed(&m));
    mesh_free(&m);
    free(data);
}

static void refuse(const char *old, const char *new, const char *message)
{
    struct mesh m;
    struct error err;
    size_t size;
    char *data = changed(old, new, &size);
    assert_false(read_mesh(read_nef3, "file", data, size, &m, &err));
    assert_string_equal(err.text, message);
    free(data);
}

static void solids(void **state)
{
    (void)state;
    struct mesh m;
    struct error err;
    size_t size;
    char *data = seed_of(BOX, &size);
    assert_true(read_mesh(read_nef3, "file", data, size, &m, &err));
    assert_int_equal(m.face_count, 6);
    assert_true(mesh_has_vertex(&m, 0.25, 0, 3));
    mesh_free(&m);
    accept(data, size, 8, 12, 4.5);
}

// Two faces with a hole of 8 triangles, 4 sides and 4 walls of 2, and a void of 12.
static void holes_and_voids(void **state)
{
    (void)state;
    size_t size;
    char *data = seed_of(HOLES, &size);
    accept(data, size, 24, 44, 1000 - 40 - 8);
}

// Sheets, and cracks within a solid, bound nothing.
static void volumes_of_one_kind(void **state)
{
    (void)state;
    size_t size;
    char *data = changed("\n1 { 9 } 1\n", "\n1 { 9 } 0\n", &size);
    accept(data, size, 0, 0, 0);
    data = changed("\n0 { 0 } 0\n", "\n0 { 0 } 1\n", &size);
    accept(data, size, 0, 0, 0);
}

// Exact results of booleans are fractions of hundreds of digits: too large for a double, their
// quotient is not.
static void long_fractions(void **state)
{
    (void)state;
    char zeros[4001], text[20000];
    size_t size;
    memset(zeros, '0', sizeof zeros - 1);
    for (size_t length = 280; length < sizeof zeros; length += 31) {
        zeros[length] = 0;
        snprintf(text, sizeof text, "| -1%s -2%s -3%s -1%s }", zeros, zeros, zeros, zeros);
        char *data = changed("| 1 2 3 1 }", text, &size);
        accept(data, size, 8, 12, 4.5);
        zeros[length] = '0';
    }
    zeros[sizeof zeros - 1] = 0;
    snprintf(text, sizeof text, "| 1%s 2 3 1 }", zeros);
    refuse("| 1 2 3 1 }", text, "file:10: expected the line of a vertex");
}

static void wrong_files(void **state)
{
    (void)state;
    const char *header = "file:1: no NEF3 file: expected 'Selective Nef Complex standard'";
    refuse("Selective", "Collective", header);
    refuse("standard", "extended",
           "file:2: no NEF3 file: expected 'Selective Nef Complex standard'");
    refuse("vertices", "edges", "file:3: expected the numbers of items of all kinds");
    refuse("facets     12", "facets -12", "file:5: expected the numbers of items of all kinds");
    refuse("sfaces     16", "sfaces 4294967294", "file:9: more items than the file has room for");
    refuse("vertices   8", "vertices   9", "file:42: expected the line of a halfedge");
    refuse("| 1 2 3 1 }", "| 1 2 3 0 }", "file:10: expected the line of a vertex");
    refuse("| 1 2 3 1 }", "| 1 2 3.5 1 }", "file:10: expected the line of a vertex");
    refuse("{ 5, 0, 0 0 |", "{ 5, 8, 0 0 |", "file:18: expected the line of a halfedge");
    refuse("| 0 0 -1 1 }", "| 0 a -1 1 }", "file:18: expected the line of a halfedge");
    refuse("{ 1, 15 , , 0 |", "{ 1, 48 , , 0 |", "file:42: expected the line of a facet");
    refuse("{ 1, 15 , , 0 |", "{ 1, 15 , , 2 |", "file:42: expected the line of a facet");
    refuse("{ 1, 15 , , 0 |", "{ 12, 15 , , 0 |", "file:42: expected the line of a facet");
    refuse("\n0 { 0 } 0\n", "\n0 { 0 } 2\n", "file:54: expected the line of a volume");
    refuse("{ 1, 15 , , 0 |", "{ 1, 15 15 , , 0 |", "file: facet 0 has no boundary that closes");
}

static void cut_off_files_are_refused(void **state)
{
    (void)state;
    size_t size;
    char *data = seed_of(BOX, &size);
    const char *end = strstr(data, "/*");
    assert_non_null(end);
    for (size_t length = 0; length < (size_t)(end - data) - 1; length += 7) {
        struct mesh m;
        struct error err;
        assert_false(read_mesh(read_nef3, "file", data, length, &m, &err));
    }
    free(data);
}

static void noise_is_survived(void **state)
{
    (void)state;
    size_t size;
    char *good = seed_of(HOLES, &size), *data = mem_alloc(size);
    uint64_t seed = 6;
    for (int round = 0; round < 1000; round++) {
        struct mesh m = {0};
        struct error err;
        memcpy(data, good, size);
        read_mesh(read_nef3, "file", data, spoil(&seed, data, size), &m, &err);
        mesh_free(&m);
    }
    free(data);
    free(good);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids),
        cmocka_unit_test(holes_and_voids),
        cmocka_unit_test(volumes_of_one_kind),
        cmocka_unit_test(long_fractions),
        cmocka_unit_test(wrong_files),
        cmocka_unit_test(cut_off_files_are_refused),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
