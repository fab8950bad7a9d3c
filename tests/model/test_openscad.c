// test_openscad.c - shapes have the vertices and the volume that OpenSCAD exports.
#include "unit.h"

#include "base/file.h"
#include "io/read_stl.h"

#include <stdio.h>
#include <unistd.h>

static char folder[] = "/tmp/hcsg_openscad_XXXXXX";

// All vertices of one mesh lie at vertices of the other.
static void assert_covers(const struct mesh *there, const struct vec3 *points, uint32_t count,
                          const char *text)
{
    for (uint32_t i = 0; i < count; i++) {
        double nearest = INFINITY;
        for (uint32_t v = 0; v < there->vertex_count; v++)
            nearest = fmin(nearest, vec3_length(vec3_sub(points[i], there->vertices[v])));
        double tolerance = 1e-5 * fmax(1, vec3_length(points[i]));
        if (!(nearest < tolerance))
            fail_msg("%s: no vertex at %g %g %g", text, points[i].x, points[i].y, points[i].z);
    }
}

static void export_stl(const char *text, struct mesh *out)
{
    char path[100], command[300];
    struct error err;
    char *data;
    size_t size;
    snprintf(path, sizeof path, "%s/shape.scad", folder);
    if (!file_write(path, text, strlen(text), &err))
        fail_msg("%s", err.text);
    snprintf(command, sizeof command, "openscad -o %s/shape.stl %s >%s/log 2>&1", folder, path,
             folder);
    if (system(command) != 0)
        fail_msg("%s: openscad failed", text);
    snprintf(path, sizeof path, "%s/shape.stl", folder);
    if (!file_read(path, 1 << 24, &data, &size, &err) || !read_stl(path, data, size, out, &err))
        fail_msg("%s", err.text);
    free(data);
}

static void compare(const char *text)
{
    struct mesh theirs;
    export_stl(text, &theirs);
    struct solid_store *store = solid_store_new();
    struct messages messages = {0};
    struct model m;
    model_of_text(&m, "shape.csg", text, store, &messages);
    assert_int_equal(m.bodies[0].leaf_count, 1);
    const struct leaf *l = &m.bodies[0].leaves[0];
    uint32_t count = l->solid->mesh.vertex_count;
    struct vec3 *points = mem_alloc(count * sizeof *points);
    struct mesh ours = l->solid->mesh;
    ours.vertices = points;
    for (uint32_t v = 0; v < count; v++)
        points[v] = affine_point(&l->to_world, l->solid->mesh.vertices[v]);
    assert_covers(&theirs, points, count, text);
    assert_covers(&ours, theirs.vertices, theirs.vertex_count, text);
    assert_int_equal(count, theirs.vertex_count);
    double volume = mesh_volume(&theirs);
    assert_true(fabs(volume - leaf_volume(l)) < 1e-4 * fabs(volume));
    free(points);
    mesh_free(&theirs);
    model_free(&m);
    solid_store_delete(store);
    messages_free(&messages);
}

static void shapes_agree(void **state)
{
    (void)state;
    compare("cube([1, 2, 3], center = true);");
    compare("sphere(7);");
    compare("sphere(2, $fn = 7);");
    compare("sphere(1, $fn = 4);");
    compare("cylinder(h = 2, r1 = 0, r2 = 2);");
    compare("cylinder(h = 3, r1 = 3, r2 = 2, center = true, $fn = 11);");
    compare("cylinder(h = 3, d = 5);");
    compare("mirror([0, 0, 1]) cylinder(h = 2, r1 = 3, r2 = 2);");
    compare("rotate([10, 20, 30]) translate([1, 2, 3]) cube([1, 2, 3]);");
    compare("rotate(50, [1, 2, 3]) scale([1, 2, 3]) sphere(1, $fn = 8);");
    compare("multmatrix([[1, 0.5, 0, 5], [0, 2, 0.3, 0], [0.1, 0, 1, 0]]) sphere(3);");
}

static void polyhedra_agree(void **state)
{
    (void)state;
    // A flat pentagon with a dent below, five triangles above.
    compare("polyhedron([[0, 0, 0], [4, 0, 0], [4, 4, 0], [2, 1, 0], [0, 4, 0], [2, 0.5, 3]], "
            "[[0, 1, 2, 3, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [4, 3, 5], [0, 4, 5]]);");
    // Bent sides: their diagonals decide the volume.
    compare("polyhedron([[0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0], [0.5, 0.3, 2], [3.5, 0, 2.5], "
            "[3, 3.2, 2.2], [0, 3, 3]], [[0, 1, 2, 3], [7, 6, 5, 4], [1, 0, 4, 5], [2, 1, 5, 6], "
            "[3, 2, 6, 7], [0, 3, 7, 4]]);");
}

int main(void)
{
    if (system("openscad --version >/dev/null 2>&1") != 0)
        return 77;
    if (!mkdtemp(folder))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_agree),
        cmocka_unit_test(polyhedra_agree),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    static const char *const names[] = {"shape.scad", "shape.stl", "log"};
    for (size_t i = 0; i < array_count(names); i++) {
        char path[100];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
    return failed;
}
