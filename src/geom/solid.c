// solid.c - one closed 3D shape in its own coordinates.
#include "geom/solid.h"

#include "base/mem.h"
#include "geom/mesh.h"

#include <stdlib.h>

void mesh_free(struct mesh *m)
{
    free(m->vertices);
    free(m->triangles);
    free(m->faces);
    free(m->turned);
    *m = (struct mesh){0};
}

void solid_free(struct solid *s)
{
    mesh_free(&s->mesh);
    free(s->planes.nx); // all four arrays
    outline_free(&s->outline);
    *s = (struct solid){0};
}

static void planes_alloc(struct planes *p, uint32_t count)
{
    p->count = count;
    p->padded = (count + 7) / 8 * 8;
    p->nx = mem_aligned(64, (size_t)p->padded * 4 * sizeof(double));
    p->ny = p->nx + p->padded;
    p->nz = p->ny + p->padded;
    p->d = p->nz + p->padded;
}

static void planes_set(struct planes *p, uint32_t i, struct vec3 n, double d)
{
    p->nx[i] = n.x;
    p->ny[i] = n.y;
    p->nz[i] = n.z;
    p->d[i] = d;
}

// Normals are sums over the triangles of a face, distances those of its outermost corner: the plane
// then cuts off no corner although the corners of a face are in one plane only up to rounding.
static void planes_build(struct planes *p, const struct mesh *m, struct box bounds)
{
    struct vec3 *sum = mem_zalloc((size_t)m->face_count * sizeof *sum);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        struct vec3 a = m->vertices[c[0]];
        struct vec3 twice =
            vec3_cross(vec3_sub(m->vertices[c[1]], a), vec3_sub(m->vertices[c[2]], a));
        sum[m->faces[t]] = vec3_add(sum[m->faces[t]], twice);
    }
    planes_alloc(p, m->face_count);
    for (uint32_t f = 0; f < m->face_count; f++) {
        double area = vec3_length(sum[f]);
        bool flat = area > 1e-300; // else a needle: a side of the bounding box cuts nothing
        struct vec3 n = flat ? vec3_scale(sum[f], 1 / area) : (struct vec3){0, 0, 1};
        planes_set(p, f, n, flat ? -INFINITY : bounds.max.z);
    }
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        uint32_t f = m->faces[t];
        struct vec3 n = {p->nx[f], p->ny[f], p->nz[f]};
        for (int i = 0; i < 3; i++)
            p->d[f] = fmax(p->d[f], vec3_dot(n, m->vertices[m->triangles[t][i]]));
    }
    for (uint32_t f = p->count; f < p->padded; f++)
        planes_set(p, f, (struct vec3){p->nx[0], p->ny[0], p->nz[0]}, p->d[0]);
    free(sum);
}

void solid_from_mesh(struct solid *out, struct mesh *m, bool convex, uint64_t hash)
{
    *out = (struct solid){.mesh = *m, .bounds = mesh_bounds(m), .convex = convex, .hash = hash};
    *m = (struct mesh){0};
    if (convex && out->mesh.face_count)
        planes_build(&out->planes, &out->mesh, out->bounds);
}
