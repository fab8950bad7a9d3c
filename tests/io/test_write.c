// test_write.c - STL, OFF and DXF files as they are written.
#include "io/write_dxf.h"
#include "io/write_off.h"
#include "io/write_stl.h"

#include "../geom/unit.h"
#include "base/file.h"
#include "io/read_stl.h"
#include "written.h"

// What the file holds now, which goes.
static char *written(size_t *size)
{
    char *data;
    struct error err;
    assert_true(file_read(written_path, 1 << 20, &data, size, &err));
    unlink(written_path);
    return data;
}

static void expect(const char *text)
{
    size_t size;
    char *data = written(&size);
    assert_string_equal(data, text);
    assert_int_equal(size, strlen(text));
    free(data);
}

// OpenSCAD writes the numbers of its mesh in single precision; these are as short in both.
static struct mesh tetrahedron(void)
{
    struct mesh_builder b = {0};
    mesh_add_vertex(&b, (struct vec3){-0.0, 0, 0});
    mesh_add_vertex(&b, (struct vec3){2.5, 0, 0});
    mesh_add_vertex(&b, (struct vec3){0, 1e-7, 0});
    mesh_add_vertex(&b, (struct vec3){0, 0, 12345678});
    mesh_add_triangle(&b, 0, 2, 1, mesh_add_face(&b));
    mesh_add_triangle(&b, 0, 1, 3, mesh_add_face(&b));
    mesh_add_triangle(&b, 0, 3, 2, mesh_add_face(&b));
    mesh_add_triangle(&b, 1, 2, 3, mesh_add_face(&b));
    return b.mesh;
}

#define FACET(normal, a, b, c)                                                                     \
    "facet normal " normal "\nouter loop\nvertex " a "\nvertex " b "\nvertex " c                   \
    "\nendloop\nendfacet\n"

static void stl_text(void **state)
{
    (void)state;
    struct error err;
    struct mesh m = tetrahedron(), none = {0};
    m.triangle_count = 3;
    assert_true(write_stl(written_path, &m, &err));
    expect("solid hcsg\n" FACET("0 0 -1", "0 0 0", "0 1e-07 0", "2.5 0 0")
               FACET("0 -1 0", "0 0 0", "2.5 0 0", "0 0 12345678")
                   FACET("-1 0 0", "0 0 0", "0 0 12345678", "0 1e-07 0") "endsolid hcsg\n");
    assert_true(write_stl(written_path, &none, &err));
    expect("solid hcsg\nendsolid hcsg\n");
    mesh_free(&m);
}

static void off_text(void **state)
{
    (void)state;
    struct error err;
    struct mesh m = tetrahedron(), none = {0};
    assert_true(write_off(written_path, &m, &err));
    expect("OFF\n4 4 0\n0 0 0\n2.5 0 0\n0 1e-07 0\n0 0 12345678\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
           "3 1 2 3\n");
    assert_true(write_off(written_path, &none, &err));
    expect("OFF\n0 0 0\n");
    mesh_free(&m);
}

#define LINE(x1, y1, x2, y2) "0\nLINE\n8\n0\n10\n" #x1 "\n20\n" #y1 "\n11\n" #x2 "\n21\n" #y2 "\n"

static void dxf_text(void **state)
{
    (void)state;
    static const struct vec2 points[] = {{0, 0}, {1e5, -0.5}, {0.1, 3},
                                         {1, 1}, {1, 2},      {2, 1.3333333333333333}};
    struct error err;
    struct outline o = {0}, none = {0};
    for (uint32_t i = 0; i < array_count(points); i++) {
        outline_add(&o, points[i]);
        if (i % 3 == 2)
            outline_close(&o);
    }
    assert_true(write_dxf(written_path, &o, &err));
    expect("0\nSECTION\n2\nENTITIES\n" LINE(0, 0, 100000, -0.5) LINE(100000, -0.5, 0.1, 3)
               LINE(0.1, 3, 0, 0) LINE(1, 1, 1, 2) LINE(1, 2, 2, 1.3333333333333333)
                   LINE(2, 1.3333333333333333, 1, 1) "0\nENDSEC\n0\nEOF\n");
    assert_true(write_dxf(written_path, &none, &err));
    expect("0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n");
    outline_free(&o);
}

// What is read back is the same to the last bit.
static void no_digit_is_lost(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    mesh_add_vertex(&b, (struct vec3){1.0 / 3, -2e-300, 0x1.fffffffffffffp-1});
    mesh_add_vertex(&b, (struct vec3){1e150 / 7, 5e-324, 0.1});
    mesh_add_vertex(&b, (struct vec3){acos(-1), -1e22, 123456789012345680.0});
    mesh_add_triangle(&b, 0, 1, 2, mesh_add_face(&b));
    struct error err;
    struct mesh back;
    assert_true(write_stl(written_path, &b.mesh, &err));
    size_t size;
    char *data = written(&size);
    assert_true(read_stl("a", data, size, &back, &err));
    assert_int_equal(back.vertex_count, 3);
    assert_memory_equal(back.vertices, b.mesh.vertices, 3 * sizeof *back.vertices);
    free(data);
    mesh_free(&back);
    mesh_free(&b.mesh);
}

static void no_folder_no_file(void **state)
{
    (void)state;
    char away[sizeof written_path + 8];
    struct error err = {""};
    struct mesh none = {0};
    struct outline flat = {0};
    snprintf(away, sizeof away, "%s/b", written_path);
    assert_false(write_stl(away, &none, &err));
    assert_memory_equal(err.text, away, strlen(away));
    assert_false(write_off(away, &none, &err));
    assert_false(write_dxf(away, &flat, &err));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stl_text),          cmocka_unit_test(off_text),
        cmocka_unit_test(dxf_text),          cmocka_unit_test(no_digit_is_lost),
        cmocka_unit_test(no_folder_no_file),
    };
    return cmocka_run_group_tests(tests, written_setup, written_teardown);
}
