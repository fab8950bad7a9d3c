// export.c - a model that is one evaluated object as a file of its geometry.
#include "model/export.h"

#include "base/mem.h"
#include "geom/placed.h"
#include "io/write_dxf.h"
#include "io/write_off.h"
#include "io/write_stl.h"

#include <strings.h>

bool export_format_find(enum export_format *out, const char *name)
{
    static const char *const names[] = {
        [EXPORT_STL] = "stl", [EXPORT_OFF] = "off", [EXPORT_DXF] = "dxf"};
    for (size_t i = 0; i < array_count(names); i++)
        if (strcasecmp(name, names[i]) == 0) {
            *out = (enum export_format)i;
            return true;
        }
    return false;
}

// The one leaf that the model is.
static const struct leaf *only_leaf(const struct model *m, struct error *err)
{
    const struct leaf *found = NULL;
    for (uint32_t i = 0; i < m->body_count; i++) {
        const struct body *body = &m->bodies[i];
        if (body->kind == BODY_BACKGROUND || body->expr.root == EXPR_NONE)
            continue;
        const struct expr_node *root = &body->expr.nodes[body->expr.root];
        if (found || root->op != EXPR_LEAF) {
            error_set(err, "%s: is not one object: booleans of solids are not evaluated", m->file);
            return NULL;
        }
        found = &body->leaves[root->leaf];
    }
    if (!found)
        error_set(err, "%s: is empty", m->file);
    return found;
}

static bool export_flat(const struct leaf *leaf, const char *path, struct error *err)
{
    struct outline shape = {0};
    outline_copy(&shape, &leaf->solid->outline);
    outline_transform(&shape, &leaf->to_world);
    bool ok = write_dxf(path, &shape, err);
    outline_free(&shape);
    return ok;
}

bool model_export(const struct model *m, enum export_format format, const char *path,
                  struct error *err)
{
    const struct leaf *leaf = only_leaf(m, err);
    if (!leaf)
        return false;
    if (leaf->flat != (format == EXPORT_DXF)) {
        error_set(err, "%s: %s", m->file,
                  leaf->flat ? "is a flat shape: only DXF holds one"
                             : "is a solid: DXF holds only flat shapes");
        return false;
    }
    if (leaf->flat)
        return export_flat(leaf, path, err);
    struct mesh mesh;
    mesh_placed(&mesh, &leaf->solid->mesh, &leaf->to_world);
    bool ok = format == EXPORT_OFF ? write_off(path, &mesh, err) : write_stl(path, &mesh, err);
    mesh_free(&mesh);
    return ok;
}
