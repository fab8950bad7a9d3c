// faces.c - the planes of the faces of a body's leaves, in the world.
#include "faces.h"

#include "base/mem.h"

#include <stdlib.h>

// A face may consist of several triangles: the largest gives the plane.
static void add_leaf(struct face_plane *planes, const struct leaf *leaf)
{
    const struct mesh *m = &leaf->solid->mesh;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct face_plane *p = &planes[m->faces[i]];
        struct vec3 corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = affine_point(&leaf->to_world, m->vertices[m->triangles[i][k]]);
        struct vec3 normal =
            vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0]));
        if (vec3_length(normal) > vec3_length(p->normal))
            *p = (struct face_plane){normal, vec3_dot(normal, corner[0])};
    }
}

void faces_init(struct faces *out, const struct body *body)
{
    size_t count = 0;
    out->first = mem_alloc((body->leaf_count + 1) * sizeof *out->first);
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        out->first[i] = count;
        count += body->leaves[i].solid->mesh.face_count;
    }
    out->planes = mem_zalloc((count + 1) * sizeof *out->planes);
    for (uint32_t i = 0; i < body->leaf_count; i++)
        add_leaf(out->planes + out->first[i], &body->leaves[i]);
}

void faces_free(struct faces *f)
{
    free(f->planes);
    free(f->first);
    *f = (struct faces){0};
}
