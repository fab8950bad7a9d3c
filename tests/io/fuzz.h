// fuzz.h - what holds of every mesh and every flat shape that a reader gives.
#pragma once
#include "copy.h"
#include "geom/mesh.h"
#include "geom/outline.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void check_mesh(const struct mesh *m)
{
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        struct vec3 p = m->vertices[v];
        if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z))
            abort();
    }
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        if (c[0] >= m->vertex_count || c[1] >= m->vertex_count || c[2] >= m->vertex_count ||
            c[0] == c[1] || c[1] == c[2] || c[2] == c[0] || m->faces[t] >= m->face_count)
            abort();
    }
}

static inline void check_flat(const struct outline *o)
{
    if (!o->clean)
        abort();
    for (uint32_t i = 0; i < o->point_count; i++)
        if (!isfinite(o->points[i].x) || !isfinite(o->points[i].y))
            abort();
}
