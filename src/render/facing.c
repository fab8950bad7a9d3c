// facing.c - does a face turn its back to the viewer, as it was written?
#include "render/facing.h"

#include "base/mem.h"

#include <stdlib.h>

// A triangle of each face of a mesh.
struct face_corners {
    const struct solid *solid;
    uint32_t *triangles;
};

static int by_solid(const void *a, const void *b)
{
    uintptr_t left = (uintptr_t)((const struct face_corners *)a)->solid;
    uintptr_t right = (uintptr_t)((const struct face_corners *)b)->solid;
    return (left > right) - (left < right);
}

static double twice_area(const struct mesh *m, uint32_t triangle, struct vec3 *normal)
{
    const uint32_t *t = m->triangles[triangle];
    struct vec3 a = m->vertices[t[0]];
    *normal = vec3_cross(vec3_sub(m->vertices[t[1]], a), vec3_sub(m->vertices[t[2]], a));
    return vec3_length(*normal);
}

// The largest: others may be too thin to have a side.
static uint32_t *triangles_of_faces(const struct mesh *m)
{
    uint32_t *found = mem_alloc((m->face_count + 1) * sizeof *found);
    double *areas = mem_zalloc((m->face_count + 1) * sizeof *areas);
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 normal;
        double area = twice_area(m, i, &normal);
        if (area >= areas[m->faces[i]]) {
            areas[m->faces[i]] = area;
            found[m->faces[i]] = i;
        }
    }
    free(areas);
    return found;
}

static bool *inward_leaves(const struct body *body)
{
    const struct expr *e = &body->expr;
    bool *leaves = mem_zalloc(body->leaf_count + 1);
    bool *nodes = mem_zalloc(e->node_count + 1);
    for (uint32_t n = e->node_count; n-- > 0;) { // parents come after their children
        const struct expr_node *node = &e->nodes[n];
        if (node->parent != EXPR_NONE)
            nodes[n] = nodes[node->parent] != (e->nodes[node->parent].minus == n);
        if (node->op == EXPR_LEAF)
            leaves[node->leaf] = nodes[n];
    }
    free(nodes);
    return leaves;
}

void facing_init(struct facing *out, const struct model *m)
{
    uint32_t count = 0, room = 0, kept = 0;
    const struct body *body = &m->bodies[0];
    *out = (struct facing){.inwards = inward_leaves(body)};
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        const struct solid *solid = body->leaves[i].solid;
        if (solid->convex || (count && out->meshes[count - 1].solid == solid))
            continue;
        array_reserve(&out->meshes, &room, (size_t)count + 1);
        out->meshes[count++] = (struct face_corners){.solid = solid};
    }
    if (count)
        qsort(out->meshes, count, sizeof *out->meshes, by_solid);
    for (uint32_t i = 0; i < count; i++) {
        const struct solid *solid = out->meshes[i].solid;
        if (!kept || out->meshes[kept - 1].solid != solid)
            out->meshes[kept++] = (struct face_corners){solid, triangles_of_faces(&solid->mesh)};
    }
    out->mesh_count = kept;
}

void facing_free(struct facing *f)
{
    for (uint32_t i = 0; i < f->mesh_count; i++)
        free(f->meshes[i].triangles);
    free(f->meshes);
    free(f->inwards);
    *f = (struct facing){0};
}

struct viewpoint viewpoint_of(const struct rays *rays)
{
    return (struct viewpoint){rays->orthographic, rays->origin, rays->forward};
}

bool facing_back(const struct facing *f, const struct body *body, uint32_t leaf, uint32_t face,
                 const struct viewpoint *from)
{
    const struct leaf *placed = &body->leaves[leaf];
    const struct solid *solid = placed->solid;
    struct vec3 normal, point;
    bool turned = f->inwards[leaf];
    if (solid->convex) {
        const struct planes *p = &solid->planes;
        normal = (struct vec3){p->nx[face], p->ny[face], p->nz[face]};
        point = vec3_scale(normal, p->d[face]);
    } else {
        const struct face_corners key = {.solid = solid};
        const struct face_corners *found =
            bsearch(&key, f->meshes, f->mesh_count, sizeof *f->meshes, by_solid);
        uint32_t triangle = found ? found->triangles[face] : 0;
        twice_area(&solid->mesh, triangle, &normal);
        point = solid->mesh.vertices[solid->mesh.triangles[triangle][0]];
        turned ^= solid->mesh.turned && solid->mesh.turned[face];
    }
    struct vec3 towards = from->ahead;
    if (!from->orthographic)
        towards = vec3_sub(affine_point(&placed->to_world, point), from->eye);
    return (vec3_dot(affine_normal(&placed->to_local, normal), towards) > 0) != turned;
}
