// faces.c - which face of a leaf a ray crosses, how steeply, and whether two lie in one plane.
#include "render/cpu/tile.h"

#include <float.h>
#include <string.h>

const uint32_t *tile_planes(const struct tile *t, struct block_leaf *b, bool leaving)
{
    if (b->known[leaving])
        return b->plane[leaving];
    const struct plane_pool *pool = &t->planes;
    const v8f *key = (const v8f *)(leaving ? b->leave : b->enter), steps = BLOCK_STEPS;
    uint32_t from = leaving ? b->front : 0, to = leaving ? b->front + b->back : b->front;
    v8i plane[BLOCK];
    for (int y = 0; y < BLOCK; y++)
        plane[y] = v8_seti(-1);
    for (uint32_t k = from; k < to; k++) {
        uint32_t p = t->index[b->planes + k];
        v8f row = t->key[b->planes + k] + pool->b[p] * steps, c = pool->c[p] * steps;
        for (int y = 0; y < BLOCK; y++)
            plane[y] = v8_selecti(row + c[y] == key[y], v8_seti((int32_t)p), plane[y]);
    }
    memcpy(b->plane[leaving], plane, sizeof plane);
    b->known[leaving] = true;
    return b->plane[leaving];
}

// The interval of a mesh on a ray whose end is nearest to a key; NULL when the ray has none.
static const struct mesh_interval *
nearest_interval(const struct tile *t, const struct block_leaf *b, int ray, bool leaving, float key)
{
    const struct mesh_interval *m = t->mesh.intervals + b->interval, *found = NULL;
    float nearest = FLT_MAX; // a key may have been taken over from a face within epsilon
    for (uint32_t k = b->first[ray]; k < b->first[ray + 1]; k++) {
        float away = fabsf((leaving ? m[k].leave : m[k].enter) - key);
        if (away < nearest) {
            nearest = away;
            found = &m[k];
        }
    }
    return found;
}

uint32_t tile_face(struct tile *t, struct tile_leaf *l, int i, bool leaving, float key,
                   float *steep)
{
    struct block_leaf *b = tile_crossings(t, l);
    *steep = 1;
    if (!b || key <= t->frame->start)
        return SURFACE_CAP;
    if (b->mesh) {
        const struct mesh_interval *m = nearest_interval(t, b, i, leaving, key);
        if (!m)
            return SURFACE_CAP;
        uint32_t triangle = leaving ? m->leave_triangle : m->enter_triangle;
        *steep = leaving ? m->leave_steep : m->enter_steep;
        return triangle == SURFACE_CAP
                   ? SURFACE_CAP
                   : t->frame->body->leaves[l->leaf].solid->mesh.faces[triangle];
    }
    const struct plane_pool *pool = &t->planes;
    uint32_t p = tile_planes(t, b, leaving)[i];
    if (p == UINT32_MAX)
        return SURFACE_CAP;
    float x = t->mx + BLOCK_STEPS[i % BLOCK], y = t->my + BLOCK_STEPS[i / BLOCK];
    *steep = fabsf(pool->steep[p] + pool->steep_x[p] * x + pool->steep_y[p] * y);
    return pool->face[p];
}

double tile_thickness(const struct tile *t, float from, float to, float steep)
{
    const struct frame *f = t->frame;
    steep = fmaxf(steep, STEEP_LEAST);
    if (f->rays->orthographic)
        return ((double)to - from) * steep;
    double t0 = f->t0, a = t0 - from, b = t0 - to;
    if (!(b > 0))
        return INFINITY;
    return t0 * t0 * ((double)to - from) / (a * b) * steep;
}

// The unit normal in the world of the face that is crossed; zero where it is none.
static struct vec3 normal_at(struct tile *t, int ray, struct face_at at)
{
    const struct leaf *leaf = &t->frame->body->leaves[at.leaf->leaf];
    struct block_leaf *b = tile_crossings(t, at.leaf);
    struct vec3 n = {0};
    if (!b || at.key <= t->frame->start)
        return n;
    if (b->mesh) {
        const struct mesh *m = &leaf->solid->mesh;
        const struct mesh_interval *near = nearest_interval(t, b, ray, at.leaving, at.key);
        uint32_t triangle = !near        ? SURFACE_CAP
                            : at.leaving ? near->leave_triangle
                                         : near->enter_triangle;
        if (triangle == SURFACE_CAP)
            return n;
        const uint32_t *c = m->triangles[triangle];
        struct vec3 corner = m->vertices[c[0]];
        n = vec3_cross(vec3_sub(m->vertices[c[1]], corner), vec3_sub(m->vertices[c[2]], corner));
    } else {
        const struct planes *p = &leaf->solid->planes;
        uint32_t plane = tile_planes(t, b, at.leaving)[ray];
        if (plane == UINT32_MAX || t->planes.face[plane] >= p->count)
            return n;
        uint32_t face = t->planes.face[plane];
        n = (struct vec3){p->nx[face], p->ny[face], p->nz[face]};
    }
    return vec3_normalized(affine_normal(&leaf->to_local, n));
}

bool tile_coplanar(struct tile *t, int ray, struct face_at a, struct face_at b)
{
    struct vec3 n = normal_at(t, ray, a), m = normal_at(t, ray, b);
    // above what six digits in matrices and points turn a plane by; what is no face is in no plane
    return vec3_length(vec3_cross(n, m)) < 1e-4 && fabs(vec3_dot(n, m)) > 0.5;
}
