// import.c - objects read from files: import() and surface().
#include "base/file.h"
#include "base/hash.h"
#include "geom/mesh.h"
#include "io/read_3mf.h"
#include "io/read_amf.h"
#include "io/read_dxf.h"
#include "io/read_nef3.h"
#include "io/read_obj.h"
#include "io/read_off.h"
#include "io/read_stl.h"
#include "io/read_surface.h"
#include "io/read_svg.h"
#include "model/nodes.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

const struct parameters parameters_import = {{"file", "layer", "convexity", "origin", "scale",
                                              "width", "height", "filename", "layername", "center",
                                              "dpi", "id", "timestamp"},
                                             5};
const struct parameters parameters_surface = {
    {"file", "center", "convexity", "invert", "timestamp"}, 3};

enum { KEY_IMPORT = 0x696d706f };
#define IMPORT_LIMIT ((size_t)1 << 31)

// ---------------------------------------------------------------- which file

// A file that the model was to be made from. Meshes are read once for all nodes that name them.
struct import {
    char *path;
    const struct solid *solid; // NULL: not read, or not to be read
};

static struct import *find_import(struct builder *b, const char *path)
{
    for (uint32_t i = 0; i < b->import_count; i++)
        if (strcmp(b->imports[i].path, path) == 0)
            return &b->imports[i];
    array_reserve(&b->imports, &b->import_room, (size_t)b->import_count + 1);
    b->imports[b->import_count] = (struct import){.path = mem_strdup(path)};
    return &b->imports[b->import_count++];
}

void builder_note_import(struct builder *b, const char *path)
{
    find_import(b, path);
}

char **builder_take_imports(struct builder *b, uint32_t *count)
{
    char **paths = mem_alloc(b->import_count * sizeof *paths);
    for (uint32_t i = 0; i < b->import_count; i++)
        paths[i] = b->imports[i].path;
    *count = b->import_count;
    free(b->imports);
    b->imports = NULL;
    b->import_count = b->import_room = 0;
    return paths;
}

// The path of the file that a node names: beside the .csg, else in the first of the import folders
// that has it, else beside the .csg where it may come to be. NULL without a name.
static char *path_of(struct builder *b, const struct args *args, const struct csg_value *file)
{
    if (!file || file->kind != CSG_STRING || !file->count) {
        builder_warn(b, args->node, "%s() names no file; left out", args->node->name);
        return NULL;
    }
    char *path = file_join(b->folder, file->string);
    for (uint32_t i = 0; i < b->options->import_folder_count && access(path, R_OK) != 0; i++) {
        char *other = file_join(b->options->import_folders[i], file->string);
        if (access(other, R_OK) == 0) {
            free(path);
            return other;
        }
        free(other);
    }
    return path;
}

static bool read_file(struct builder *b, const struct args *args, const char *path, char **data,
                      size_t *size)
{
    struct error err;
    if (file_read(path, IMPORT_LIMIT, data, size, &err))
        return true;
    if (b->options->import_folder_count)
        builder_warn(b, args->node, "%s, nor in the import folders; left out", err.text);
    else
        builder_warn(b, args->node, "%s; left out", err.text);
    return false;
}

static void complain(struct builder *b, const struct args *args, const struct error *err)
{
    messages_add(b->messages, MESSAGE_ERROR, builder_place(b, args->node), "%s", err->text);
}

// ---------------------------------------------------------------- meshes

// One mesh of several: they are in union anyway where they do not overlap, and where they do a
// point inside of two is inside.
static void join(struct mesh_set *set, struct mesh *out)
{
    struct mesh_builder all = {0};
    for (uint32_t i = 0; i < set->count; i++) {
        const struct mesh *m = &set->items[i];
        uint32_t vertex = all.mesh.vertex_count, face = all.mesh.face_count;
        for (uint32_t k = 0; k < m->vertex_count; k++)
            mesh_add_vertex(&all, m->vertices[k]);
        for (uint32_t k = 0; k < m->triangle_count; k++)
            mesh_add_triangle(&all, m->triangles[k][0] + vertex, m->triangles[k][1] + vertex,
                              m->triangles[k][2] + vertex, m->faces[k] + face);
        all.mesh.face_count = face + m->face_count;
    }
    *out = all.mesh;
}

static bool load_3mf(const char *path, const char *data, size_t size, struct mesh *out,
                     struct messages *messages, struct error *err)
{
    struct mesh_set set = {0};
    (void)messages;
    bool done = read_3mf(path, data, size, false, &set, err);
    if (done)
        join(&set, out);
    mesh_set_free(&set);
    return done;
}

static bool load_stl(const char *path, const char *data, size_t size, struct mesh *out,
                     struct messages *messages, struct error *err)
{
    (void)messages;
    return read_stl(path, data, size, out, err);
}

static bool load_amf(const char *path, const char *data, size_t size, struct mesh *out,
                     struct messages *messages, struct error *err)
{
    (void)messages;
    return read_amf(path, data, size, out, err);
}

static bool load_nef3(const char *path, const char *data, size_t size, struct mesh *out,
                      struct messages *messages, struct error *err)
{
    (void)messages;
    return read_nef3(path, data, size, out, err);
}

static const struct {
    const char *extension;
    bool (*read)(const char *path, const char *data, size_t size, struct mesh *out,
                 struct messages *messages, struct error *err);
} meshes[] = {
    {"stl", load_stl}, {"off", read_off}, {"obj", read_obj},
    {"amf", load_amf}, {"3mf", load_3mf}, {"nef3", load_nef3},
};

static uint32_t mesh_format(const char *path)
{
    uint32_t i = 0;
    while (i < array_count(meshes) && strcasecmp(file_extension(path), meshes[i].extension) != 0)
        i++;
    return i;
}

static const struct solid *load_mesh(struct builder *b, const struct args *args, const char *path)
{
    const struct solid *solid = NULL;
    uint32_t format = mesh_format(path);
    char *data;
    size_t size;
    struct error err;
    if (!read_file(b, args, path, &data, &size))
        return NULL;
    uint64_t key = hash_bytes(KEY_IMPORT + format, data, size);
    solid = store_find(b->store, key);
    if (!solid) {
        struct mesh m;
        uint32_t warnings = b->messages->warnings;
        if (!meshes[format].read(path, data, size, &m, b->messages, &err))
            complain(b, args, &err);
        else if (b->messages->warnings != warnings) // not to be found: a reload says it again
            solid = store_mesh(b->store, &m, false);
        else
            solid = store_add(b->store, key, &m, false, CUT_TRIANGLES);
    }
    free(data);
    return solid && solid->mesh.triangle_count ? solid : NULL;
}

static const struct csg_value *name_of(const struct args *args)
{
    enum { FILENAME = 7 };
    return args->values[IMPORT_FILE] ? args->values[IMPORT_FILE] : args->values[FILENAME];
}

const struct solid *shape_import(struct builder *b, const struct args *args, struct affine *out)
{
    (void)out;
    char *path = path_of(b, args, name_of(args));
    if (!path)
        return NULL;
    if (mesh_format(path) == array_count(meshes)) {
        b->unsupported++;
        builder_warn(b, args->node, "import() cannot read files like '%s'; left out",
                     name_of(args)->string);
        free(path);
        return NULL;
    }
    struct import *import = find_import(b, path);
    if (!import->solid)
        import->solid = load_mesh(b, args, path);
    free(path);
    return import->solid;
}

const struct solid *shape_surface(struct builder *b, const struct args *args, struct affine *out)
{
    enum { FILE_, CENTER, CONVEXITY, INVERT };
    struct surface_options options = {.center = value_true(args->values[CENTER]),
                                      .invert = value_true(args->values[INVERT])};
    const struct solid *solid = NULL;
    char *path = path_of(b, args, args->values[FILE_]), *data;
    size_t size;
    struct error err;
    (void)out;
    if (!path)
        return NULL;
    builder_note_import(b, path);
    if (read_file(b, args, path, &data, &size)) {
        struct mesh m;
        if (read_surface(path, data, size, &options, &m, b->messages, &err))
            solid = store_mesh(b->store, &m, false);
        else
            complain(b, args, &err);
        free(data);
    }
    free(path);
    return solid && solid->mesh.triangle_count ? solid : NULL;
}

// ---------------------------------------------------------------- flat shapes

static bool is_flat(const char *path)
{
    return strcasecmp(file_extension(path), "dxf") == 0 ||
           strcasecmp(file_extension(path), "svg") == 0;
}

const struct node_type *import_type_of(const struct csg_node *n)
{
    struct builder unheard = {.messages = &(struct messages){0}};
    struct args args;
    args_bind(&args, &unheard, n, &parameters_import, DETAIL_DEFAULT);
    messages_free(unheard.messages);
    return import_type(&args);
}

const struct node_type *import_type(const struct args *args)
{
    static const struct node_type flat = {"import", .kind = NODE_FLAT,
                                          .parameters = &parameters_import, .flat = flat_import,
                                          .gives = GEOMETRY_FLAT};
    static const struct node_type mesh = {"import", .kind = NODE_SHAPE,
                                          .parameters = &parameters_import, .shape = shape_import,
                                          .gives = GEOMETRY_SOLID};
    const struct csg_value *file = name_of(args);
    return file && file->kind == CSG_STRING && is_flat(file->string) ? &flat : &mesh;
}

static const char *string_of(const struct csg_value *v)
{
    return v && v->kind == CSG_STRING ? v->string : NULL;
}

static bool read_flat(struct builder *b, const struct args *args, const char *path,
                      const char *data, size_t size, struct outline *out, struct error *err)
{
    enum { LAYERNAME = 8, CENTER, DPI, ID };
    const struct csg_value *const *v = args->values;
    const char *layer = string_of(v[IMPORT_LAYER] ? v[IMPORT_LAYER] : v[LAYERNAME]);
    double origin[2] = {0}, scale = 1, dpi = 72;
    value_numbers(v[IMPORT_ORIGIN], origin, 2, 2);
    value_number(v[IMPORT_SCALE], &scale);
    value_number(v[DPI], &dpi);
    if (strcasecmp(file_extension(path), "dxf") == 0) {
        struct dxf_options options = {layer, origin[0], origin[1], scale, args->detail};
        return read_dxf(path, data, size, &options, out, b->messages, err);
    }
    struct svg_options options = {.dpi = dpi,
                                  .center = value_true(v[CENTER]),
                                  .id = string_of(v[ID]),
                                  .layer = layer,
                                  .newer = v[ID] != NULL,
                                  .detail = args->detail};
    return read_svg(path, data, size, &options, out, b->messages, err);
}

void flat_import(struct builder *b, const struct args *args, struct outline *out)
{
    char *path = path_of(b, args, name_of(args)), *data;
    size_t size;
    struct error err;
    out->clean = true;
    if (!path)
        return;
    builder_note_import(b, path);
    if (read_file(b, args, path, &data, &size)) {
        if (!read_flat(b, args, path, data, size, out, &err))
            complain(b, args, &err);
        free(data);
    }
    free(path);
}
