// unit.h - cmocka, and what is asked of every mesh.
#pragma once
#include "geom/mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline void assert_close(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static inline int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, 2 * sizeof(uint32_t));
}

// Each directed edge stands once and its opposite too.
static inline bool mesh_is_closed(const struct mesh *m)
{
    size_t count = (size_t)m->triangle_count * 3;
    uint32_t(*edges)[2] = mem_alloc(count * sizeof *edges);
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            edges[3 * t + (uint32_t)i][0] = m->triangles[t][i];
            edges[3 * t + (uint32_t)i][1] = m->triangles[t][(i + 1) % 3];
        }
    qsort(edges, count, sizeof *edges, compare_edges);
    bool closed = true;
    for (size_t i = 0; i < count; i++) {
        uint32_t back[2] = {edges[i][1], edges[i][0]};
        closed &= i == 0 || compare_edges(edges[i], edges[i - 1]) != 0;
        closed &= bsearch(back, edges, count, sizeof *edges, compare_edges) != NULL;
    }
    free(edges);
    return closed;
}

static inline bool mesh_has_vertex(const struct mesh *m, double x, double y, double z)
{
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        struct vec3 p = m->vertices[v];
        if (fabs(p.x - x) < 1e-6 && fabs(p.y - y) < 1e-6 && fabs(p.z - z) < 1e-6)
            return true;
    }
    return false;
}
