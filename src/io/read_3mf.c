// read_3mf.c - 3MF packages.
#include "io/read_3mf.h"

#include "io/objects_3mf.h"
#include "io/xml.h"

#include <stdlib.h>
#include <string.h>

#define MODEL_TYPE "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"

enum { RELATIONSHIPS = 1, RELATIONSHIP };
enum { MODELS_MOST = 4096 };

static const struct xml_element elements[] = {
    {0, "Relationships", RELATIONSHIPS},
    {RELATIONSHIPS, "Relationship", RELATIONSHIP},
};

// The model files that a file of relationships names.
struct relations {
    struct package *package;
    int64_t *files;
    uint32_t count, room;
};

static bool on_open(void *user, struct xml *x, int id, const char **attributes)
{
    struct relations *r = user;
    if (id != RELATIONSHIP)
        return true;
    const char *type = xml_attribute(attributes, "Type");
    const char *target = xml_attribute(attributes, "Target");
    if (!type || !target || strcmp(type, MODEL_TYPE) != 0)
        return true;
    int64_t file = package_find(r->package, target + (*target == '/'));
    if (file == PACKAGE_NONE) {
        xml_error(x, "no '%.200s' in the package", target);
        return false;
    }
    for (uint32_t i = 0; i < r->count; i++)
        if (r->files[i] == file)
            return true;
    if (r->count == MODELS_MOST) {
        xml_error(x, "more than %d model files in the package", MODELS_MOST);
        return false;
    }
    array_reserve(&r->files, &r->room, (size_t)r->count + 1);
    r->files[r->count++] = file;
    return true;
}

static bool take_part(void *user, const char *data, size_t size)
{
    return xml_push(user, data, size);
}

// A package without such a file has no such relations.
static bool read_relations(struct relations *r, const char *name, const char *path,
                           struct error *err)
{
    static const struct xml_format format = {
        .elements = elements,
        .element_count = array_count(elements),
        .open = on_open,
    };
    int64_t file = package_find(r->package, name);
    if (file == PACKAGE_NONE)
        return true;
    struct xml *x = xml_new(path, &format, r, err);
    bool ok = x && package_read(r->package, file, take_part, x, err) && xml_finish(x);
    xml_delete(x);
    return ok;
}

// The file of relationships of a file in the package: a/b.model has a/_rels/b.model.rels.
static char *relations_name(const char *target)
{
    const char *slash = strrchr(target, '/');
    size_t folder = slash ? (size_t)(slash + 1 - target) : 0;
    size_t size = strlen(target) + sizeof "_rels/.rels";
    char *name = mem_alloc(size);
    snprintf(name, size, "%.*s_rels/%s.rels", (int)folder, target, target + folder);
    return name;
}

// The root model's own relations name the files whose objects it uses.
static bool read_objects(struct package *p, const char *path, struct objects_3mf *o,
                         struct error *err)
{
    struct relations root = {.package = p}, others = {.package = p};
    bool ok = read_relations(&root, "_rels/.rels", path, err);
    if (ok && !root.count) {
        error_set(err, "%s: no 3D model in the package", path);
        ok = false;
    }
    if (ok) {
        char *name = relations_name(package_name(p, root.files[0]));
        ok = read_relations(&others, name, path, err);
        free(name);
    }
    for (uint32_t i = 0; i < others.count && ok; i++)
        if (others.files[i] != root.files[0])
            ok = objects_3mf_read(o, p, others.files[i], path, false, err);
    ok = ok && objects_3mf_read(o, p, root.files[0], path, true, err);
    free(root.files);
    free(others.files);
    return ok;
}

struct mesh *mesh_set_add(struct mesh_set *s)
{
    array_reserve(&s->items, &s->room, (size_t)s->count + 1);
    s->items[s->count] = (struct mesh){0};
    return &s->items[s->count++];
}

void mesh_set_free(struct mesh_set *s)
{
    for (uint32_t i = 0; i < s->count; i++)
        mesh_free(&s->items[i]);
    free(s->items);
    *s = (struct mesh_set){0};
}

// The meshes as they are, without what only joins others.
static void take_meshes(struct objects_3mf *o, struct mesh_set *out)
{
    for (uint32_t i = 0; i < o->count; i++)
        if (o->items[i].mesh.triangle_count) {
            *mesh_set_add(out) = o->items[i].mesh;
            o->items[i].mesh = (struct mesh){0};
        }
}

bool read_3mf(const char *path, const char *data, size_t size, bool placed, struct mesh_set *out,
              struct error *err)
{
    struct package *p = package_open(path, data, size, err);
    if (!p)
        return false;
    struct objects_3mf objects = {0};
    struct mesh_set meshes = {0};
    bool ok = read_objects(p, path, &objects, err);
    if (ok && placed)
        ok = objects_3mf_place(&objects, path, &meshes, err);
    else if (ok)
        take_meshes(&objects, &meshes);
    if (ok)
        *out = meshes;
    else
        mesh_set_free(&meshes);
    objects_3mf_free(&objects);
    package_close(p);
    return ok;
}
