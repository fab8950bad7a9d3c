// test_meshes.c - STL and OFF: what is read, and hostile files.
#include "geom/mesh.h"
#include "io/read_off.h"
#include "io/read_stl.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef bool reader(const char *path, const char *data, size_t size, struct mesh *out,
                    struct error *err);

// From memory of exactly the size and one zero byte, so that sanitizers see reads beyond.
static bool read_bytes(reader *read, const void *data, size_t size, struct mesh *out,
                       struct error *err)
{
    char *copy = mem_zalloc(size + 1);
    memcpy(copy, data, size);
    err->text[0] = 0;
    bool ok = read("file", copy, size, out, err);
    free(copy);
    return ok;
}

static void accept(reader *read, const char *text, uint32_t vertices, uint32_t triangles,
                   double volume)
{
    struct mesh m;
    struct error err;
    if (!read_bytes(read, text, strlen(text), &m, &err))
        fail_msg("%s", err.text);
    assert_int_equal(m.vertex_count, vertices);
    assert_int_equal(m.triangle_count, triangles);
    assert_true(fabs(mesh_volume(&m) - volume) < 1e-9);
    mesh_free(&m);
}

static void refuse(reader *read, const char *text, const char *message)
{
    struct mesh m = {.vertex_count = 77};
    struct error err;
    assert_false(read_bytes(read, text, strlen(text), &m, &err));
    assert_int_equal(m.vertex_count, 77);
    assert_string_equal(err.text, message);
}

// A tetrahedron of volume 1/6.
#define FACET(a, b, c)                                                                             \
    "facet normal 0 0 0\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c                 \
    "\n endloop\nendfacet\n"
#define O           "0 0 0"
#define X           "1 0 0"
#define Y           "0 1 0"
#define Z           "0 0 1e0"
#define TETRAHEDRON FACET(O, Y, X) FACET(O, X, Z) FACET(O, Z, Y) FACET(X, Y, Z)

static void text_stl(void **state)
{
    (void)state;
    accept(read_stl, "solid a b c\n" TETRAHEDRON "endsolid\n", 4, 4, 1.0 / 6);
    accept(read_stl, "solid\r\n" FACET(X "\r", "0 1.5 0", Z) "endsolid", 3, 1, 0);
    accept(read_stl, "solid", 0, 0, 0);
    accept(read_stl, "solid\nvertex 1 2 3\nvertex 4 5 6", 0, 0, 0);
    accept(read_stl, "solid\n" FACET(X, X, Y), 0, 0, 0);
    refuse(read_stl, "solid\n" FACET(X, Y, "0 1"),
           "file:6: expected three finite numbers after 'vertex'");
    refuse(read_stl, "solid\n" FACET(X, "0 nan 0", Y),
           "file:5: expected three finite numbers after 'vertex'");
    refuse(read_stl, "solid\n" FACET("1e999 0 0", X, Y),
           "file:4: expected three finite numbers after 'vertex'");
    refuse(read_stl, "solid\nvertex 1 2 3x\n",
           "file:2: expected three finite numbers after 'vertex'");
    refuse(read_stl, "solid\n" FACET(X, Y, Z "\nvertex 1 2 3"),
           "file:7: a fourth vertex in one facet");
    refuse(read_stl, "",
           "file: no STL file: neither text nor as long as its count of triangles says");
    refuse(read_stl, "OFF 0 0 0",
           "file: no STL file: neither text nor as long as its count of triangles says");
}

static size_t binary_stl(char *out, uint32_t said, uint32_t there, const float *floats)
{
    memset(out, 0, 84 + 50 * (size_t)there);
    memcpy(out, "solid of the other kind", 23); // as some programs write it
    memcpy(out + 80, &said, 4);                 // little-endian like the machines that run this
    for (uint32_t i = 0; i < there; i++)
        memcpy(out + 84 + 50 * i + 12, floats + 9 * i, 36);
    return 84 + 50 * (size_t)there;
}

static void binary_stl_files(void **state)
{
    (void)state;
    float t[36] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                   0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    char data[84 + 50 * 4];
    struct mesh m;
    struct error err;
    size_t size = binary_stl(data, 4, 4, t);
    assert_true(read_bytes(read_stl, data, size, &m, &err));
    assert_int_equal(m.vertex_count, 4);
    assert_int_equal(m.face_count, 4);
    assert_true(fabs(mesh_volume(&m) - 1.0 / 6) < 1e-9);
    mesh_free(&m);

    t[20] = NAN;
    size = binary_stl(data, 4, 4, t);
    assert_false(read_bytes(read_stl, data, size, &m, &err));
    assert_string_equal(err.text, "file: triangle 2 has a coordinate that is not finite");

    data[0] = 'b'; // no text either when the count lies
    size = binary_stl(data, 0xffffffffu, 4, t);
    data[0] = 'b';
    assert_false(read_bytes(read_stl, data, size, &m, &err));
    size = binary_stl(data, 4, 4, t);
    data[0] = 'b';
    assert_false(read_bytes(read_stl, data, size - 1, &m, &err));
    assert_false(read_bytes(read_stl, data, 83, &m, &err));
    size = binary_stl(data, 0, 0, t);
    assert_true(read_bytes(read_stl, data, size, &m, &err));
    assert_int_equal(m.triangle_count, 0);
    mesh_free(&m);
}

static void off_files(void **state)
{
    (void)state;
    accept(read_off, "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
           4, 4, 1.0 / 6);
    accept(read_off,
           "# a cube\nOFF 8 6 0 # counts here\n\n0 0 0 9 9 9\n1 0 0\n\n1 1 0 # corner\n0 1 0\n0 0 "
           "1\n1 0 1\n1 1 1\n0 1 1\n4 3 2 1 0 255 0 0\n4 4 5 6 7\n4 0 1 5 4 0.5 0.5 0.5\n4 1 2 6 "
           "5\n4 2 3 7 6\n4 3 0 4 7",
           8, 12, 1);
    accept(read_off, "COFF\r\n3 2\r\n0 0 0 255 0 0 255\r\n1 0 0\r\n0 1 0\r\n2 0 1\r\n3\r\n0\r\n1 2",
           3, 1, 0);
    accept(read_off, "0 0 0", 0, 0, 0);
    refuse(read_off, "", "file:1: no OFF file: empty");
    refuse(read_off, "# only this", "file:1: no OFF file: empty");
    refuse(read_off, "solid", "file:1: no OFF file: expected OFF in front");
    refuse(read_off, "OFF BINARY\n", "file:1: binary OFF files cannot be read");
    refuse(read_off, "OFF\n-1 2 3\n", "file:2: expected the numbers of vertices and faces");
    refuse(read_off, "OFF 99999999999 1 0", "file:1: expected the numbers of vertices and faces");
    refuse(read_off, "OFF 4000000000 1 0\n0 0 0\n",
           "file:3: expected three finite numbers for each vertex");
    refuse(read_off, "OFF 1 1 0\n0 inf 0\n",
           "file:2: expected three finite numbers for each vertex");
    refuse(read_off, "OFF 1 4000000000 0\n0 0 0\n3 0 0 0\n",
           "file:4: expected the number of corners of a face");
    refuse(read_off, "OFF 1 1 0\n0 0 0\n4000000000 0 0 0\n",
           "file:4: expected the number of a vertex as corner of a face");
    refuse(read_off, "OFF 1 1 0\n0 0 0\n3 0 1 0\n",
           "file:3: expected the number of a vertex as corner of a face");
    refuse(read_off, "OFF 1 1 0\n0 0 0\n3 0 -1 0\n",
           "file:3: expected the number of a vertex as corner of a face");
}

// Any bytes give an answer. Cheap insurance; real fuzzing is elsewhere.
static void noise_is_survived(void **state)
{
    (void)state;
    static const char off[] = "OFF 4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4 0 2 1 3\n3 0 1 3\n";
    static const char stl[] = "solid\n" TETRAHEDRON;
    uint64_t seed = 5;
    for (int round = 0; round < 4000; round++) {
        bool is_off = round & 1;
        char data[sizeof stl > sizeof off ? sizeof stl : sizeof off];
        size_t size = is_off ? sizeof off - 1 : sizeof stl - 1;
        memcpy(data, is_off ? off : stl, size);
        for (int i = 0; i < 3; i++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            data[(seed >> 40) % size] =
                (char)(seed >> 33 & 1 ? seed >> 56 : '0' + (seed >> 60) % 10);
        }
        struct mesh m = {0};
        struct error err;
        read_bytes(is_off ? read_off : read_stl, data, size - (seed >> 50) % 4, &m, &err);
        mesh_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_stl),
        cmocka_unit_test(binary_stl_files),
        cmocka_unit_test(off_files),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
