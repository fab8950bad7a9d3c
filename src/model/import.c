// import.c - meshes read from files beside the .csg.
#include "base/file.h"
#include "base/hash.h"
#include "io/read_off.h"
#include "io/read_stl.h"
#include "model/nodes.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

const struct parameters parameters_import = {{"file", "layer", "convexity", "origin", "scale",
                                              "width", "height", "filename", "layername", "center",
                                              "dpi", "id", "timestamp"},
                                             5};

enum { KEY_IMPORT = 0x696d706f };
#define IMPORT_LIMIT ((size_t)1 << 31)

static bool read_mesh(const char *extension, const char *path, const char *data, size_t size,
                      struct mesh *out, struct error *err)
{
    return strcasecmp(extension, "stl") == 0 ? read_stl(path, data, size, out, err)
                                             : read_off(path, data, size, out, err);
}

static const struct solid *load(struct builder *b, const struct args *args, const char *path)
{
    const char *extension = file_extension(path);
    const struct solid *solid = NULL;
    char *data;
    size_t size;
    struct error err;
    if (!file_read(path, IMPORT_LIMIT, &data, &size, &err)) {
        builder_warn(b, args->node, "%s; left out", err.text);
        return NULL;
    }
    bool stl = strcasecmp(extension, "stl") == 0;
    uint64_t key = hash_bytes(KEY_IMPORT + stl, data, size);
    solid = store_find(b->store, key);
    if (!solid) {
        struct mesh m;
        if (read_mesh(extension, path, data, size, &m, &err))
            solid = store_add(b->store, key, &m, false);
        else
            messages_add(b->messages, MESSAGE_ERROR, builder_place(b, args->node), "%s", err.text);
    }
    free(data);
    return solid && solid->mesh.triangle_count ? solid : NULL;
}

// Number of the path among the model's imports.
static uint32_t find_import(struct builder *b, const char *path)
{
    for (uint32_t i = 0; i < b->import_count; i++)
        if (strcmp(b->imports[i].path, path) == 0)
            return i;
    array_reserve(&b->imports, &b->import_room, (size_t)b->import_count + 1);
    b->imports[b->import_count].path = mem_strdup(path);
    b->imports[b->import_count].solid = NULL;
    return b->import_count++;
}

const struct solid *shape_import(struct builder *b, const struct args *args, struct affine *out)
{
    (void)out;
    const struct csg_value *file = args->values[0] ? args->values[0] : args->values[7];
    if (!file || file->kind != CSG_STRING || !file->count) {
        builder_warn(b, args->node, "import() names no file; left out");
        return NULL;
    }
    const char *extension = file_extension(file->string);
    if (strcasecmp(extension, "stl") != 0 && strcasecmp(extension, "off") != 0) {
        b->unsupported++;
        builder_warn(b, args->node, "import() of '%s' is not supported yet; left out",
                     file->string);
        return NULL;
    }
    char *path = file_join(b->folder, file->string);
    uint32_t number = find_import(b, path);
    if (!b->imports[number].solid)
        b->imports[number].solid = load(b, args, path);
    free(path);
    return b->imports[number].solid;
}
