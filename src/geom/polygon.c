// polygon.c - cutting arbitrary polygons in space into triangles, mostly with GLU's tessellator.
#include "geom/polygon.h"

#include "base/hash.h"
#include "geom/outline.h"
#include "geom/polygon_flips.h"
#include "geom/polygon_gaps.h"

#include <GL/glu.h>
#include <stdlib.h>

// GLU takes some seconds for as many, and n sides may have n^2 / 2.
enum { CROSSINGS_MOST = 200000 };
// More are first tried another way.
enum { CORNERS_MANY = 4096 };

struct polygon_cutter {
    GLUtesselator *tess;
    struct mesh_builder *mesh; // of the polygon at work
    uint32_t *corners;         // its corners without repetitions
    uint32_t corner_count, corner_room;
    uint32_t (*triangles)[3]; // its result
    uint32_t triangle_count, triangle_room;
    uint32_t pending[3], pending_count;
    bool bent;
    bool crossed; // itself, or touched: there are new vertices
    bool failed;
};

// Corner numbers travel through GLU as pointers.
static void *number_in(uint32_t i)
{
    return (void *)(uintptr_t)i;
}

static void GLAPIENTRY on_begin(GLenum type, void *user)
{
    struct polygon_cutter *c = user;
    c->pending_count = 0;
    c->failed |= type != GL_TRIANGLES;
}

static void GLAPIENTRY on_vertex(void *vertex, void *user)
{
    struct polygon_cutter *c = user;
    c->pending[c->pending_count++] = (uint32_t)(uintptr_t)vertex;
    if (c->pending_count < 3)
        return;
    c->pending_count = 0;
    array_reserve(&c->triangles, &c->triangle_room, (size_t)c->triangle_count + 1);
    for (int i = 0; i < 3; i++)
        c->triangles[c->triangle_count][i] = c->pending[i];
    c->triangle_count++;
}

// Asked for so that GLU gives single triangles, no strips and fans.
static void GLAPIENTRY on_edge_flag(GLboolean flag, void *user)
{
    (void)flag;
    (void)user;
}

static void GLAPIENTRY on_combine(GLdouble at[3], void *vertices[4], GLfloat weight[4], void **out,
                                  void *user)
{
    (void)weight;
    struct polygon_cutter *c = user;
    c->crossed = true;
    if (c->bent && !vertices[2]) // corners in one place only seen from there
        *out = vertices[0];
    else
        *out = number_in(mesh_add_vertex(c->mesh, (struct vec3){at[0], at[1], at[2]}));
}

static void GLAPIENTRY on_error(GLenum code, void *user)
{
    (void)code;
    struct polygon_cutter *c = user;
    c->failed = true;
}

struct polygon_cutter *polygon_cutter_new(void)
{
    struct polygon_cutter *c = mem_zalloc(sizeof *c);
    c->tess = gluNewTess();
    if (!c->tess)
        return c; // out of memory: polygon_cut then refuses
    gluTessProperty(c->tess, GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
    gluTessCallback(c->tess, GLU_TESS_BEGIN_DATA, (_GLUfuncptr)on_begin);
    gluTessCallback(c->tess, GLU_TESS_VERTEX_DATA, (_GLUfuncptr)on_vertex);
    gluTessCallback(c->tess, GLU_TESS_EDGE_FLAG_DATA, (_GLUfuncptr)on_edge_flag);
    gluTessCallback(c->tess, GLU_TESS_COMBINE_DATA, (_GLUfuncptr)on_combine);
    gluTessCallback(c->tess, GLU_TESS_ERROR_DATA, (_GLUfuncptr)on_error);
    return c;
}

void polygon_cutter_delete(struct polygon_cutter *c)
{
    if (!c)
        return;
    if (c->tess)
        gluDeleteTess(c->tess);
    free(c->corners);
    free(c->triangles);
    free(c);
}

static bool same_place(struct vec3 a, struct vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void collect_corners(struct polygon_cutter *c, const uint32_t *corners, uint32_t count)
{
    const struct vec3 *v = c->mesh->mesh.vertices;
    array_reserve(&c->corners, &c->corner_room, count);
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++)
        if (!n || !same_place(v[corners[i]], v[c->corners[n - 1]]))
            c->corners[n++] = corners[i];
    while (n > 1 && same_place(v[c->corners[0]], v[c->corners[n - 1]]))
        n--;
    c->corner_count = n;
}

static struct vec3 corner(const struct polygon_cutter *c, uint32_t i)
{
    return c->mesh->mesh.vertices[c->corners[i]];
}

// Newell's normal, not normalised: twice the area in the plane that fits best.
static struct vec3 fitted_normal(const struct polygon_cutter *c)
{
    struct vec3 o = corner(c, 0), sum = {0};
    for (uint32_t i = 2; i < c->corner_count; i++)
        sum = vec3_add(sum, vec3_cross(vec3_sub(corner(c, i - 1), o), vec3_sub(corner(c, i), o)));
    return sum;
}

// Exported numbers have six digits: what was flat arrives bent by up to 1e-5 of its coordinates.
static bool is_flat(const struct polygon_cutter *c, struct vec3 unit_normal)
{
    double low = INFINITY, high = -INFINITY, largest = 0;
    for (uint32_t i = 0; i < c->corner_count; i++) {
        struct vec3 p = corner(c, i);
        double d = vec3_dot(unit_normal, p);
        low = fmin(low, d);
        high = fmax(high, d);
        largest = fmax(largest, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
    }
    return high - low <= 1e-5 * largest;
}

// Does the quad look convex along the normal?
static bool is_convex_quad(const struct polygon_cutter *c, struct vec3 normal)
{
    for (uint32_t i = 0; i < 4; i++) {
        struct vec3 p = corner(c, i), in = vec3_sub(p, corner(c, (i + 3) % 4));
        if (!(vec3_dot(normal, vec3_cross(in, vec3_sub(corner(c, (i + 1) % 4), p))) > 0))
            return false;
    }
    return true;
}

static void cut_fan(struct polygon_cutter *c)
{
    array_reserve(&c->triangles, &c->triangle_room, c->corner_count);
    for (uint32_t i = 2; i < c->corner_count; i++) {
        uint32_t *t = c->triangles[c->triangle_count++];
        t[0] = c->corners[0];
        t[1] = c->corners[i - 1];
        t[2] = c->corners[i];
    }
}

// Positive where p lies to the left of side i, seen against the normal.
static double left_of(const struct polygon_cutter *c, struct vec3 normal, uint32_t i, struct vec3 p)
{
    struct vec3 a = corner(c, i), b = corner(c, (i + 1) % c->corner_count);
    return vec3_dot(normal, vec3_cross(vec3_sub(b, a), vec3_sub(p, a)));
}

static bool sides_cross(const struct polygon_cutter *c, struct vec3 normal, uint32_t i, uint32_t k)
{
    uint32_t n = c->corner_count;
    return left_of(c, normal, i, corner(c, k)) * left_of(c, normal, i, corner(c, (k + 1) % n)) <
               0 &&
           left_of(c, normal, k, corner(c, i)) * left_of(c, normal, k, corner(c, (i + 1) % n)) < 0;
}

// By a sample: each side against one other.
static bool crosses_too_often(const struct polygon_cutter *c, struct vec3 normal)
{
    double n = c->corner_count, pairs = n * n / 2;
    if (pairs <= CROSSINGS_MOST)
        return false;
    uint64_t random = 0;
    uint32_t hits = 0;
    for (uint32_t i = 0; i < c->corner_count; i++) {
        uint32_t other = (uint32_t)(random_next(&random) % c->corner_count);
        hits += sides_cross(c, normal, i, other);
    }
    return pairs * hits / n > CROSSINGS_MOST;
}

// Seen along the main axis of the normal. GLU's time grows with the square of the corners.
static bool cut_large(struct polygon_cutter *c, struct vec3 normal)
{
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    struct outline o = {0};
    for (uint32_t i = 0; i < c->corner_count; i++) {
        struct vec3 p = corner(c, i);
        outline_add(&o, x >= y && x >= z ? (struct vec2){p.y, p.z}
                        : y >= z         ? (struct vec2){p.z, p.x}
                                         : (struct vec2){p.x, p.y});
    }
    outline_close(&o);
    uint32_t(*triangles)[3], count;
    bool done = outline_try_triangulate(&o, &triangles, &count);
    outline_free(&o);
    if (!done)
        return false;
    array_reserve(&c->triangles, &c->triangle_room, count);
    for (uint32_t t = 0; t < count; t++)
        for (int i = 0; i < 3; i++)
            c->triangles[t][i] = c->corners[triangles[t][i]];
    c->triangle_count = count;
    free(triangles);
    return true;
}

static void tessellate(struct polygon_cutter *c, struct vec3 normal)
{
    gluTessNormal(c->tess, normal.x, normal.y, normal.z);
    gluTessBeginPolygon(c->tess, c);
    gluTessBeginContour(c->tess);
    for (uint32_t i = 0; i < c->corner_count; i++) {
        struct vec3 p = corner(c, i);
        GLdouble at[3] = {p.x, p.y, p.z};
        gluTessVertex(c->tess, at, number_in(c->corners[i]));
    }
    gluTessEndContour(c->tess);
    gluTessEndPolygon(c->tess);
}

// The diagonals of a bent polygon decide its shape: they are OpenSCAD's.
static void cut_bent(struct polygon_cutter *c)
{
    struct mesh *m = &c->mesh->mesh;
    uint32_t first_new = m->vertex_count;
    double sign;
    uint32_t axis = polygon_axis(m->vertices, c->corners, c->corner_count, &sign);
    c->bent = true;
    tessellate(c, (struct vec3){axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0});
    polygon_flip(m->vertices, axis, c->triangles, c->triangle_count);
    // Corners between others, seen from there, are in no triangle.
    if (c->failed || (!c->crossed && c->triangle_count + 2 == c->corner_count))
        return;
    array_reserve(&c->triangles, &c->triangle_room,
                  4 * (size_t)c->triangle_count + c->corner_count);
    polygon_fill_gaps(m->vertices, c->corners, c->corner_count, first_new, c->triangles,
                      &c->triangle_count);
    m->vertex_count = first_new;
}

static void cut_any(struct polygon_cutter *c, struct vec3 unit_normal, bool flat)
{
    if (c->corner_count > CORNERS_MANY && cut_large(c, unit_normal))
        return;
    if (!c->tess || crosses_too_often(c, unit_normal))
        c->failed = true;
    else if (flat)
        tessellate(c, unit_normal);
    else
        cut_bent(c);
}

bool polygon_cut(struct polygon_cutter *c, struct mesh_builder *b, const uint32_t *corners,
                 uint32_t count)
{
    c->mesh = b;
    c->triangle_count = 0;
    c->bent = c->crossed = c->failed = false;
    collect_corners(c, corners, count);
    if (c->corner_count < 3)
        return false;

    struct vec3 normal = vec3_normalized(fitted_normal(c));
    // Polygons without area are kept as they are: they close the seams between their neighbours.
    bool area = vec3_dot(normal, normal) > 0.5; // false also for NaN
    bool flat = !area || is_flat(c, normal);
    if (c->corner_count == 3 || !area ||
        (flat && c->corner_count == 4 && is_convex_quad(c, normal)))
        cut_fan(c);
    else
        cut_any(c, normal, flat);
    if (c->failed || !c->triangle_count)
        return false;

    uint32_t face = 0;
    for (uint32_t t = 0; t < c->triangle_count; t++) {
        if (t == 0 || !flat)
            face = mesh_add_face(b);
        mesh_add_triangle(b, c->triangles[t][0], c->triangles[t][1], c->triangles[t][2], face);
    }
    return true;
}

bool polygon_failed(const struct polygon_cutter *c)
{
    return c->failed;
}
