// convex_sum.c - Minkowski sums of convex shapes.
#include "geom/convex_sum.h"

#include "base/mem.h"
#include "geom/hull.h"

#include <stdlib.h>
#include <string.h>

#define NOISE 1e-9 // of the extents

static void corners_alloc(struct corners *c, uint32_t count, uint32_t edges, uint32_t normals)
{
    c->count = count;
    c->points = mem_alloc((size_t)count * sizeof *c->points);
    c->edges = mem_alloc((size_t)edges * sizeof *c->edges);
    c->normals = mem_alloc((size_t)normals * sizeof *c->normals);
    c->edge_ends = mem_zalloc((size_t)count * sizeof *c->edge_ends);
    c->normal_ends = mem_zalloc((size_t)count * sizeof *c->normal_ends);
}

void corners_free(struct corners *c)
{
    free(c->points);
    free(c->edges);
    free(c->normals);
    free(c->edge_ends);
    free(c->normal_ends);
    *c = (struct corners){0};
}

static void running_sums(uint32_t *n, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        n[i] += n[i - 1];
}

// Diagonals of flat faces count as edges: what holds for the direction to any other corner may be
// asked of it. Each triangle gives its corners the edge and the normal that follow in the ring
// around them, a face of several triangles its normal more than once.
void corners_of_mesh(struct corners *out, const struct mesh *m)
{
    corners_alloc(out, m->vertex_count, m->triangle_count * 3, m->triangle_count * 3);
    memcpy(out->points, m->vertices, (size_t)m->vertex_count * sizeof *out->points);
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            out->edge_ends[m->triangles[t][i]]++;
    running_sums(out->edge_ends, m->vertex_count);
    uint32_t *at = mem_alloc((size_t)m->vertex_count * sizeof *at);
    for (uint32_t v = 0; v < m->vertex_count; v++)
        at[v] = v ? out->edge_ends[v - 1] : 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        const struct vec3 *p = m->vertices;
        struct vec3 normal =
            vec3_normalized(vec3_cross(vec3_sub(p[c[1]], p[c[0]]), vec3_sub(p[c[2]], p[c[0]])));
        for (int i = 0; i < 3; i++) {
            uint32_t k = at[c[i]]++;
            out->edges[k] = vec3_sub(p[c[(i + 1) % 3]], p[c[i]]);
            out->normals[k] = normal;
        }
    }
    memcpy(out->normal_ends, out->edge_ends, (size_t)m->vertex_count * sizeof *at);
    free(at);
}

void corners_of_polygon(struct corners *out, const struct vec3 *points, uint32_t count,
                        struct vec3 normal)
{
    corners_alloc(out, count, count * 2, count * 4);
    memcpy(out->points, points, (size_t)count * sizeof *points);
    for (uint32_t i = 0; i < count; i++) {
        struct vec3 before = vec3_sub(points[(i + count - 1) % count], points[i]);
        struct vec3 after = vec3_sub(points[(i + 1) % count], points[i]);
        out->edges[2 * i] = before;
        out->edges[2 * i + 1] = after;
        struct vec3 *n = out->normals + 4 * (size_t)i;
        n[0] = normal;
        n[1] = vec3_scale(normal, -1);
        n[2] = vec3_normalized(vec3_cross(normal, before));
        n[3] = vec3_normalized(vec3_cross(after, normal));
        out->edge_ends[i] = 2 * i + 2;
        out->normal_ends[i] = 4 * i + 4;
    }
}

// Is there for each edge of corner i of `a` a normal of corner k of `b` along which it does not
// rise?
static bool may_meet(const struct corners *a, uint32_t i, const struct corners *b, uint32_t k,
                     double tolerance)
{
    uint32_t normals = k ? b->normal_ends[k - 1] : 0;
    for (uint32_t e = i ? a->edge_ends[i - 1] : 0; e < a->edge_ends[i]; e++) {
        uint32_t n = normals;
        while (n < b->normal_ends[k] && vec3_dot(a->edges[e], b->normals[n]) > tolerance)
            n++;
        if (n == b->normal_ends[k])
            return false;
    }
    return true;
}

static double extent(const struct corners *c)
{
    struct box b = BOX_EMPTY;
    for (uint32_t i = 0; i < c->count; i++)
        b = box_of_point(b, c->points[i]);
    return c->count ? vec3_length(vec3_sub(b.max, b.min)) : 0;
}

// A corner of the sum is the sum of two corners that are both the only outermost points along some
// direction u. All edges of both descend along u, and u is a non-negative combination of the
// normals of either: thus to each edge of one there is a normal of the other along which it
// descends. Of all pairs few more than the corners of the sum pass.
bool convex_sum(struct mesh *out, const struct corners *a, const struct corners *b)
{
    double tolerance = NOISE * (extent(a) + extent(b));
    struct vec3 *points = NULL;
    uint32_t count = 0, room = 0;
    for (uint32_t i = 0; i < a->count; i++)
        for (uint32_t k = 0; k < b->count; k++) {
            if (!may_meet(a, i, b, k, tolerance) || !may_meet(b, k, a, i, tolerance))
                continue;
            array_reserve(&points, &room, (size_t)count + 1);
            points[count++] = vec3_add(a->points[i], b->points[k]);
        }
    bool ok = hull_solid(out, points, count);
    free(points);
    return ok;
}
