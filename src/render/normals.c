// normals.c - which way the faces of a model's leaves look.
#include "render/normals.h"

#include "base/mem.h"

#include <stdlib.h>

// Of a mesh whose faces have several triangles; their length is twice the area.
struct face_normals {
    const struct solid *solid;
    struct vec3 *normals;
};

static int by_solid(const void *a, const void *b)
{
    uintptr_t left = (uintptr_t)((const struct face_normals *)a)->solid;
    uintptr_t right = (uintptr_t)((const struct face_normals *)b)->solid;
    return (left > right) - (left < right);
}

static struct vec3 triangle_normal(const struct mesh *m, uint32_t triangle)
{
    const uint32_t *t = m->triangles[triangle];
    struct vec3 a = m->vertices[t[0]];
    return vec3_cross(vec3_sub(m->vertices[t[1]], a), vec3_sub(m->vertices[t[2]], a));
}

static bool faces_are_triangles(const struct mesh *m)
{
    if (m->face_count != m->triangle_count)
        return false;
    for (uint32_t i = 0; i < m->triangle_count; i++)
        if (m->faces[i] != i)
            return false;
    return true;
}

static struct vec3 *sum_normals(const struct mesh *m)
{
    if (faces_are_triangles(m))
        return NULL;
    struct vec3 *normals = mem_zalloc(m->face_count * sizeof *normals);
    for (uint32_t i = 0; i < m->triangle_count; i++)
        normals[m->faces[i]] = vec3_add(normals[m->faces[i]], triangle_normal(m, i));
    return normals;
}

void normals_init(struct normals *out, const struct model *m)
{
    uint32_t count = 0, room = 0, kept = 0;
    *out = (struct normals){0};
    for (uint32_t b = 0; b < m->body_count; b++) {
        const struct body *body = &m->bodies[b];
        for (uint32_t i = 0; i < body->leaf_count; i++) {
            const struct solid *solid = body->leaves[i].solid;
            if (solid->convex || (count && out->meshes[count - 1].solid == solid))
                continue;
            array_reserve(&out->meshes, &room, count + 1);
            out->meshes[count++] = (struct face_normals){.solid = solid};
        }
    }
    if (count)
        qsort(out->meshes, count, sizeof *out->meshes, by_solid);
    for (uint32_t i = 0; i < count; i++) {
        if (kept && out->meshes[kept - 1].solid == out->meshes[i].solid)
            continue;
        out->meshes[kept] = out->meshes[i];
        out->meshes[kept].normals = sum_normals(&out->meshes[kept].solid->mesh);
        kept++;
    }
    out->mesh_count = kept;
}

void normals_free(struct normals *n)
{
    for (uint32_t i = 0; i < n->mesh_count; i++)
        free(n->meshes[i].normals);
    free(n->meshes);
    *n = (struct normals){0};
}

// In the leaf's own coordinates, of any length.
static struct vec3 local_normal(const struct normals *n, const struct solid *solid, uint32_t face)
{
    if (solid->convex) {
        const struct planes *p = &solid->planes;
        return (struct vec3){p->nx[face], p->ny[face], p->nz[face]};
    }
    const struct face_normals key = {.solid = solid};
    const struct face_normals *found =
        n->mesh_count ? bsearch(&key, n->meshes, n->mesh_count, sizeof *n->meshes, by_solid) : NULL;
    return found && found->normals ? found->normals[face] : triangle_normal(&solid->mesh, face);
}

struct vec3 normals_find(const struct normals *n, const struct leaf *leaf, uint32_t face)
{
    return vec3_normalized(affine_normal(&leaf->to_local, local_normal(n, leaf->solid, face)));
}
