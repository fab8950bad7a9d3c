// test_winding.c - meshes that are open, inside out or neither.
#include "geom/border.h"
#include "geom/winding.h"
#include "unit.h"

static void add_box(struct mesh_builder *b, struct vec3 low, struct vec3 high, bool inverted)
{
    static const uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    uint32_t first = b->mesh.vertex_count;
    for (uint32_t i = 0; i < 8; i++)
        mesh_add_vertex(b, (struct vec3){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                         i & 4 ? high.z : low.z});
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t corners[4];
        for (uint32_t k = 0; k < 4; k++)
            corners[k] = first + sides[i][inverted ? 3 - k : k];
        mesh_add_convex(b, corners, 4);
    }
}

static void each_edge_needs_two_sides(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    add_box(&b, (struct vec3){0, 0, 0}, (struct vec3){1, 1, 1}, false);
    assert_true(mesh_is_balanced(&b.mesh, false));
    b.mesh.triangle_count--;
    assert_false(mesh_is_balanced(&b.mesh, false));
    b.mesh.triangle_count++;
    uint32_t *t = b.mesh.triangles[0], swap = t[0];
    t[0] = t[1];
    t[1] = swap;
    assert_false(mesh_is_balanced(&b.mesh, false));
    mesh_free(&b.mesh);
}

static void boxes_side_by_side_are_never_inside_out(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    add_box(&b, (struct vec3){0, 0, 0}, (struct vec3){2, 1, 1}, false);
    assert_true(mesh_is_never_inside_out(&b.mesh));
    add_box(&b, (struct vec3){5, 0, 0}, (struct vec3){6, 1, 1}, false);
    assert_true(mesh_is_never_inside_out(&b.mesh));
    add_box(&b, (struct vec3){1, 0, 0}, (struct vec3){3, 2, 2}, false); // overlaps the first
    assert_true(mesh_is_never_inside_out(&b.mesh));
    add_box(&b, (struct vec3){8, 8, 8}, (struct vec3){9, 9, 9}, true);
    assert_false(mesh_is_never_inside_out(&b.mesh));
    mesh_free(&b.mesh);
}

static void what_is_inverted_is_in_doubt(void **state)
{
    (void)state;
    struct mesh_builder b = {0};
    add_box(&b, (struct vec3){0, 0, 0}, (struct vec3){1, 1, 1}, true);
    assert_true(mesh_is_balanced(&b.mesh, false));
    assert_false(mesh_is_never_inside_out(&b.mesh));
    mesh_free(&b.mesh);
    b = (struct mesh_builder){0};
    add_box(&b, (struct vec3){0, 0, 0}, (struct vec3){3, 3, 3}, false);
    add_box(&b, (struct vec3){1, 1, 1}, (struct vec3){2, 2, 2}, true);
    assert_true(mesh_is_balanced(&b.mesh, false));
    assert_false(mesh_is_never_inside_out(&b.mesh));
    mesh_free(&b.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_edge_needs_two_sides),
        cmocka_unit_test(boxes_side_by_side_are_never_inside_out),
        cmocka_unit_test(what_is_inverted_is_in_doubt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
