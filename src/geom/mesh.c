// mesh.c - building and measuring indexed triangle meshes.
#include "geom/mesh.h"

#include "base/hash.h"

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

// Open addressing over vertex numbers; a slot holds number + 1.
static uint32_t *find_slot(uint32_t *slots, size_t mask, const struct vec3 *vertices, struct vec3 p)
{
    struct vec3 key = {p.x + 0.0, p.y + 0.0, p.z + 0.0}; // -0 becomes 0
    size_t at = hash_bytes(0, &key, sizeof key) & mask;
    while (slots[at]) {
        struct vec3 q = vertices[slots[at] - 1];
        if (q.x == p.x && q.y == p.y && q.z == p.z)
            break;
        at = (at + 1) & mask;
    }
    return &slots[at];
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

static void drop_collapsed(struct mesh *m, const uint32_t *same)
{
    uint32_t kept = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *old = m->triangles[t];
        uint32_t i = same[old[0]], j = same[old[1]], k = same[old[2]];
        if (i == j || j == k || k == i)
            continue;
        m->triangles[kept][0] = i;
        m->triangles[kept][1] = j;
        m->triangles[kept][2] = k;
        m->faces[kept++] = m->faces[t];
    }
    m->triangle_count = kept;
}

void mesh_weld(struct mesh *m)
{
    size_t size = 16;
    while (size < (size_t)m->vertex_count * 2)
        size *= 2;
    uint32_t *slots = mem_zalloc(size * sizeof *slots);
    uint32_t *same = mem_alloc((size_t)m->vertex_count * sizeof *same); // the first equal vertex
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        uint32_t *slot = find_slot(slots, size - 1, m->vertices, m->vertices[v]);
        if (!*slot)
            *slot = v + 1;
        same[v] = *slot - 1;
    }
    free(slots);
    drop_collapsed(m, same);

    uint32_t *vertex = same; // reused as the map of numbers
    uint32_t *face = mem_alloc((size_t)m->face_count * sizeof *face);
    memset(vertex, 0xff, (size_t)m->vertex_count * sizeof *vertex);
    memset(face, 0xff, (size_t)m->face_count * sizeof *face);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        face[m->faces[t]] = 0;
        for (int i = 0; i < 3; i++)
            vertex[m->triangles[t][i]] = 0;
    }
    uint32_t vertex_count = renumber(vertex, m->vertex_count);
    m->face_count = renumber(face, m->face_count);
    for (uint32_t v = 0; v < m->vertex_count; v++)
        if (vertex[v] != UINT32_MAX)
            m->vertices[vertex[v]] = m->vertices[v];
    m->vertex_count = vertex_count;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        m->faces[t] = face[m->faces[t]];
        for (int i = 0; i < 3; i++)
            m->triangles[t][i] = vertex[m->triangles[t][i]];
    }
    free(face);
    free(vertex);
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
