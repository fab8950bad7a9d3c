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
    for (uint32_t i = 0; i < m->vertex_count; i++)
        out->vertices[i] = affine_point(a, m->vertices[i]);
    for (uint32_t i = 0; i < m->triangle_count && mirrored; i++) {
        uint32_t *t = out->triangles[i], first = t[0];
        t[0] = t[2];
        t[2] = first;
    }
}

static struct vec3 twice_area(const struct mesh *m, uint32_t i)
{
    const uint32_t *t = m->triangles[i];
    struct vec3 a = m->vertices[t[0]];
    return vec3_cross(vec3_sub(m->vertices[t[1]], a), vec3_sub(m->vertices[t[2]], a));
}

double mesh_area(const struct mesh *m)
{
    double sum = 0;
    for (uint32_t i = 0; i < m->triangle_count; i++)
        sum += vec3_length(twice_area(m, i)) / 2;
    return sum;
}

void mesh_largest_plane(const struct mesh *m, struct affine *out)
{
    struct vec3 largest = {0, 0, 0}, x = {1, 0, 0}, origin = {0, 0, 0};
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 n = twice_area(m, i);
        if (vec3_dot(n, n) <= vec3_dot(largest, largest))
            continue;
        largest = n;
        origin = m->vertices[m->triangles[i][0]];
        x = vec3_sub(m->vertices[m->triangles[i][1]], origin);
    }
    x = vec3_normalized(x);
    struct vec3 z = vec3_normalized(largest), y = vec3_cross(z, x);
    *out = (struct affine){
        {{x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}}};
}
