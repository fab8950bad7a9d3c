// bent.c - the faces of a body's convex leaves as OpenSCAD's geometry has them: in flat parts.
#include "render/bent.h"

#include "base/mem.h"
#include "geom/bend.h"

#include <stdlib.h>

struct bent_leaf {
    struct bends parts;
    uint32_t *first; // of each face in `parts`, and the end of the last; NULL: not asked for yet
    uint32_t *edges; // of each vertex in `ends`, and the end of the last
    uint32_t *ends;  // of edges: the other ones
};

struct bent {
    const struct body *body;
    const struct facets *facets;
    struct bent_leaf *leaves;
};

struct bent *bent_new(const struct body *body, const struct facets *facets)
{
    struct bent *b = mem_alloc(sizeof *b);
    *b = (struct bent){body, facets, mem_zalloc((body->leaf_count + 1) * sizeof *b->leaves)};
    return b;
}

void bent_delete(struct bent *b)
{
    if (!b)
        return;
    for (uint32_t i = 0; i < b->body->leaf_count; i++) {
        bends_free(&b->leaves[i].parts);
        free(b->leaves[i].first);
        free(b->leaves[i].edges);
        free(b->leaves[i].ends);
    }
    free(b->leaves);
    free(b);
}

// Each edge is a side of two parts, once in each direction.
static void find_edges(struct bent_leaf *out, uint32_t vertex_count)
{
    const struct bends *b = &out->parts;
    out->edges = mem_zalloc(((size_t)vertex_count + 2) * sizeof *out->edges);
    out->ends = mem_alloc(((size_t)b->corner_count + 1) * sizeof *out->ends);
    uint32_t *next = out->edges + 1; // of each vertex
    for (uint32_t i = 0; i < b->corner_count; i++)
        next[b->corners[i] + 1]++;
    for (uint32_t v = 0; v < vertex_count; v++)
        next[v + 1] += next[v];
    for (uint32_t part = 0, begin = 0; part < b->count; begin = b->ends[part++])
        for (uint32_t i = begin; i < b->ends[part]; i++)
            out->ends[next[b->corners[i]]++] = b->corners[i + 1 < b->ends[part] ? i + 1 : begin];
}

// Corners in the parts become vertices of the solid.
static void find_parts(struct bent_leaf *out, const struct solid *solid, const struct affine *grid,
                       const struct facets *facets)
{
    bool mirrored = affine_determinant(grid) < 0;
    const struct mesh *m = &solid->mesh;
    struct vec3 *placed = NULL;
    uint32_t room = 0;
    out->first = mem_alloc(((size_t)m->face_count + 1) * sizeof *out->first);
    for (uint32_t face = 0; face < m->face_count; face++) {
        uint32_t count, before = out->parts.corner_count;
        const uint32_t *corners = facets_corners(facets, solid, face, &count);
        out->first[face] = out->parts.count;
        array_reserve(&placed, &room, (size_t)count + 1);
        for (uint32_t i = 0; i < count; i++)
            placed[i] = affine_point(grid, m->vertices[corners[i]]);
        bend_face(&out->parts, placed, count, mirrored);
        for (uint32_t i = before; i < out->parts.corner_count; i++)
            out->parts.corners[i] = corners[out->parts.corners[i]];
    }
    out->first[m->face_count] = out->parts.count;
    free(placed);
    find_edges(out, m->vertex_count);
}

const uint32_t *bent_edges(const struct bent *b, uint32_t leaf, uint32_t vertex, uint32_t *count)
{
    const struct bent_leaf *l = &b->leaves[leaf];
    *count = l->edges[vertex + 1] - l->edges[vertex];
    return l->ends + l->edges[vertex];
}

double bent_side(const struct solid *solid, struct bent_part p, uint32_t k, struct vec3 origin,
                 struct vec3 direction)
{
    const struct vec3 *v = solid->mesh.vertices;
    struct vec3 from = vec3_sub(v[p.corners[k]], origin);
    struct vec3 to = vec3_sub(v[p.corners[(k + 1) % p.count]], origin);
    double side = vec3_dot(direction, vec3_cross(from, to));
    return vec3_dot(direction, p.normal) < 0 ? -side : side;
}

// A single shape stands in the world when it becomes geometry.
static const struct affine *grid_of(const struct body *body, const struct leaf *leaf)
{
    if (leaf->grid)
        return &body->grids[leaf->grid - 1];
    return body->leaf_count == 1 ? &leaf->to_world : NULL;
}

struct bent_part bent_find(struct bent *b, uint32_t leaf, uint32_t face, struct vec3 origin,
                           struct vec3 direction)
{
    const struct solid *solid = b->body->leaves[leaf].solid;
    struct bent_leaf *l = &b->leaves[leaf];
    struct bent_part best = {0};
    double best_inside = -INFINITY;
    const struct affine *grid = grid_of(b->body, &b->body->leaves[leaf]);
    if (!solid->convex || !grid)
        return best;
    if (!l->first)
        find_parts(l, solid, grid, b->facets);
    if (l->first[face + 1] - l->first[face] < 2)
        return best;
    for (uint32_t i = l->first[face]; i < l->first[face + 1]; i++) {
        uint32_t begin = i ? l->parts.ends[i - 1] : 0;
        struct bent_part p = {
            l->parts.corners + begin,
            l->parts.ends[i] - begin,
            {solid->planes.nx[face], solid->planes.ny[face], solid->planes.nz[face]}};
        double inside = INFINITY;
        for (uint32_t k = 0; k < p.count; k++)
            inside = fmin(inside, bent_side(solid, p, k, origin, direction));
        if (inside > best_inside) {
            best_inside = inside;
            best = p;
        }
    }
    return best;
}
