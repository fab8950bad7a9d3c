// wire_points.c - vertices: where three planes meet between four pixels. As by OpenGL one takes ten
// by ten.
#include "render/wire_rows.h"

enum { POINT = 10 };    // pixels
#define OUTSIDE     1.0 // pixels
#define FAR_OUTSIDE 3.0
#define NEARBY      1e-6   // of a solid's extent: rounding
enum { PLANES_MOST = 24 }; // that meet in a corner between four pixels; more are not looked at

// OpenSCAD's colours of vertices.
static const struct rgb point_front = {255, 246, 124}, point_back = {183, 232, 92};

static void draw_point(const struct wires *w, bool back, double x, double y, double weight)
{
    int x0 = (int)ceil(x - POINT / 2.0), y0 = (int)ceil(y - POINT / 2.0);
    for (int i = 0; i < POINT * POINT; i++)
        wire_put(w, back ? point_back : point_front, x0 + i % POINT, y0 + i / POINT, weight);
}

// Between four pixels, or so little outside that no ray between sees all that meets there.
static bool in_corner(double px, double py, int x, int y, double outside)
{
    return fabs(px - x - 0.5) <= 0.5 + outside && fabs(py - y - 0.5) <= 0.5 + outside;
}

static bool on_convex(const struct leaf *leaf, struct vec3 p)
{
    const struct planes *planes = &leaf->solid->planes;
    struct box b = leaf->solid->bounds;
    double nearby = NEARBY * vec3_length(vec3_sub(b.max, b.min));
    bool inside = leaf->solid->convex;
    p = affine_point(&leaf->to_local, p);
    for (uint32_t i = 0; i < planes->count && inside; i++)
        inside = planes->nx[i] * p.x + planes->ny[i] * p.y + planes->nz[i] * p.z <=
                 planes->d[i] + nearby;
    return inside;
}

// Where three planes meet. Further outside only where it is known that the faces reach to there.
static void draw_meeting(const struct wires *w, const struct surface *const s[3], int x, int y)
{
    const struct surface *a = s[0], *b = s[1], *c = s[2];
    double abx = a->wx - b->wx, aby = a->wy - b->wy, ab = a->w0 - b->w0;
    double acx = a->wx - c->wx, acy = a->wy - c->wy, ac = a->w0 - c->w0;
    double det = abx * acy - aby * acx;
    double px = (aby * ac - acy * ab) / det, py = (acx * ab - abx * ac) / det;
    if (!in_corner(px, py, x, y, FAR_OUTSIDE))
        return;
    bool meet = in_corner(px, py, x, y, OUTSIDE);
    if (!meet) {
        struct vec3 p = wire_place(w, a, px, py);
        meet = true;
        for (int i = 0; i < 3; i++)
            meet = meet && on_convex(&w->body->leaves[s[i]->leaf], p);
    }
    if (meet)
        draw_point(w, a->back || b->back || c->back, px, py, wire_weight(a, px, py));
}

// Planes around a corner between four pixels.
struct meeting {
    const struct surface *planes[PLANES_MOST];
    struct vec3 places[PLANES_MOST]; // of the world, where each was seen first
    int seen[PLANES_MOST];           // in how many of the pixels
    uint32_t count;
};

static void gather(const struct wires *w, const struct row rows[2], int x, int y,
                   struct meeting *out)
{
    out->count = 0;
    for (int i = 0; i < 4; i++) {
        struct list l = wire_row_at(&rows[i / 2], x + i % 2);
        for (uint32_t k = 0; k < l.count; k++) {
            uint32_t p = 0;
            while (p < out->count && !wire_same_plane(w, out->planes[p], &l.items[k], x, y))
                p++;
            if (p == PLANES_MOST)
                continue;
            if (p == out->count) {
                out->planes[out->count] = &l.items[k];
                out->places[out->count] = wire_place(w, &l.items[k], x + i % 2, y + i / 2);
                out->seen[out->count++] = 0;
            }
            out->seen[p]++;
        }
    }
}

static double above(const struct wires *w, const struct surface *plane, struct vec3 p)
{
    struct vec3 on = plane->facet.corners[0];
    on = affine_point(&w->body->leaves[plane->leaf].to_world, on);
    return vec3_dot(plane->normal, vec3_sub(p, on));
}

static bool parts(const struct wires *w, const struct surface *plane, struct vec3 p, struct vec3 q)
{
    double a = above(w, plane, p), b = above(w, plane, q);
    return fabs(a) > w->tolerance && fabs(b) > w->tolerance && (a < 0) != (b < 0);
}

// A point of a leaf, unless the planes of other leaves end it before it comes to there from where
// a face of it is seen.
static void draw_near(const struct wires *w, const struct meeting *m, uint32_t face, bool back,
                      struct vec3 p, int x, int y)
{
    struct vec3 place = rays_place(w->rays, p);
    bool shows = in_corner(place.x, place.y, x, y, OUTSIDE);
    for (uint32_t i = 0; i < m->count && shows; i++)
        shows = m->planes[i]->leaf == m->planes[face]->leaf ||
                !parts(w, m->planes[i], m->places[face], p);
    if (shows)
        draw_point(w, back, place.x, place.y, w->rays->orthographic ? place.z : 1 / place.z);
}

// The corners of a bent face's part, and where the edges that they are the ends of go through
// planes: what lies behind such an edge may be too steep to be seen.
static void draw_bent(const struct wires *w, const struct meeting *m, uint32_t face, int x, int y)
{
    const struct surface *a = m->planes[face];
    const struct leaf *leaf = &w->body->leaves[a->leaf];
    const struct vec3 *vertices = leaf->solid->mesh.vertices;
    for (uint32_t i = 0; i < a->part.count; i++) {
        uint32_t count;
        const uint32_t *ends = bent_edges(w->bent, a->leaf, a->part.corners[i], &count);
        struct vec3 from = affine_point(&leaf->to_world, vertices[a->part.corners[i]]);
        draw_near(w, m, face, a->back, from, x, y);
        for (uint32_t e = 0; e < count; e++) {
            struct vec3 to = affine_point(&leaf->to_world, vertices[ends[e]]);
            for (uint32_t k = 0; k < m->count; k++) {
                const struct surface *o = m->planes[k];
                if (o->leaf == a->leaf || !parts(w, o, from, to))
                    continue;
                double before = above(w, o, from), behind = above(w, o, to);
                struct vec3 along = vec3_scale(vec3_sub(to, from), before / (before - behind));
                draw_near(w, m, face, a->back || o->back, vec3_add(from, along), x, y);
            }
        }
    }
}

// Planes along all rays of an orthographic view are never met. There a vertex is where a plane ends
// in two directions and a corner of a face shows.
static void draw_seen_along(const struct wires *w, const struct meeting *m, int x, int y)
{
    for (uint32_t i = 0; i < m->count; i++) {
        const struct facet *f = &m->planes[i]->facet;
        const struct affine *to_world = &w->body->leaves[m->planes[i]->leaf].to_world;
        for (int k = f->edge[1] || f->edge[2] ? 0 : 1; k < 3; k++) { // a fan's centre is none
            struct vec3 place = rays_place(w->rays, affine_point(to_world, f->corners[k]));
            for (uint32_t p = 0; p < m->count && in_corner(place.x, place.y, x, y, OUTSIDE); p++)
                if (m->seen[p] % 2)
                    draw_point(w, m->planes[p]->back || m->planes[i]->back, place.x, place.y,
                               wire_weight(m->planes[p], place.x, place.y));
        }
    }
}

// Vertices between the middles of four pixels, of the planes that are seen there.
void wire_points_draw(const struct wires *w, const struct row rows[2], int x, int y)
{
    struct meeting m;
    gather(w, rows, x, y, &m);
    for (uint32_t i = 0; i < m.count && m.count > 1; i++) {
        if (m.planes[i]->part.count)
            draw_bent(w, &m, i, x, y);
        for (uint32_t j = i + 1; j < m.count; j++)
            for (uint32_t k = j + 1; k < m.count; k++)
                draw_meeting(w, (const struct surface *[]){m.planes[i], m.planes[j], m.planes[k]},
                             x, y);
    }
    if (w->rays->orthographic)
        draw_seen_along(w, &m, x, y);
}
