// test_stl.c - STL files: what is read, and hostile ones.
#include "io/read_stl.h"

#include "reading.h"

static void accept(const char *text, uint32_t vertices, uint32_t triangles, double volume)
{
    struct mesh m;
    struct error err;
    if (!read_mesh(read_stl, "file", text, strlen(text), &m, &err))
        fail_msg("%s", err.text);
    assert_mesh(&m, vertices, triangles, volume);
    mesh_free(&m);
}

static void refuse(const char *text, const char *message)
{
    struct mesh m = {.vertex_count = 77};
    struct error err;
    assert_false(read_mesh(read_stl, "file", text, strlen(text), &m, &err));
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
    accept("solid a b c\n" TETRAHEDRON "endsolid\n", 4, 4, 1.0 / 6);
    accept("solid\r\n" FACET(X "\r", "0 1.5 0", Z) "endsolid", 3, 1, 0);
    accept("solid", 0, 0, 0);
    accept("solid\nvertex 1 2 3\nvertex 4 5 6", 0, 0, 0);
    accept("solid\n" FACET(X, X, Y), 0, 0, 0);
    refuse("solid\n" FACET(X, Y, "0 1"), "file:6: expected three finite numbers after 'vertex'");
    refuse("solid\n" FACET(X, "0 nan 0", Y),
           "file:5: expected three finite numbers after 'vertex'");
    refuse("solid\n" FACET("1e999 0 0", X, Y),
           "file:4: expected three finite numbers after 'vertex'");
    refuse("solid\nvertex 1 2 3x\n", "file:2: expected three finite numbers after 'vertex'");
    refuse("solid\n" FACET(X, Y, Z "\nvertex 1 2 3"), "file:7: a fourth vertex in one facet");
    refuse("", "file: no STL file: neither text nor as long as its count of triangles says");
    refuse("OFF 0 0 0",
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
    assert_true(read_mesh(read_stl, "file", data, size, &m, &err));
    assert_int_equal(m.vertex_count, 4);
    assert_int_equal(m.face_count, 4);
    assert_close(mesh_volume(&m), 1.0 / 6, 1e-9);
    mesh_free(&m);

    t[20] = NAN;
    size = binary_stl(data, 4, 4, t);
    assert_false(read_mesh(read_stl, "file", data, size, &m, &err));
    assert_string_equal(err.text, "file: triangle 2 has a coordinate that is not finite");

    data[0] = 'b'; // no text either when the count lies
    size = binary_stl(data, 0xffffffffu, 4, t);
    data[0] = 'b';
    assert_false(read_mesh(read_stl, "file", data, size, &m, &err));
    size = binary_stl(data, 4, 4, t);
    data[0] = 'b';
    assert_false(read_mesh(read_stl, "file", data, size - 1, &m, &err));
    assert_false(read_mesh(read_stl, "file", data, 83, &m, &err));
    size = binary_stl(data, 0, 0, t);
    assert_true(read_mesh(read_stl, "file", data, size, &m, &err));
    assert_int_equal(m.triangle_count, 0);
    mesh_free(&m);
}

// Any bytes give an answer. Cheap insurance; real fuzzing is elsewhere.
static void noise_is_survived(void **state)
{
    (void)state;
    static const char good[] = "solid\n" TETRAHEDRON;
    uint64_t seed = 5;
    for (int round = 0; round < 2000; round++) {
        char data[sizeof good];
        struct mesh m = {0};
        struct error err;
        memcpy(data, good, sizeof good);
        read_mesh(read_stl, "file", data, spoil(&seed, data, sizeof good - 1), &m, &err);
        mesh_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_stl),
        cmocka_unit_test(binary_stl_files),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
