// hull.c - convex hulls in space, on the Qhull library.
#include "geom/hull.h"

#include "base/hash.h"
#include "base/mem.h"
#include "geom/hull_parts.h"
#include "geom/mesh.h"

#include <libqhull_r/qhull_ra.h>
#include <stdlib.h>
#include <string.h>

// About the first point and about 1 in size, so that rounding is relative to the extent. Scaling
// is by powers of two and thus exact. *noise is how far the rounding of the points themselves may
// have moved them.
static struct vec3 *normalized(const struct vec3 *points, uint32_t count, double *noise)
{
    double largest = 0;
    for (uint32_t i = 0; i < count; i++)
        largest =
            fmax(largest, fmax(fabs(points[i].x), fmax(fabs(points[i].y), fabs(points[i].z))));
    double scale = ldexp(1, -ilogb(largest) - 1), extent = 0;
    struct vec3 *out = mem_alloc(count * sizeof *out);
    for (uint32_t i = 0; i < count; i++) {
        struct vec3 p = vec3_sub(vec3_scale(points[i], scale), vec3_scale(points[0], scale));
        out[i] = p;
        extent = fmax(extent, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
    }
    scale = ldexp(1, -ilogb(extent));
    *noise = 1e-14 + fmin(0x1p-52 * scale, 1e-10);
    for (uint32_t i = 0; i < count; i++)
        out[i] = vec3_scale(out[i], scale);
    return out;
}

static void add_corner(struct hull_faces *f, uint32_t corner)
{
    array_reserve(&f->corners, &f->corner_room, (size_t)f->corner_count + 1);
    f->corners[f->corner_count++] = corner;
}

// The edges of a face of more than three corners come in any order: next[] holds where each corner
// goes on. False when they are not one ring.
static bool add_ring(struct hull_faces *f, qhT *qh, const facetT *facet, uint32_t *next)
{
    ridgeT *ridge, **ridgep;
    uint32_t edges = 0, first = 0;
    FOREACHridge_(facet->ridges)
    {
        uint32_t a = (uint32_t)qh_pointid(qh, SETfirstt_(ridge->vertices, vertexT)->point);
        uint32_t b = (uint32_t)qh_pointid(qh, SETsecondt_(ridge->vertices, vertexT)->point);
        first = ridge->top == facet ? b : a;
        next[first] = ridge->top == facet ? a : b;
        edges++;
    }
    uint32_t at = first;
    for (uint32_t i = 0; i < edges; i++) {
        add_corner(f, at);
        at = next[at];
        if ((at == first) != (i + 1 == edges))
            return false;
    }
    return edges >= 3;
}

static bool add_faces(struct hull_faces *f, qhT *qh, uint32_t count)
{
    uint32_t *next = mem_zalloc((size_t)count * sizeof *next);
    facetT *facet;
    bool ok = true;
    FORALLfacet_(qh->facet_list)
    {
        if (facet->simplicial) {
            vertexT *vertex, **vertexp;
            uint32_t from = f->corner_count;
            FOREACHvertex_(facet->vertices) add_corner(f, (uint32_t)qh_pointid(qh, vertex->point));
            if (facet->toporient) {
                uint32_t swapped = f->corners[from];
                f->corners[from] = f->corners[from + 1];
                f->corners[from + 1] = swapped;
            }
        } else {
            ok = ok && add_ring(f, qh, facet, next);
        }
        array_reserve(&f->ends, &f->face_room, (size_t)f->face_count + 1);
        f->ends[f->face_count++] = f->corner_count;
    }
    free(next);
    return ok;
}

// What is done about points that are in one plane but for rounding: the library merges faces as it
// goes on, which takes the square of the corners of a face; it moves the points by no more than
// rounding does, and the triangles stay; or they are put together afterwards.
enum way { MERGE, MOVE, MOVE_AND_MERGE };

// The library reports through longjmp inside of its call and on a stream, which must not be
// stderr.
static bool hull_large(struct hull_faces *out, const struct vec3 *points, uint32_t count,
                       enum way way)
{
    FILE *nowhere = fopencookie(NULL, "w", (cookie_io_functions_t){0});
    if (!nowhere)
        return false;
    double noise;
    struct vec3 *places = normalized(points, count, &noise);
    struct hull_faces triangles = {0}, *found = way == MOVE_AND_MERGE ? &triangles : out;
    char options[32];
    snprintf(options, sizeof options, way == MERGE ? "qhull Pp E%.3g" : "qhull Pp QJ", noise);
    qhT *qh = mem_alloc(sizeof *qh);
    qh_zero(qh, nowhere);
    bool ok = !qh_new_qhull(qh, 3, (int)count, &places->x, False, options, NULL, nowhere) &&
              add_faces(found, qh, count);
    qh_freeqhull(qh, !qh_ALL);
    int blocks, bytes;
    qh_memfreeshort(qh, &blocks, &bytes);
    free(qh);
    if (way == MOVE_AND_MERGE)
        ok = ok && hull_merge(out, &triangles, places, count, 4 * noise);
    free(triangles.corners);
    free(triangles.ends);
    free(places);
    fclose(nowhere);
    return ok;
}

// Would a face have thousands of corners? Told by the hull of some of the points.
static bool has_round_faces(const struct vec3 *points, uint32_t count)
{
    enum { SAMPLE = 1024, CORNERS_FEW = 2000 };
    if (count <= 2 * CORNERS_FEW)
        return false;
    struct vec3 *some = mem_alloc(SAMPLE * sizeof *some);
    struct hull_faces f = {0};
    uint64_t random = 0;
    uint32_t most = 0;
    for (uint32_t i = 0; i < SAMPLE; i++)
        some[i] = points[random_next(&random) % count];
    if (hull_large(&f, some, SAMPLE, MERGE))
        for (uint32_t i = 0, from = 0; i < f.face_count; from = f.ends[i++])
            most = f.ends[i] - from > most ? f.ends[i] - from : most;
    free(some);
    free(f.corners);
    free(f.ends);
    return most > 12 && (double)most * count / SAMPLE > CORNERS_FEW;
}

// Corners of only two faces lie within an edge.
static bool drop_straight(struct hull_faces *f, uint32_t *uses)
{
    for (uint32_t i = 0; i < f->corner_count; i++)
        uses[f->corners[i]]++;
    uint32_t kept = 0, at = 0;
    for (uint32_t i = 0; i < f->face_count; i++) {
        uint32_t first = kept;
        for (; at < f->ends[i]; at++)
            if (uses[f->corners[at]] > 2)
                f->corners[kept++] = f->corners[at];
        f->ends[i] = kept;
        if (kept - first < 3)
            return false;
    }
    f->corner_count = kept;
    return true;
}

static void to_mesh(struct mesh *out, const struct hull_faces *f, const struct vec3 *points,
                    uint32_t count, const uint32_t *uses)
{
    struct mesh_builder b = {0};
    uint32_t *number = mem_alloc((size_t)count * sizeof *number);
    uint32_t *corners = mem_alloc((size_t)f->corner_count * sizeof *corners);
    for (uint32_t i = 0; i < count; i++)
        if (uses[i] > 2)
            number[i] = mesh_add_vertex(&b, points[i]);
    for (uint32_t i = 0; i < f->corner_count; i++)
        corners[i] = number[f->corners[i]];
    for (uint32_t i = 0, from = 0; i < f->face_count; from = f->ends[i++])
        mesh_add_convex(&b, corners + from, f->ends[i] - from);
    *out = b.mesh;
    free(corners);
    free(number);
}

bool hull_solid(struct mesh *out, const struct vec3 *points, uint32_t count)
{
    *out = (struct mesh){0};
    if (count < 4 || count > INT32_MAX / 3 || hull_span(points, count).rank < 3)
        return false;
    struct hull_faces f = {0};
    uint32_t *uses = mem_zalloc((size_t)count * sizeof *uses);
    bool ok = count <= HULL_SMALL && hull_small(&f, points, count) && drop_straight(&f, uses);
    // Where merging of nearly flat faces fails, points moved by less than rounding still tell the
    // corners.
    bool round = !ok && has_round_faces(points, count);
    const enum way ways[] = {MOVE_AND_MERGE, MERGE, MOVE};
    for (uint32_t i = !round; !ok && i < array_count(ways); i++) {
        f.corner_count = f.face_count = 0;
        memset(uses, 0, (size_t)count * sizeof *uses);
        ok = hull_large(&f, points, count, ways[i]) && drop_straight(&f, uses);
    }
    if (ok)
        to_mesh(out, &f, points, count, uses);
    free(uses);
    free(f.corners);
    free(f.ends);
    return ok;
}
