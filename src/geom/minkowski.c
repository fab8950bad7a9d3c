// minkowski.c - the Minkowski sum of two solids as a union of simple ones.
//
// Both solids are unions of bodies, and the sum of unions is the union of the sums. For bodies A
// and B a point p is in their sum when A meets p - B. Points of a dense set will do, for the sum is
// closed: so the surfaces of A and p - B may be taken to cross cleanly or not at all. Neither p nor
// the parts need be exact at places where faces touch.
//
// Two convex bodies: one hull.
//
// A convex, B not: a path in A leads from any of its points to the anchor a; either B + a holds p,
// or the path, taken off p, crosses the surface of B: then p is in the sum of A and a face of B.
//
// Neither convex: when the surfaces of A and p - B do not meet, one of them holds the other, so p
// is in A + b or B + a for the anchors a, b. Otherwise they meet in closed lines. The highest point
// of such a line along a direction `up` is where an edge of one pierces a face of the other, and
// from it the line descends on the faces of both sides of the edge. Whether it does so follows from
// the normals of the three faces: of all pairs of an edge and a face only these are parts.
#include "geom/minkowski.h"

#include "base/mem.h"
#include "base/parallel.h"
#include "geom/mesh.h"
#include "geom/minkowski_body.h"

#include <stdlib.h>

// In no plane or direction that models prefer: then no line of a crossing runs level.
static const struct vec3 up = {0.2718281828, 0.5772156649, 0.7703};

enum { PAIRS_MOST = 1 << 30 }; // what is looked through in a few seconds

enum job_kind { JOB_CONVEX, JOB_SWEEP, JOB_PRISM, JOB_COPY };

// What becomes a part: a and b whole; piece i of `a` with convex b; edge i of `a` with piece k of
// b; `a` moved to vertex i of b.
struct job {
    enum job_kind kind;
    uint32_t i, k;
    const struct body *a, *b;
};

struct jobs {
    struct job *items;
    uint32_t count, room, most;
    bool failed;
    struct minkowski_part *parts;
};

static void add_job(struct jobs *j, struct job job)
{
    if (j->count >= j->most)
        j->failed = true;
    if (j->failed)
        return;
    array_reserve(&j->items, &j->room, (size_t)j->count + 1);
    j->items[j->count++] = job;
}

static void add_copies(struct jobs *j, const struct body *a, const struct body *b)
{
    if (!body_may_hold(a, b))
        return;
    for (uint32_t i = 0; i < b->anchor_count; i++)
        add_job(j, (struct job){.kind = JOB_COPY, .a = a, .b = b, .i = b->anchors[i]});
}

static void add_sweeps(struct jobs *j, const struct body *a, const struct body *convex)
{
    for (uint32_t i = 0; i < a->piece_count; i++)
        add_job(j, (struct job){.kind = JOB_SWEEP, .a = a, .b = convex, .i = i});
    add_copies(j, a, convex);
}

// Pieces of faces that are one up to rounding have one normal: signs within that are in doubt.
#define DOUBT 2e-6

// The line in which a face with normal n and one with normal g meet runs along n x g. Leaving the
// first face through its edge e, of which it lies to the left, is the sense in which it goes along
// e x n; (n x g) . (e x n) = -(g . e), since n is a unit vector and upright to e. The line climbs
// that way when -sign(g . e) (n x g) . up = -sign(g . e) g . (up x n) is not below 0; on the other
// side of the edge e is reversed.
static bool may_peak(const struct body_edge *e, struct vec3 along, struct vec3 upward,
                     struct vec3 g)
{
    double across = vec3_dot(g, along);
    if (fabs(across) < 1e-12) // no volume
        return false;
    double s = across < 0 ? -1 : 1;
    return e->loose || (-s * vec3_dot(g, vec3_cross(upward, e->normals[0])) >= -DOUBT &&
                        s * vec3_dot(g, vec3_cross(upward, e->normals[1])) >= -DOUBT);
}

static void add_prisms(struct jobs *j, const struct body *a, const struct body *b,
                       struct vec3 upward)
{
    for (uint32_t i = 0; i < a->edge_count; i++) {
        const struct body_edge *e = &a->edges[i];
        struct vec3 along =
            vec3_normalized(vec3_sub(a->mesh.vertices[e->v[1]], a->mesh.vertices[e->v[0]]));
        for (uint32_t k = 0; k < b->piece_count && !j->failed; k++)
            if (may_peak(e, along, upward, b->pieces[k].normal))
                add_job(j, (struct job){.kind = JOB_PRISM, .a = a, .b = b, .i = i, .k = k});
    }
}

static void add_pair(struct jobs *j, const struct body *a, const struct body *b)
{
    uint64_t pairs = a->convex && b->convex ? (uint64_t)a->mesh.vertex_count * b->mesh.vertex_count
                                            : (uint64_t)a->edge_count * b->piece_count +
                                                  (uint64_t)b->edge_count * a->piece_count;
    if (pairs > PAIRS_MOST) {
        j->failed = true;
    } else if (a->convex && b->convex) {
        add_job(j, (struct job){.kind = JOB_CONVEX, .a = a, .b = b});
    } else if (b->convex) {
        add_sweeps(j, a, b);
    } else if (a->convex) {
        add_sweeps(j, b, a);
    } else {
        // Seen from B, p - A takes the place of p - B, which turns up to down.
        add_prisms(j, a, b, up);
        add_prisms(j, b, a, vec3_scale(up, -1));
        add_copies(j, a, b);
        add_copies(j, b, a);
    }
}

static void make_sweep(struct minkowski_part *out, const struct body *a, uint32_t piece,
                       const struct body *convex)
{
    const struct body_piece *p = &a->pieces[piece];
    struct vec3 *points = mem_alloc((size_t)p->count * sizeof *points);
    for (uint32_t i = 0; i < p->count; i++)
        points[i] = a->mesh.vertices[a->corners[p->first + i]];
    struct corners c;
    corners_of_polygon(&c, points, p->count, p->normal);
    convex_sum(&out->mesh, &c, &convex->corners_of_convex);
    corners_free(&c);
    free(points);
}

static void make_prism(struct minkowski_part *out, const struct body *a, uint32_t edge,
                       const struct body *b, uint32_t piece)
{
    const struct body_piece *p = &b->pieces[piece];
    uint32_t n = p->count, *ring = mem_alloc((size_t)n * 2 * sizeof *ring);
    struct vec3 v0 = a->mesh.vertices[a->edges[edge].v[0]];
    struct vec3 v1 = a->mesh.vertices[a->edges[edge].v[1]];
    if (vec3_dot(p->normal, vec3_sub(v1, v0)) < 0) {
        struct vec3 swapped = v0;
        v0 = v1;
        v1 = swapped;
    }
    struct mesh_builder m = {0};
    for (uint32_t i = 0; i < n * 2; i++) {
        struct vec3 corner = b->mesh.vertices[b->corners[p->first + i % n]];
        mesh_add_vertex(&m, vec3_add(corner, i < n ? v0 : v1));
        ring[i] = i < n ? n - 1 - i : i;
    }
    mesh_add_convex(&m, ring, n);
    mesh_add_convex(&m, ring + n, n);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t k = (i + 1) % n;
        mesh_add_convex(&m, (uint32_t[]){i, k, n + k, n + i}, 4);
    }
    out->mesh = m.mesh;
    free(ring);
}

static void make_copy(struct minkowski_part *out, const struct body *a, struct vec3 by)
{
    struct mesh_builder m = {0};
    for (uint32_t v = 0; v < a->mesh.vertex_count; v++)
        mesh_add_vertex(&m, vec3_add(a->mesh.vertices[v], by));
    for (uint32_t t = 0; t < a->mesh.triangle_count; t++) {
        const uint32_t *c = a->mesh.triangles[t];
        mesh_add_triangle(&m, c[0], c[1], c[2], a->mesh.faces[t]);
    }
    m.mesh.face_count = a->mesh.face_count;
    out->mesh = m.mesh;
}

static void make_part(void *context, uint32_t item, uint32_t worker)
{
    (void)worker;
    struct jobs *j = context;
    const struct job *job = &j->items[item];
    struct minkowski_part *out = &j->parts[item];
    *out = (struct minkowski_part){.convex = job->kind != JOB_COPY};
    if (job->kind == JOB_CONVEX)
        convex_sum(&out->mesh, &job->a->corners_of_convex, &job->b->corners_of_convex);
    else if (job->kind == JOB_SWEEP)
        make_sweep(out, job->a, job->i, job->b);
    else if (job->kind == JOB_PRISM)
        make_prism(out, job->a, job->i, job->b, job->k);
    else
        make_copy(out, job->a, job->b->mesh.vertices[job->i]);
}

bool minkowski_parts(struct minkowski_sum *out, const struct solid *a, const struct solid *b,
                     uint32_t most, uint32_t threads)
{
    *out = (struct minkowski_sum){0};
    struct bodies of_a, of_b;
    struct jobs j = {.most = most};
    bodies_of_solid(&of_a, a);
    bodies_of_solid(&of_b, b);
    for (uint32_t i = 0; i < of_a.count && !j.failed; i++)
        for (uint32_t k = 0; k < of_b.count && !j.failed; k++)
            add_pair(&j, &of_a.items[i], &of_b.items[k]);
    if (!j.failed) {
        j.parts = mem_alloc((size_t)j.count * sizeof *j.parts);
        parallel_for(j.count, threads, make_part, &j);
        out->parts = j.parts;
        out->room = j.count;
        for (uint32_t i = 0; i < j.count; i++) // sums without volume give no mesh
            if (j.parts[i].mesh.triangle_count)
                out->parts[out->count++] = j.parts[i];
    }
    free(j.items);
    bodies_free(&of_b);
    bodies_free(&of_a);
    return !j.failed;
}

void minkowski_free(struct minkowski_sum *s)
{
    for (uint32_t i = 0; i < s->count; i++)
        mesh_free(&s->parts[i].mesh);
    free(s->parts);
    *s = (struct minkowski_sum){0};
}
