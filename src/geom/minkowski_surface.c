// minkowski_surface.c - the surface of a body as flat convex pieces, as large as may be, and edges.
#include "base/mem.h"
#include "geom/minkowski_body.h"

#include <stdlib.h>
#include <string.h>

#define STRAIGHT 1e-9 // sine of a turn that is none
#define FLAT     1e-6 // sine of the angle between faces that are one: coordinates are rounded

// Polygons as rings of sides of triangles; side h runs from corner h % 3 of triangle h / 3.
struct rings {
    const struct mesh *mesh;
    struct vec3 *normals; // of faces, unit vectors or zero
    uint32_t *twins, *next, *before;
    bool *gone;
};

static struct vec3 side_start(const struct rings *r, uint32_t h)
{
    return r->mesh->vertices[r->mesh->triangles[h / 3][h % 3]];
}

static struct vec3 side_normal(const struct rings *r, uint32_t h)
{
    return r->normals[r->mesh->faces[h / 3]];
}

// The sine of the turn from side g into side h.
static double turn(const struct rings *r, uint32_t g, uint32_t h)
{
    struct vec3 p = side_start(r, h);
    struct vec3 in = vec3_normalized(vec3_sub(p, side_start(r, g)));
    struct vec3 out = vec3_normalized(vec3_sub(side_start(r, r->next[h]), p));
    return vec3_dot(side_normal(r, h), vec3_cross(in, out));
}

static bool is_flat(const struct rings *r, uint32_t g, uint32_t h)
{
    struct vec3 n = side_normal(r, g), m = side_normal(r, h);
    return r->mesh->faces[g / 3] == r->mesh->faces[h / 3] ||
           (vec3_dot(n, m) > 0 && vec3_length(vec3_cross(n, m)) < FLAT);
}

// Two polygons become one across all sides between them that follow each other, when that has no
// dent at their ends.
static void merge(struct rings *r, uint32_t g)
{
    uint32_t h = r->twins[g];
    if (r->gone[g] || h == UINT32_MAX || h < g || !is_flat(r, g, h))
        return;
    uint32_t first = g, last = g;
    while (r->before[first] != last && r->twins[r->before[first]] == r->next[r->twins[first]])
        first = r->before[first];
    while (r->next[last] != first && r->twins[r->next[last]] == r->before[r->twins[last]])
        last = r->next[last];
    // A polygon with all of its sides at the other one folds onto it: no face, a flaw of the mesh.
    if (r->next[last] == first || r->next[r->twins[first]] == r->twins[last])
        return;
    uint32_t g0 = r->before[first], g1 = r->next[last];
    uint32_t h0 = r->before[r->twins[last]], h1 = r->next[r->twins[first]];
    if (turn(r, g0, h1) < -STRAIGHT || turn(r, h0, g1) < -STRAIGHT)
        return;
    for (uint32_t i = first; i != g1; i = r->next[i])
        r->gone[i] = r->gone[r->twins[i]] = true;
    r->next[g0] = h1;
    r->before[h1] = g0;
    r->next[h0] = g1;
    r->before[g1] = h0;
}

static void find_normals(struct rings *r)
{
    const struct mesh *m = r->mesh;
    memset(r->normals, 0, (size_t)m->face_count * sizeof *r->normals);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        struct vec3 a = m->vertices[m->triangles[t][0]], *n = &r->normals[m->faces[t]];
        *n = vec3_add(*n, vec3_cross(vec3_sub(m->vertices[m->triangles[t][1]], a),
                                     vec3_sub(m->vertices[m->triangles[t][2]], a)));
    }
    for (uint32_t f = 0; f < m->face_count; f++)
        r->normals[f] = vec3_normalized(r->normals[f]);
}

// The polygon of side h, without corners at which it goes straight on; its sides are gone then.
static void add_piece(struct body *b, struct rings *r, uint32_t h)
{
    uint32_t first = b->corner_count, at = h;
    struct vec3 normal = side_normal(r, h);
    do {
        r->gone[at] = true;
        if (turn(r, r->before[at], at) > STRAIGHT) {
            array_reserve(&b->corners, &b->corner_room, (size_t)b->corner_count + 1);
            b->corners[b->corner_count++] = r->mesh->triangles[at / 3][at % 3];
        }
        at = r->next[at];
    } while (at != h);
    if (b->corner_count - first < 3) { // without area: the pieces beside it hold it
        b->corner_count = first;
        return;
    }
    array_reserve(&b->pieces, &b->piece_room, (size_t)b->piece_count + 1);
    b->pieces[b->piece_count++] = (struct body_piece){first, b->corner_count - first, normal};
}

static void add_edge(struct body *b, const struct rings *r, uint32_t h)
{
    uint32_t twin = r->twins[h];
    bool loose = twin == UINT32_MAX;
    if (!loose && (twin < h || r->mesh->faces[h / 3] == r->mesh->faces[twin / 3]))
        return;
    array_reserve(&b->edges, &b->edge_room, (size_t)b->edge_count + 1);
    const uint32_t *c = r->mesh->triangles[h / 3];
    b->edges[b->edge_count++] = (struct body_edge){
        {c[h % 3], c[(h + 1) % 3]}, {side_normal(r, h), side_normal(r, loose ? h : twin)}, loose};
}

void body_cut_surface(struct body *b)
{
    uint32_t sides = b->mesh.triangle_count * 3;
    struct rings r = {
        .mesh = &b->mesh,
        .normals = mem_alloc((size_t)b->mesh.face_count * sizeof *r.normals),
        .twins = mem_alloc((size_t)sides * sizeof *r.twins),
        .next = mem_alloc((size_t)sides * sizeof *r.next),
        .before = mem_alloc((size_t)sides * sizeof *r.before),
        .gone = mem_zalloc((size_t)sides * sizeof *r.gone),
    };
    find_normals(&r);
    mesh_find_twins(&b->mesh, r.twins, NULL);
    for (uint32_t h = 0; h < sides; h++) {
        r.next[h] = h % 3 == 2 ? h - 2 : h + 1;
        r.before[h] = h % 3 ? h - 1 : h + 2;
    }
    for (uint32_t h = 0; h < sides; h++)
        add_edge(b, &r, h);
    for (uint32_t h = 0; h < sides; h++)
        merge(&r, h);
    for (uint32_t h = 0; h < sides; h++)
        if (!r.gone[h])
            add_piece(b, &r, h);
    free(r.gone);
    free(r.before);
    free(r.next);
    free(r.twins);
    free(r.normals);
}
