// test_obj.c - OBJ files: what is read, and hostile ones.
#include "io/read_obj.h"

#include "reading.h"

#define CUBE                                                                                       \
    "# a cube\nmtllib a.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"                         \
    "v 0 0 1 0.5 0.5 0.5\nv 1 0 1 # grey\r\nv 1 1 1 1\nv 0 1 1e0\nvt 0 0\nvn 0 0 1\ns off\n"

static void accept(const char *text, uint32_t vertices, uint32_t triangles, double volume)
{
    struct mesh m;
    struct error err;
    if (!read_mesh(read_obj, "file", text, strlen(text), &m, &err))
        fail_msg("%s", err.text);
    assert_mesh(&m, vertices, triangles, volume);
    mesh_free(&m);
}

static void refuse(const char *text, const char *message)
{
    struct mesh m = {.vertex_count = 77};
    struct error err;
    assert_false(read_mesh(read_obj, "file", text, strlen(text), &m, &err));
    assert_int_equal(m.vertex_count, 77);
    assert_string_equal(err.text, message);
}

static void faces_of_all_forms(void **state)
{
    (void)state;
    accept(CUBE "f 4 3 2 1\nf 5/1 6/1 7/1 8/1\nf 1//1 2//1 6//1 5//1\nf 2/1/1 3/1/1 7/1/1 6/1/1\n"
                "f 3 4 8 7\nf 4 1 5 8",
           8, 12, 1);
    accept(CUBE "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf 1 2 6 \\\n 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
           8, 12, 1);
    accept("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nf 1 2 3 4 5\n", 5, 3, 0); // concave
    accept("", 0, 0, 0);
    accept("v 1 2 3\nf 1\nf\nf 1 1 1\nf 1 1\n", 0, 0, 0);
}

// Crossings become vertices of the mesh, which numbers in the file do not count.
static void crossings_do_not_count(void **state)
{
    (void)state;
    accept("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf 5 6 7\n", 8,
           3, 1.5);
    accept("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf -1 -2 -3",
           8, 3, -1.5);
}

static void wrong_files(void **state)
{
    (void)state;
    const char *vertex = "file:2: expected three finite numbers after 'v'";
    refuse("v 0 0 0\nv 1 2\n", vertex);
    refuse("v 0 0 0\nv 1 2 x\n", vertex);
    refuse("v 0 0 0\nv 1 nan 2\n", vertex);
    refuse("v 0 0 0\nv 1e999 0 2\n", vertex);
    refuse("v 0 0 0\nv 0x1 0 2\n", vertex);
    const char *face = "file:3: expected the numbers of vertices after 'f'";
    refuse("v 0 0 0\n\nf 1 2 3\n", face);
    refuse("v 0 0 0\n\nf 0 1 1\n", face);
    refuse("v 0 0 0\n\nf -2 1 1\n", face);
    refuse("v 0 0 0\n\nf 1 1 18446744073709551617\n", face);
    refuse("v 0 0 0\n\nf 1 a 1\n", face);
    refuse("v 0 0 0\n\nf 1 - 1\n", face);
    refuse("v 0 0 0\n\nf 1 /1 1\n", face);
    refuse("v 0 0 0\n\nf 1 1.5 1\n", face);
}

static void noise_is_survived(void **state)
{
    (void)state;
    static const char good[] = CUBE "f 4 3 2 1\nf -4 -3/2 7/1 8/1/7\nf 1//1 2//1 6//1 5//1\n";
    uint64_t seed = 7;
    for (int round = 0; round < 4000; round++) {
        char data[sizeof good];
        struct mesh m = {0};
        struct error err;
        memcpy(data, good, sizeof good);
        read_mesh(read_obj, "file", data, spoil(&seed, data, sizeof good - 1), &m, &err);
        mesh_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_of_all_forms),
        cmocka_unit_test(crossings_do_not_count),
        cmocka_unit_test(wrong_files),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
