// test_packages.c - AMF and 3MF: what is read, zipped files, and hostile ones.
#include "io/read_3mf.h"
#include "io/read_amf.h"

#include "reading.h"

#include <zip.h>

struct entry {
    const char *name, *text;
    size_t size; // 0: up to the zero byte
};

struct archive {
    char *data;
    size_t size;
};

static struct archive pack(const struct entry *entries, size_t count)
{
    zip_source_t *whole = zip_source_buffer_create(NULL, 0, 0, NULL);
    zip_source_keep(whole);
    zip_t *zip = zip_open_from_source(whole, ZIP_TRUNCATE, NULL);
    assert_non_null(zip);
    for (size_t i = 0; i < count; i++) {
        size_t size = entries[i].size ? entries[i].size : strlen(entries[i].text);
        zip_source_t *source = zip_source_buffer(zip, entries[i].text, size, 0);
        assert_true(zip_file_add(zip, entries[i].name, source, 0) >= 0);
    }
    assert_int_equal(zip_close(zip), 0);
    struct archive a = {mem_alloc(1 << 20), 0};
    assert_int_equal(zip_source_open(whole), 0);
    a.size = (size_t)zip_source_read(whole, a.data, 1 << 20);
    zip_source_close(whole);
    zip_source_free(whole);
    return a;
}

#define XML "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"

// A tetrahedron of volume 1/6, in both formats.
#define AMF_VERTEX(x, y, z)                                                                        \
    "<vertex><coordinates><x>" #x "</x><y>" #y "</y><z>" #z "</z></coordinates></vertex>"
#define AMF_TRIANGLE(a, b, c) "<triangle><v1>" #a "</v1><v2>" #b "</v2><v3>" #c "</v3></triangle>"
#define AMF_OBJECT(x, last)                                                                        \
    "<object id=\"1\"><metadata type=\"x\">7</metadata><mesh><vertices>" AMF_VERTEX(x, 0, 0)       \
        AMF_VERTEX(1, 0, 0) AMF_VERTEX(0, 1, 0)                                                    \
            AMF_VERTEX(0, 0, 1) "</vertices><volume>" AMF_TRIANGLE(0, 2, 1) AMF_TRIANGLE(0, 1, 3)  \
                AMF_TRIANGLE(1, 2, 3) last "</volume></mesh></object>"
#define AMF(inside)     XML "<amf unit=\"inch\">" inside "</amf>\n"
#define AMF_LAST        AMF_TRIANGLE(0, 3, 2)
#define AMF_TETRAHEDRON AMF(AMF_OBJECT(0, AMF_LAST))

static void accept_amf(const char *path, const char *data, size_t size, uint32_t vertices,
                       uint32_t triangles, double volume)
{
    struct mesh m;
    struct error err;
    if (!read_mesh(read_amf, path, data, size, &m, &err))
        fail_msg("%s", err.text);
    assert_mesh(&m, vertices, triangles, volume);
    mesh_free(&m);
}

static void refuse_amf(const char *data, size_t size, const char *message)
{
    struct mesh m = {.vertex_count = 77};
    struct error err;
    assert_false(read_mesh(read_amf, "file", data, size, &m, &err));
    assert_int_equal(m.vertex_count, 77);
    assert_string_equal(err.text, message);
}

static void refuse_amf_text(const char *text, const char *message)
{
    refuse_amf(text, strlen(text), message);
}

static void plain_amf(void **state)
{
    (void)state;
    const char *text = AMF_TETRAHEDRON;
    accept_amf("file", text, strlen(text), 4, 4, 1.0 / 6);
    text = AMF(AMF_OBJECT(0, AMF_LAST) AMF_OBJECT(-3, AMF_LAST)); // numbers begin anew
    accept_amf("file", text, strlen(text), 5, 8, 1.0 / 6 + 4.0 / 6);
    text = AMF("<constellation/><object/><x><object><mesh>2</mesh></object></x>");
    accept_amf("file", text, strlen(text), 0, 0, 0);
    text = "<amf xmlns=\"http://a.b/c\">" AMF_OBJECT(\n 0.0e1\t, AMF_LAST) "</amf>";
    accept_amf("file", text, strlen(text), 4, 4, 1.0 / 6);
}

static void wrong_amf(void **state)
{
    (void)state;
    const char *number = "file:2: expected a finite number as coordinate";
    refuse_amf_text(AMF(AMF_OBJECT(a, "")), number);
    refuse_amf_text(AMF(AMF_OBJECT(1 2, "")), number);
    refuse_amf_text(AMF(AMF_OBJECT(inf, "")), number);
    refuse_amf_text(AMF(AMF_OBJECT(1e999, "")), number);
    refuse_amf_text(AMF(AMF_OBJECT(, "")), number);
    const char *corner = "file:2: expected the number of a vertex as corner of a triangle";
    refuse_amf_text(AMF(AMF_OBJECT(0, AMF_TRIANGLE(0, 1, 4))), corner);
    refuse_amf_text(AMF(AMF_OBJECT(0, AMF_TRIANGLE(0, 1, -1))), corner);
    refuse_amf_text(AMF(AMF_OBJECT(0, AMF_TRIANGLE(0, 1, 4294967297))), corner);
    refuse_amf_text(AMF(AMF_OBJECT(0, "<triangle><v1>0</v1><v3>0</v3></triangle>")),
                    "file:2: a triangle without all three corners");
    refuse_amf_text(AMF("<object><mesh><vertices><vertex>"
                        "<coordinates><x>0</x></coordinates></vertex></vertices></mesh></object>"),
                    "file:2: a vertex without all three coordinates");
    refuse_amf_text("<amf>\n\n</amg>", "file:3: XML: mismatched tag");
    refuse_amf_text("<amf>\n<object>\n", "file:3: XML: no element found");
    refuse_amf_text("", "file:1: XML: no element found");
    refuse_amf_text("solid", "file:1: XML: syntax error");
}

// Each entity is ten of the one before; and nothing may be fetched from elsewhere.
static void entities_are_refused(void **state)
{
    (void)state;
    refuse_amf_text("<!DOCTYPE amf [\n<!ENTITY a \"0000000000\">\n"
                    "<!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n<amf>&b;</amf>",
                    "file:2: the file declares entities");
    refuse_amf_text("<!DOCTYPE amf [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><amf>&a;</amf>",
                    "file:1: the file declares entities");
}

static void deep_nesting_is_passed_over(void **state)
{
    (void)state;
    enum { DEPTH = 100000 };
    char *text = mem_alloc(16 + 7 * DEPTH);
    char *p = text + sprintf(text, "<amf>");
    for (int i = 0; i < DEPTH; i++, p += 3)
        memcpy(p, "<a>", 3);
    for (int i = 0; i < DEPTH; i++, p += 4)
        memcpy(p, "</a>", 4);
    p += sprintf(p, "</amf>");
    accept_amf("file", text, (size_t)(p - text), 0, 0, 0);
    free(text);
}

static void zipped_amf(void **state)
{
    (void)state;
    struct archive a = pack((struct entry[]){{"other.amf", AMF_TETRAHEDRON, 0}}, 1);
    accept_amf("/a/part.amf", a.data, a.size, 4, 4, 1.0 / 6);
    for (size_t size = 4; size < a.size; size++) {
        struct mesh m;
        struct error err;
        assert_false(read_mesh(read_amf, "file", a.data, size, &m, &err));
    }
    free(a.data);

    const struct entry two[] = {{"other.amf", "<amf/>", 0}, {"part.amf", AMF_TETRAHEDRON, 0}};
    a = pack(two, 2);
    accept_amf("/a/part.amf", a.data, a.size, 4, 4, 1.0 / 6);
    accept_amf("part.amf", a.data, a.size, 4, 4, 1.0 / 6);
    refuse_amf(a.data, a.size, "file: several files are zipped here, none named as the whole");
    free(a.data);
}

static void zip_bombs_are_refused(void **state)
{
    (void)state;
    enum { SIZE = 1 << 26 };
    char *blanks = mem_alloc(SIZE);
    memset(blanks, ' ', SIZE);
    struct archive a = pack((struct entry[]){{"a.amf", blanks, SIZE}}, 1);
    free(blanks);
    assert_in_range(a.size, SIZE / 1100, SIZE / 900);
    char message[80];
    snprintf(message, sizeof message, "file: zip: unpacks to more than %zu bytes",
             256 * a.size + (1 << 20));
    refuse_amf(a.data, a.size, message);
    free(a.data);
}

#define RELATION(target)                                                                           \
    "<Relationship Id=\"r\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"" \
    " Target=\"" target "\"/>"
#define RELATIONS(inside)                                                                          \
    XML "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"   \
        "<Relationship Id=\"t\" Type=\"thumbnail\" Target=\"/x.png\"/>" inside "</Relationships>"
#define MODEL(resources, build)                                                                    \
    XML "<model unit=\"inch\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"" \
        " xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\""             \
        " xmlns:x=\"http://a.b/c\"><resources><x:object id=\"1\"/>" resources                      \
        "</resources><build>" build "</build></model>"
#define VERTEX(x, y, z)   "<vertex x=\"" #x "\" y=\"" #y "\" z=\"" #z "\"/>"
#define TRIANGLE(a, b, c) "<triangle v1=\"" #a "\" v2=\"" #b "\" v3=\"" #c "\" pid=\"9\"/>"
#define OBJECT(id, x, last)                                                                        \
    "<object id=\"" #id "\" type=\"model\"><mesh><vertices>" VERTEX(x, 0, 0) VERTEX(1, 0, 0)       \
        VERTEX(0, 1, 0) VERTEX(0, 0, 1) "</vertices><triangles>" TRIANGLE(0, 2, 1)                 \
            TRIANGLE(0, 1, 3) TRIANGLE(1, 2, 3) last "</triangles></mesh></object>"
#define LAST            TRIANGLE(0, 3, 2)
#define PARTS(id, list) "<object id=\"" #id "\"><components>" list "</components></object>"
#define PART(id, rest)  "<component objectid=\"" #id "\" " rest "/>"
#define ITEM(id, rest)  "<item objectid=\"" #id "\" " rest "/>"

static bool read_package(const struct entry *entries, size_t count, bool placed,
                         struct mesh_set *out, struct error *err)
{
    struct archive a = pack(entries, count);
    char *copy = exact_copy(a.data, a.size);
    err->text[0] = 0;
    bool ok = read_3mf("file", copy, a.size, placed, out, err);
    assert_true(ok == (err->text[0] == 0) && !strchr(err->text, '\n'));
    free(copy);
    free(a.data);
    return ok;
}

static struct mesh_set accept_model(const char *model, bool placed)
{
    const struct entry entries[] = {{"_rels/.rels", RELATIONS(RELATION("/3D/a.model")), 0},
                                    {"3D/a.model", model, 0}};
    struct mesh_set set;
    struct error err;
    if (!read_package(entries, 2, placed, &set, &err))
        fail_msg("%s", err.text);
    return set;
}

static void refuse_model(const char *model, const char *message)
{
    const struct entry entries[] = {{"_rels/.rels", RELATIONS(RELATION("3D/a.model")), 0},
                                    {"3D/a.model", model, 0}};
    struct mesh_set set = {.count = 77};
    struct error err;
    assert_false(read_package(entries, 2, true, &set, &err));
    assert_int_equal(set.count, 77);
    assert_string_equal(err.text, message);
}

static void meshes_as_they_are(void **state)
{
    (void)state;
    const char *model = MODEL(OBJECT(1, 0, LAST) PARTS(2, PART(1, "")) OBJECT(5, -3, LAST),
                              ITEM(1, "transform=\"1 0 0 0 1 0 0 0 1 5 6 7\""));
    struct mesh_set set = accept_model(model, false);
    assert_int_equal(set.count, 2);
    assert_mesh(&set.items[0], 4, 4, 1.0 / 6);
    assert_mesh(&set.items[1], 4, 4, 4.0 / 6);
    mesh_set_free(&set);
    mesh_set_free(&set);

    // Single precision: 2^24 + 1 becomes 2^24.
    set = accept_model(MODEL(OBJECT(1, 16777217, ""), ""), false);
    assert_true(mesh_has_vertex(&set.items[0], 16777216, 0, 0));
    mesh_set_free(&set);
    set = accept_model(MODEL("", ""), false);
    assert_int_equal(set.count, 0);
}

static void meshes_as_built(void **state)
{
    (void)state;
    // Doubled and moved; mirrored, which turns the triangles round; object 5 is not built.
    const char *model =
        MODEL(OBJECT(1, 0, LAST) OBJECT(5, 0, LAST)
                  PARTS(2, PART(1, "transform=\"2 0 0 0 2 0 0 0 2 5 6 7\"") PART(1, "")),
              ITEM(2, "transform=\"0 1 0 1 0 0 0 0 1 10 20 30\"") ITEM(1, ""));
    struct mesh_set set = accept_model(model, true);
    assert_int_equal(set.count, 3);
    assert_mesh(&set.items[0], 4, 4, 8.0 / 6);
    assert_true(mesh_has_vertex(&set.items[0], 16, 25, 37)); // from 0 0 0 by 5 6 7
    assert_true(mesh_has_vertex(&set.items[0], 16, 27, 37)); // from 1 0 0 by 7 6 7
    assert_mesh(&set.items[1], 4, 4, 1.0 / 6);
    assert_true(mesh_has_vertex(&set.items[1], 11, 20, 30)); // from 0 1 0
    assert_mesh(&set.items[2], 4, 4, 1.0 / 6);
    assert_true(mesh_has_vertex(&set.items[2], 0, 0, 0));
    mesh_set_free(&set);
}

// Newer programs keep each object in a model file of its own.
static void objects_in_other_files(void **state)
{
    (void)state;
    const struct entry entries[] = {
        {"3D/a.model",
         MODEL(OBJECT(1, -3, LAST) PARTS(8, PART(1, "p:path=\"/3D/Objects/b.model\"")),
               ITEM(8, "") ITEM(1, "p:path=\"/3D/Objects/b.model\"")),
         0},
        {"3D/Objects/b.model", MODEL(OBJECT(1, 0, LAST), ITEM(1, "")), 0},
        {"_rels/.rels", RELATIONS(RELATION("/3D/a.model")), 0},
        {"3D/_rels/a.model.rels",
         RELATIONS(RELATION("/3D/Objects/b.model") RELATION("/3D/Objects/b.model")), 0},
    };
    struct mesh_set set;
    struct error err;
    assert_true(read_package(entries, 4, false, &set, &err));
    assert_int_equal(set.count, 2);
    mesh_set_free(&set);
    assert_true(read_package(entries, 4, true, &set, &err));
    assert_int_equal(set.count, 2);
    assert_mesh(&set.items[0], 4, 4, 1.0 / 6);
    assert_mesh(&set.items[1], 4, 4, 1.0 / 6);
    mesh_set_free(&set);
    assert_false(read_package(entries, 3, true, &set, &err));
    assert_string_equal(err.text, "file: object 1 is used but not there before");
}

static void wrong_models(void **state)
{
    (void)state;
    const char *vertex = "file:2: expected finite numbers as coordinates of a vertex";
    refuse_model(MODEL(OBJECT(1, a, LAST), ""), vertex);
    refuse_model(MODEL(OBJECT(1, nan, LAST), ""), vertex);
    refuse_model(MODEL(OBJECT(1, 1e39, LAST), ""), vertex);
    const char *triangle = "file:2: expected the numbers of vertices as corners of a triangle";
    refuse_model(MODEL(OBJECT(1, 0, TRIANGLE(0, 1, 4)), ""), triangle);
    refuse_model(MODEL(OBJECT(1, 0, "<triangle v1=\"0\" v2=\"1\"/>"), ""), triangle);
    refuse_model(MODEL(OBJECT(x, 0, LAST), ""), "file:2: an object without a number");
    refuse_model(MODEL("", ITEM(x, "")), "file:2: expected the number of an object");
    refuse_model(MODEL("", ITEM(7, "")), "file: object 7 is used but not there before");
    refuse_model(MODEL(PARTS(1, PART(1, "")), ""), "file: object 1 is used but not there before");
    refuse_model(MODEL(PARTS(1, PART(2, "")) OBJECT(2, 0, LAST), ""),
                 "file: object 2 is used but not there before");
    refuse_model(MODEL(OBJECT(1, 0, LAST), ITEM(1, "p:path=\"/x\"")),
                 "file:2: no '/x' in the package");
    const char *place = "file:2: expected twelve finite numbers as 'transform'";
    refuse_model(MODEL(OBJECT(1, 0, LAST), ITEM(1, "transform=\"1 0 0\"")), place);
    refuse_model(MODEL(OBJECT(1, 0, LAST), ITEM(1, "transform=\"1 0 0 0 1 0 0 0 1 0 0 0 0\"")),
                 place);
    refuse_model(MODEL(OBJECT(1, 0, LAST), ITEM(1, "transform=\"1 0 0 0 1 0 0 0 1 0 0 inf\"")),
                 place);
    refuse_model("<model/>x", "file:1: XML: junk after document element");
}

// Forty objects, each twice the one before.
static void doubling_is_refused(void **state)
{
    (void)state;
    char *model = mem_alloc(1 << 16), *p = model;
    p += sprintf(p, "%s",
                 "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">"
                 "<resources>" OBJECT(1, 0, LAST));
    for (int i = 2; i <= 40; i++)
        p += sprintf(p,
                     "<object id=\"%d\"><components><component objectid=\"%d\"/>"
                     "<component objectid=\"%d\"/></components></object>",
                     i, i - 1, i - 1);
    sprintf(p, "</resources><build><item objectid=\"40\"/></build></model>");
    refuse_model(model, "file: the build is more than 1048576 objects or 16777216 triangles");
    free(model);
}

static void wrong_packages(void **state)
{
    (void)state;
    struct mesh_set set;
    struct error err;
    const struct entry other[] = {{"3D/a.model", MODEL("", ""), 0}};
    assert_false(read_package(other, 1, false, &set, &err));
    assert_string_equal(err.text, "file: no 3D model in the package");
    const struct entry lost[] = {{"_rels/.rels", RELATIONS(RELATION("/3D/b.model")), 0}};
    assert_false(read_package(lost, 1, false, &set, &err));
    assert_string_equal(err.text, "file:2: no '/3D/b.model' in the package");
    assert_false(read_3mf("file", "nothing", 7, false, &set, &err));
    assert_string_equal(err.text, "file: zip: Not a zip archive");
    assert_false(read_3mf("file", "", 0, false, &set, &err));
}

static void noise_is_survived(void **state)
{
    (void)state;
    const struct entry entries[] = {
        {"_rels/.rels", RELATIONS(RELATION("/3D/a.model")), 0},
        {"3D/a.model", MODEL(OBJECT(1, 0, LAST) PARTS(2, PART(1, "")), ITEM(2, "")), 0}};
    struct archive a = pack(entries, 2);
    static const char amf[] = AMF_TETRAHEDRON;
    uint64_t seed = 9;
    for (int round = 0; round < 4000; round++) {
        size_t size = round & 1 ? a.size : sizeof amf - 1;
        char *data = exact_copy(round & 1 ? a.data : amf, size);
        size = spoil(&seed, data, size);
        data[size] = 0;
        struct mesh m = {0};
        struct mesh_set set = {0};
        struct error err;
        if (round & 1)
            read_3mf("file", data, size, round & 2, &set, &err);
        else
            read_amf("file", data, size, &m, &err);
        mesh_free(&m);
        mesh_set_free(&set);
        free(data);
    }
    free(a.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_amf),
        cmocka_unit_test(wrong_amf),
        cmocka_unit_test(entities_are_refused),
        cmocka_unit_test(deep_nesting_is_passed_over),
        cmocka_unit_test(zipped_amf),
        cmocka_unit_test(zip_bombs_are_refused),
        cmocka_unit_test(meshes_as_they_are),
        cmocka_unit_test(meshes_as_built),
        cmocka_unit_test(objects_in_other_files),
        cmocka_unit_test(wrong_models),
        cmocka_unit_test(doubling_is_refused),
        cmocka_unit_test(wrong_packages),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
