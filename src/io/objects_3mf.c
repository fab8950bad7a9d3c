// objects_3mf.c - the objects in a model file of a 3MF package.
#include "io/objects_3mf.h"

#include "io/xml.h"

#include <stdlib.h>

#define CORE       "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
#define PRODUCTION "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"

enum {
    MODEL = 1,
    RESOURCES,
    OBJECT,
    MESH,
    VERTICES,
    VERTEX,
    TRIANGLES,
    TRIANGLE,
    COMPONENTS,
    COMPONENT,
    BUILD,
    ITEM
};

static const struct xml_element elements[] = {
    {0, "model", MODEL},
    {MODEL, "resources", RESOURCES},
    {RESOURCES, "object", OBJECT},
    {OBJECT, "mesh", MESH},
    {MESH, "vertices", VERTICES},
    {VERTICES, "vertex", VERTEX},
    {MESH, "triangles", TRIANGLES},
    {TRIANGLES, "triangle", TRIANGLE},
    {OBJECT, "components", COMPONENTS},
    {COMPONENTS, "component", COMPONENT},
    {MODEL, "build", BUILD},
    {BUILD, "item", ITEM},
};

struct reader {
    struct objects_3mf *objects;
    struct package *package;
    uint64_t file;
    bool build;
    struct mesh_builder mesh; // of the object at hand
};

static uint64_t key_of(uint64_t file, uint32_t id)
{
    return file << 32 | id;
}

// Coordinates have single precision: what lib3mf keeps, and what decides which points are one.
static bool read_vertex(struct reader *r, struct xml *x, const char **attributes)
{
    static const char *const names[] = {"x", "y", "z"};
    float v[3]; // not a cast where they are used: gcc 12 drops two of three
    for (int i = 0; i < 3; i++) {
        const char *text = xml_attribute(attributes, names[i]);
        double number;
        bool read = text && xml_number(x, text, &number);
        v[i] = read ? (float)number : INFINITY;
        if (!isfinite(v[i])) {
            xml_error(x, "expected finite numbers as coordinates of a vertex");
            return false;
        }
    }
    mesh_add_vertex(&r->mesh, (struct vec3){v[0], v[1], v[2]});
    return true;
}

static bool read_triangle(struct reader *r, struct xml *x, const char **attributes)
{
    static const char *const names[] = {"v1", "v2", "v3"};
    uint32_t v[3];
    for (int i = 0; i < 3; i++) {
        const char *text = xml_attribute(attributes, names[i]);
        if (!text || !xml_count(text, &v[i]) || v[i] >= r->mesh.mesh.vertex_count) {
            xml_error(x, "expected the numbers of vertices as corners of a triangle");
            return false;
        }
    }
    mesh_add_triangle(&r->mesh, v[0], v[1], v[2], mesh_add_face(&r->mesh));
    return true;
}

// Twelve numbers: where the axes and then the origin go.
static bool read_place(const struct xml *x, const char *text, struct affine *out)
{
    *out = AFFINE_IDENTITY;
    for (int i = 0; text && i < 12; i++) {
        double value;
        if (!xml_next_number(x, &text, &value) || !isfinite((float)value))
            return false;
        out->m[i % 3][i / 3] = (float)value;
    }
    return !text || xml_is_blank(text);
}

// What is in another file of the package says so with a path from its root.
static bool read_part(struct reader *r, struct xml *x, const char **attributes,
                      struct part_3mf *out)
{
    const char *text = xml_attribute(attributes, "objectid");
    const char *path = xml_attribute(attributes, PRODUCTION XML_SEPARATOR "path");
    uint32_t id;
    if (!text || !xml_count(text, &id)) {
        xml_error(x, "expected the number of an object");
        return false;
    }
    int64_t file = (int64_t)r->file;
    if (path)
        file = package_find(r->package, path + (*path == '/'));
    if (file == PACKAGE_NONE) {
        xml_error(x, "no '%.200s' in the package", path);
        return false;
    }
    out->key = key_of((uint64_t)file, id);
    if (!read_place(x, xml_attribute(attributes, "transform"), &out->place)) {
        xml_error(x, "expected twelve finite numbers as 'transform'");
        return false;
    }
    return true;
}

static bool begin_object(struct reader *r, struct xml *x, const char **attributes)
{
    struct objects_3mf *o = r->objects;
    const char *text = xml_attribute(attributes, "id");
    uint32_t id;
    if (!text || !xml_count(text, &id)) {
        xml_error(x, "an object without a number");
        return false;
    }
    array_reserve(&o->items, &o->room, (size_t)o->count + 1);
    o->items[o->count++] =
        (struct object_3mf){.key = key_of(r->file, id), .first_part = o->part_count};
    return true;
}

static bool on_open(void *user, struct xml *x, int id, const char **attributes)
{
    struct reader *r = user;
    struct objects_3mf *o = r->objects;
    struct part_3mf part;
    switch (id) {
    case OBJECT:
        return begin_object(r, x, attributes);
    case VERTEX:
        return read_vertex(r, x, attributes);
    case TRIANGLE:
        return read_triangle(r, x, attributes);
    case COMPONENT:
        if (!read_part(r, x, attributes, &part))
            return false;
        array_reserve(&o->parts, &o->part_room, (size_t)o->part_count + 1);
        o->parts[o->part_count++] = part;
        o->items[o->count - 1].part_count++;
        return true;
    case ITEM:
        if (!r->build)
            return true;
        if (!read_part(r, x, attributes, &part))
            return false;
        array_reserve(&o->built, &o->built_room, (size_t)o->built_count + 1);
        o->built[o->built_count++] = part;
        return true;
    default:
        return true;
    }
}

static bool on_close(void *user, struct xml *x, int id, const char *text)
{
    (void)x, (void)text;
    struct reader *r = user;
    if (id == OBJECT) {
        mesh_weld(&r->mesh.mesh);
        r->objects->items[r->objects->count - 1].mesh = r->mesh.mesh;
        r->mesh = (struct mesh_builder){0};
    }
    return true;
}

static bool take_part(void *user, const char *data, size_t size)
{
    return xml_push(user, data, size);
}

bool objects_3mf_read(struct objects_3mf *o, struct package *p, int64_t file, const char *path,
                      bool build, struct error *err)
{
    static const struct xml_format format = {
        .xmlns = CORE,
        .elements = elements,
        .element_count = array_count(elements),
        .open = on_open,
        .close = on_close,
    };
    struct reader r = {.objects = o, .package = p, .file = (uint64_t)file, .build = build};
    struct xml *x = xml_new(path, &format, &r, err);
    bool ok = x && package_read(p, file, take_part, x, err) && xml_finish(x);
    xml_delete(x);
    mesh_free(&r.mesh.mesh);
    return ok;
}

void objects_3mf_free(struct objects_3mf *o)
{
    for (uint32_t i = 0; i < o->count; i++)
        mesh_free(&o->items[i].mesh);
    free(o->items);
    free(o->parts);
    free(o->built);
    *o = (struct objects_3mf){0};
}
