// read_amf.c - AMF meshes, plain or zipped.
#include "io/read_amf.h"

#include "geom/mesh.h"
#include "io/package.h"
#include "io/xml.h"

#include <string.h>

enum {
    AMF = 1,
    OBJECT,
    MESH,
    VERTICES,
    VERTEX,
    COORDINATES,
    X,
    Y,
    Z,
    VOLUME,
    TRIANGLE,
    V1,
    V2,
    V3
};

static const struct xml_element elements[] = {
    {0, "amf", AMF},
    {AMF, "object", OBJECT},
    {OBJECT, "mesh", MESH},
    {MESH, "vertices", VERTICES},
    {VERTICES, "vertex", VERTEX},
    {VERTEX, "coordinates", COORDINATES},
    {COORDINATES, "x", X},
    {COORDINATES, "y", Y},
    {COORDINATES, "z", Z},
    {MESH, "volume", VOLUME},
    {VOLUME, "triangle", TRIANGLE},
    {TRIANGLE, "v1", V1},
    {TRIANGLE, "v2", V2},
    {TRIANGLE, "v3", V3},
};

struct reader {
    struct mesh_builder mesh;
    uint32_t first; // vertex of the object at hand
    double at[3];
    uint32_t corners[3];
    int given; // bits of the coordinates or corners that were there
};

static bool on_open(void *user, struct xml *x, int id, const char **attributes)
{
    (void)x, (void)attributes;
    struct reader *r = user;
    if (id == OBJECT)
        r->first = r->mesh.mesh.vertex_count;
    if (id == VERTEX || id == TRIANGLE)
        r->given = 0;
    return true;
}

static bool on_close(void *user, struct xml *x, int id, const char *text)
{
    struct reader *r = user;
    if (id >= X && id <= Z) {
        r->given |= 1 << (id - X);
        if (!xml_number(x, text, &r->at[id - X])) {
            xml_error(x, "expected a finite number as coordinate");
            return false;
        }
    } else if (id >= V1 && id <= V3) {
        r->given |= 1 << (id - V1);
        if (!xml_count(text, &r->corners[id - V1]) ||
            r->corners[id - V1] >= r->mesh.mesh.vertex_count - r->first) {
            xml_error(x, "expected the number of a vertex as corner of a triangle");
            return false;
        }
    } else if ((id == VERTEX || id == TRIANGLE) && r->given != 7) {
        xml_error(x, id == VERTEX ? "a vertex without all three coordinates"
                                  : "a triangle without all three corners");
        return false;
    } else if (id == VERTEX)
        mesh_add_vertex(&r->mesh, (struct vec3){r->at[0], r->at[1], r->at[2]});
    else if (id == TRIANGLE)
        mesh_add_triangle(&r->mesh, r->first + r->corners[0], r->first + r->corners[1],
                          r->first + r->corners[2], mesh_add_face(&r->mesh));
    return true;
}

static bool take_part(void *user, const char *data, size_t size)
{
    return xml_push(user, data, size);
}

// The file in the archive that is named as the archive, or the only one.
static bool read_zipped(const char *path, const char *data, size_t size, struct xml *x,
                        struct error *err)
{
    struct package *p = package_open(path, data, size, err);
    if (!p)
        return false;
    const char *slash = strrchr(path, '/');
    int64_t file = package_find(p, slash ? slash + 1 : path);
    if (file == PACKAGE_NONE && package_count(p) == 1)
        file = 0;
    bool ok = file != PACKAGE_NONE && package_read(p, file, take_part, x, err);
    if (file == PACKAGE_NONE)
        error_set(err, "%s: several files are zipped here, none named as the whole", path);
    package_close(p);
    return ok;
}

bool read_amf(const char *path, const char *data, size_t size, struct mesh *out, struct error *err)
{
    static const struct xml_format format = {
        .elements = elements,
        .element_count = array_count(elements),
        .open = on_open,
        .close = on_close,
    };
    struct reader r = {0};
    struct xml *x = xml_new(path, &format, &r, err);
    bool ok = x &&
              (package_is_zip(data, size) ? read_zipped(path, data, size, x, err)
                                          : xml_push(x, data, size)) &&
              xml_finish(x);
    xml_delete(x);
    if (!ok) {
        mesh_free(&r.mesh.mesh);
        return false;
    }
    mesh_weld(&r.mesh.mesh);
    *out = r.mesh.mesh;
    return true;
}
