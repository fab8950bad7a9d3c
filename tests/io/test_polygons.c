// test_polygons.c - OFF and OBJ files: what is read, and hostile ones.
#include "io/read_obj.h"
#include "io/read_off.h"

#include "reading.h"

typedef bool reader(const char *path, const char *data, size_t size, struct mesh *out,
                    struct messages *messages, struct error *err);

static bool read_polygons(reader *read, const char *data, size_t size, struct mesh *out,
                          struct messages *messages, struct error *err)
{
    char *copy = exact_copy(data, size);
    err->text[0] = 0;
    bool ok = read("file", copy, size, out, messages, err);
    if (ok != (err->text[0] == 0) || strchr(err->text, '\n'))
        fail_msg("'%s' from a reader that returned %d", err->text, ok);
    free(copy);
    return ok;
}

static void accept(reader *read, const char *text, uint32_t vertices, uint32_t triangles,
                   double volume)
{
    struct mesh m;
    struct messages messages = {0};
    struct error err;
    if (!read_polygons(read, text, strlen(text), &m, &messages, &err))
        fail_msg("%s", err.text);
    assert_mesh(&m, vertices, triangles, volume);
    assert_int_equal(messages.count, 0);
    mesh_free(&m);
}

static void refuse(reader *read, const char *text, const char *message)
{
    struct mesh m = {.vertex_count = 77};
    struct messages messages = {0};
    struct error err;
    assert_false(read_polygons(read, text, strlen(text), &m, &messages, &err));
    assert_int_equal(m.vertex_count, 77);
    assert_string_equal(err.text, message);
}

#define CUBE                                                                                       \
    "# a cube\nmtllib a.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"                         \
    "v 0 0 1 0.5 0.5 0.5\nv 1 0 1 # grey\r\nv 1 1 1 1\nv 0 1 1e0\nvt 0 0\nvn 0 0 1\ns off\n"

static void obj_faces_of_all_forms(void **state)
{
    (void)state;
    accept(read_obj,
           CUBE "f 4 3 2 1\nf 5/1 6/1 7/1 8/1\nf 1//1 2//1 6//1 5//1\nf 2/1/1 3/1/1 7/1/1 6/1/1\n"
                "f 3 4 8 7\nf 4 1 5 8",
           8, 12, 1);
    accept(read_obj,
           CUBE "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf 1 2 6 \\\n 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
           8, 12, 1);
    accept(read_obj, "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nf 1 2 3 4 5\n", 5, 3,
           0); // concave
    accept(read_obj, "", 0, 0, 0);
    accept(read_obj, "v 1 2 3\nf 1\nf\nf 1 1 1\nf 1 1\n", 0, 0, 0);
}

// Crossings become vertices of the mesh, which numbers in the file do not count.
static void obj_crossings_do_not_count(void **state)
{
    (void)state;
    accept(read_obj,
           "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf 5 6 7\n", 8,
           3, 1.5);
    accept(read_obj,
           "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf -1 -2 -3",
           8, 3, -1.5);
}

static void wrong_obj_files(void **state)
{
    (void)state;
    const char *vertex = "file:2: expected three finite numbers after 'v'";
    refuse(read_obj, "v 0 0 0\nv 1 2\n", vertex);
    refuse(read_obj, "v 0 0 0\nv 1 2 x\n", vertex);
    refuse(read_obj, "v 0 0 0\nv 1 nan 2\n", vertex);
    refuse(read_obj, "v 0 0 0\nv 1e999 0 2\n", vertex);
    refuse(read_obj, "v 0 0 0\nv 0x1 0 2\n", vertex);
    const char *face = "file:3: expected the numbers of vertices after 'f'";
    refuse(read_obj, "v 0 0 0\n\nf 1 2 3\n", face);
    refuse(read_obj, "v 0 0 0\n\nf 0 1 1\n", face);
    refuse(read_obj, "v 0 0 0\n\nf -2 1 1\n", face);
    refuse(read_obj, "v 0 0 0\n\nf 1 1 18446744073709551617\n", face);
    refuse(read_obj, "v 0 0 0\n\nf 1 a 1\n", face);
    refuse(read_obj, "v 0 0 0\n\nf 1 - 1\n", face);
    refuse(read_obj, "v 0 0 0\n\nf 1 /1 1\n", face);
    refuse(read_obj, "v 0 0 0\n\nf 1 1.5 1\n", face);
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

// A star polygon of 2,001 corners: each side crosses most of the others.
static void faces_left_out_are_told(void **state)
{
    (void)state;
    enum { CORNERS = 2001 };
    for (int off = 0; off < 2; off++) {
        char *text = mem_alloc(CORNERS * 64), *at = text;
        at += sprintf(at, off ? "OFF %d 2 0\n" : "# %d\n", CORNERS);
        for (int i = 0; i < CORNERS; i++) {
            double angle = 2 * acos(-1) * 1000 * i / CORNERS;
            at += sprintf(at, "%s%.17g %.17g 0\n", off ? "" : "v ", cos(angle), sin(angle));
        }
        at += sprintf(at, off ? "3 0 1 2\n%d" : "f 1 2 3\nf", CORNERS);
        for (int i = 0; i < CORNERS; i++)
            at += sprintf(at, " %d", i + !off);
        struct mesh m;
        struct messages messages = {0};
        struct error err;
        assert_true(read_polygons(off ? read_off : read_obj, text, (size_t)(at - text), &m,
                                  &messages, &err));
        assert_int_equal(m.triangle_count, 1);
        assert_int_equal(messages.warnings, 1);
        assert_string_equal(messages.items[0].text,
                            "file: faces that cross themselves too often: 1 left out");
        messages_free(&messages);
        mesh_free(&m);
        free(text);
    }
}

// Any bytes give an answer. Cheap insurance; real fuzzing is elsewhere.
static void noise_is_survived(void **state)
{
    (void)state;
    static const char obj[] = CUBE "f 4 3 2 1\nf -4 -3/2 7/1 8/1/7\nf 1//1 2//1 6//1 5//1\n";
    static const char off[] = "OFF 4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4 0 2 1 3\n3 0 1 3\n";
    uint64_t seed = 7;
    for (int round = 0; round < 4000; round++) {
        char data[sizeof obj > sizeof off ? sizeof obj : sizeof off];
        size_t size = (round & 1 ? sizeof off : sizeof obj) - 1;
        struct mesh m = {0};
        struct messages messages = {0};
        struct error err;
        memcpy(data, round & 1 ? off : obj, size);
        read_polygons(round & 1 ? read_off : read_obj, data, spoil(&seed, data, size), &m,
                      &messages, &err);
        messages_free(&messages);
        mesh_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_faces_of_all_forms),  cmocka_unit_test(obj_crossings_do_not_count),
        cmocka_unit_test(wrong_obj_files),         cmocka_unit_test(off_files),
        cmocka_unit_test(faces_left_out_are_told), cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
