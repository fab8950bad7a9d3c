// placed.c - meshes where an affine map puts them.
#include "geom/placed.h"

#include "base/mem.h"

#include <string.h>

static void *copy(const void *items, size_t size)
{
    void *to = mem_alloc(size);
    if (size)
        memcpy(to, items, size);
    return to;
}

void mesh_placed(struct mesh *out, const struct mesh *m, const struct affine *a)
{
    bool mirrored = affine_determinant(a) < 0;
    *out = *m;
    out->vertices = copy(m->vertices, m->vertex_count * sizeof *m->vertices);
    out->triangles = copy(m->triangles, m->triangle_count * sizeof *m->triangles);
    out->faces = copy(m->faces, m->triangle_count * sizeof *m->faces);
    if (m->turned)
        out->turned = copy(m->turned, m->face_count * sizeof *m->turned);
    for (uint32_t i = 0; i < m->vertex_count; i++)
        out->vertices[i] = affine_point(a, m->vertices[i]);
    for (uint32_t i = 0; i < m->triangle_count && mirrored; i++) {
        uint32_t *t = out->triangles[i], first = t[0];
        t[0] = t[2];
        t[2] = first;
    }
}
