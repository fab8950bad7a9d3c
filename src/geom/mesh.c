// mesh.c - building and measuring indexed triangle meshes.
#include "geom/mesh.h"

#include <stdlib.h>
#include <string.h>

uint32_t mesh_add_vertex(struct mesh_builder *b, struct vec3 p)
{
    struct mesh *m = &b->mesh;
    array_reserve(&m->vertices, &b->vertex_room, (size_t)m->vertex_count + 1);
    m->vertices[m->vertex_count] = p;
    return m->vertex_count++;
}

uint32_t mesh_add_face(struct mesh_builder *b)
{
    return b->mesh.face_count++;
}

void mesh_add_triangle(struct mesh_builder *b, uint32_t i, uint32_t j, uint32_t k, uint32_t face)
{
    struct mesh *m = &b->mesh;
    size_t needed = (size_t)m->triangle_count + 1;
    array_reserve(&m->triangles, &b->triangle_room, needed);
    array_reserve(&m->faces, &b->face_room, needed);
    uint32_t *t = m->triangles[m->triangle_count];
    t[0] = i;
    t[1] = j;
    t[2] = k;
    m->faces[m->triangle_count++] = face;
}

void mesh_add_convex(struct mesh_builder *b, const uint32_t *corners, uint32_t count)
{
    uint32_t face = mesh_add_face(b);
    for (uint32_t i = 2; i < count; i++)
        mesh_add_triangle(b, corners[0], corners[i - 1], corners[i], face);
}

static void drop_collapsed(struct mesh *m)
{
    uint32_t kept = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
            continue;
        if (kept < t) {
            memcpy(m->triangles[kept], c, sizeof m->triangles[t]);
            m->faces[kept] = m->faces[t];
        }
        kept++;
    }
    m->triangle_count = kept;
}

// Gives the used entries of `number` consecutive new numbers in their order; returns how many.
static uint32_t renumber(uint32_t *number, uint32_t count)
{
    uint32_t next = 0;
    for (uint32_t i = 0; i < count; i++)
        if (number[i] != UINT32_MAX)
            number[i] = next++;
    return next;
}

static void drop_vertices(struct mesh *m)
{
    uint32_t *number = mem_alloc((size_t)m->vertex_count * sizeof *number);
    memset(number, 0xff, (size_t)m->vertex_count * sizeof *number);
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            number[m->triangles[t][i]] = 0;
    uint32_t count = renumber(number, m->vertex_count);
    if (count < m->vertex_count) {
        for (uint32_t v = 0; v < m->vertex_count; v++)
            if (number[v] != UINT32_MAX)
                m->vertices[number[v]] = m->vertices[v];
        for (uint32_t t = 0; t < m->triangle_count; t++)
            for (int i = 0; i < 3; i++)
                m->triangles[t][i] = number[m->triangles[t][i]];
        m->vertex_count = count;
    }
    free(number);
}

static void drop_faces(struct mesh *m)
{
    uint32_t *number = mem_alloc((size_t)m->face_count * sizeof *number);
    memset(number, 0xff, (size_t)m->face_count * sizeof *number);
    for (uint32_t t = 0; t < m->triangle_count; t++)
        number[m->faces[t]] = 0;
    uint32_t count = renumber(number, m->face_count);
    if (count < m->face_count) {
        for (uint32_t t = 0; t < m->triangle_count; t++)
            m->faces[t] = number[m->faces[t]];
        m->face_count = count;
    }
    free(number);
}

void mesh_drop_unused(struct mesh *m)
{
    drop_collapsed(m);
    drop_vertices(m);
    drop_faces(m);
}

struct box mesh_bounds(const struct mesh *m)
{
    struct box b = BOX_EMPTY;
    for (uint32_t v = 0; v < m->vertex_count; v++)
        b = box_of_point(b, m->vertices[v]);
    return b;
}

double mesh_volume(const struct mesh *m)
{
    if (!m->vertex_count)
        return 0;
    struct vec3 o = m->vertices[0]; // near the shape, for accuracy far from the origin
    double six = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        six += vec3_dot(vec3_sub(m->vertices[c[0]], o),
                        vec3_cross(vec3_sub(m->vertices[c[1]], o), vec3_sub(m->vertices[c[2]], o)));
    }
    return six / 6;
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
