// wires.c - the edges and vertices of what a boolean leaves, as lines and points.
//
// The picture is taken in bands of rows, with all solid intervals of each ray. Each end of one lies
// in a plane, whose weight (the inverse depth, in orthographic views the depth) is an affine
// function of the pixel. Where a plane ends between two pixels, the edge is where its weight is
// that of another plane there. As by OpenGL an edge takes five pixels of each row or column,
// whichever it crosses more steeply; a vertex, where three planes meet, takes ten by ten.
#include "render/wires.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

enum { BAND = 64 };            // rows
enum { EDGE = 5, POINT = 10 }; // pixels
#define OUTSIDE 1.0            // pixels
enum { PLANES_MOST = 24 };     // that meet in a corner between four pixels; more are not looked at

// OpenSCAD's colours of vertices.
static const struct rgb point_front = {255, 246, 124}, point_back = {183, 232, 92};

// A surface of the result at a pixel.
struct surface {
    uint32_t leaf, face;
    struct facet facet; // in the solid's coordinates
    struct vec3 normal; // unit, in the world
    double w0, wx, wy;  // its plane's weight at (0, 0) of the picture and per pixel
    bool parted;        // its face is seen as triangles
    bool back;          // made by what is taken away
};

struct pixel {
    const struct span *spans; // of the rays
    uint32_t span_count;
    struct span *block; // of the first pixel of a block: where its spans are
};

struct row {
    struct surface *surfaces;
    uint32_t room;
    uint32_t *first; // of each pixel, and the end of the last
};

struct wires {
    const struct canvas *canvas;
    const struct body *body;
    const struct scheme *scheme;
    const struct facets *facets;
    const struct rays *rays; // of the picture
    double tolerance;        // depths within it are equal
    struct pixel *pixels;    // of the band
    int band, width;         // first row
};

static double depth_of(const struct wires *w, double weight)
{
    return w->rays->orthographic ? weight : 1 / weight;
}

static double weight_at(const struct surface *s, double x, double y)
{
    return s->w0 + s->wx * x + s->wy * y;
}

static void put(const struct wires *w, struct rgb colour, int x, int y, double weight)
{
    const struct canvas *c = w->canvas;
    if (x < 0 || y < 0 || x >= c->width || y >= c->height)
        return;
    size_t i = (size_t)y * (size_t)c->width + (size_t)x;
    double depth = depth_of(w, weight) - w->rays->reference;
    if (!(depth < (double)c->depth[i] - w->tolerance)) // what lies in a face does not show
        return;
    c->depth[i] = (float)depth;
    memcpy(c->rgb + 3 * i, &colour, 3);
}

static void keep_spans(void *context, uint32_t worker, const struct span_block *block)
{
    (void)worker;
    const struct wires *w = context;
    uint32_t n = (uint32_t)((block->x1 - block->x0) * (block->y1 - block->y0));
    uint32_t first = block->first[0], count = block->first[n] - first, i = 0;
    struct span *copy = mem_alloc((count + 1) * sizeof *copy);
    if (count)
        memcpy(copy, block->spans + first, count * sizeof *copy);
    for (int y = block->y0; y < block->y1; y++)
        for (int x = block->x0; x < block->x1; x++, i++)
            w->pixels[(size_t)y * (size_t)w->width + (size_t)x] =
                (struct pixel){copy + (block->first[i] - first),
                               block->first[i + 1] - block->first[i], i ? NULL : copy};
}

static bool make_surface(const struct wires *w, uint32_t leaf, uint32_t face, int x, int y,
                         struct surface *out)
{
    const struct rays *r = w->rays;
    const struct leaf *placed = &w->body->leaves[leaf];
    struct vec3 origin = affine_point(&placed->to_local, rays_origin(r, x, y));
    struct vec3 direction = affine_vector(&placed->to_local, rays_direction(r, x, y));
    if (!facets_find(w->facets, placed->solid, face, origin, direction, &out->facet))
        return false;
    out->leaf = leaf;
    out->face = face;
    out->back = placed->subtracted;
    out->parted = placed->solid->cut == CUT_CAPS && out->facet.edge[1];
    struct vec3 n = vec3_normalized(affine_normal(&placed->to_local, out->facet.normal));
    out->normal = n;
    struct vec3 corner = affine_point(&placed->to_world, out->facet.corners[0]);
    double away = vec3_dot(n, vec3_sub(corner, r->origin));
    double sx = vec3_dot(n, r->step_x), sy = vec3_dot(n, r->step_y), f = vec3_dot(n, r->forward);
    if (r->orthographic) {
        out->w0 = away / f;
        out->wx = -sx / f;
        out->wy = -sy / f;
    } else {
        out->w0 = f / away;
        out->wx = sx / away;
        out->wy = sy / away;
    }
    return isfinite(out->w0 + out->wx + out->wy);
}

static void fill_row(const struct wires *w, struct row *row, int y)
{
    uint32_t count = 0;
    for (int x = 0; x < w->width; x++) {
        const struct pixel *p = &w->pixels[(size_t)(y - w->band) * (size_t)w->width + (size_t)x];
        row->first[x] = count;
        array_reserve(&row->surfaces, &row->room, count + 2 * (size_t)p->span_count + 1);
        for (uint32_t k = 0; k < p->span_count; k++) {
            const struct span *s = &p->spans[k];
            if (s->enter_face != SURFACE_CAP)
                count += make_surface(w, s->enter_leaf, s->enter_face, x, y, &row->surfaces[count]);
            if (s->leave_leaf != SURFACE_NONE)
                count += make_surface(w, s->leave_leaf, s->leave_face, x, y, &row->surfaces[count]);
        }
    }
    row->first[w->width] = count;
}

static bool same_facet(const struct surface *a, const struct surface *b)
{
    return memcmp(a->facet.corners, b->facet.corners, sizeof a->facet.corners) == 0;
}

// Whether two surfaces are one and the same plane, whatever leaves they belong to.
static bool same_plane(const struct wires *w, const struct surface *a, const struct surface *b,
                       double x, double y)
{
    if (a->leaf == b->leaf && a->face == b->face)
        return !a->parted || same_facet(a, b);
    if (fabs(vec3_dot(a->normal, b->normal)) < 1 - 1e-10)
        return false;
    double apart = depth_of(w, weight_at(a, x, y)) - depth_of(w, weight_at(b, x, y));
    return fabs(apart) <= w->tolerance;
}

// Surfaces of a pixel.
struct list {
    const struct surface *items;
    uint32_t count;
};

static struct list list_at(const struct row *row, int x)
{
    return (struct list){row->surfaces + row->first[x], row->first[x + 1] - row->first[x]};
}

// A function of the pixel whose zeros are an edge.
struct border {
    double here, there; // its values at the two pixels
    double x, y;        // its change per pixel
};

// Between two triangles of one face: the share that turns negative.
static bool border_of_parts(const struct wires *w, const struct surface *a, int x0, int y0, int x1,
                            int y1, struct border *out)
{
    const struct leaf *leaf = &w->body->leaves[a->leaf];
    int xs[] = {x0, x1, x0 + 1, x0}, ys[] = {y0, y1, y0, y0 + 1};
    struct vec3 s[4];
    for (int i = 0; i < 4; i++)
        s[i] = facets_shares(&a->facet,
                             affine_point(&leaf->to_local, rays_origin(w->rays, xs[i], ys[i])),
                             affine_vector(&leaf->to_local, rays_direction(w->rays, xs[i], ys[i])));
    if (s[0].x > 0 && s[1].x <= 0)
        *out = (struct border){s[0].x, s[1].x, s[2].x - s[0].x, s[3].x - s[0].x};
    else if (s[0].y > 0 && s[1].y <= 0)
        *out = (struct border){s[0].y, s[1].y, s[2].y - s[0].y, s[3].y - s[0].y};
    else if (s[0].z > 0 && s[1].z <= 0)
        *out = (struct border){s[0].z, s[1].z, s[2].z - s[0].z, s[3].z - s[0].z};
    else
        return false;
    return true;
}

static bool border_of_planes(const struct surface *a, const struct surface *b, int x0, int y0,
                             int x1, int y1, struct border *out)
{
    *out =
        (struct border){weight_at(a, x0, y0) - weight_at(b, x0, y0),
                        weight_at(a, x1, y1) - weight_at(b, x1, y1), a->wx - b->wx, a->wy - b->wy};
    return (out->here <= 0) != (out->there <= 0);
}

// Surface `a` of a pixel has no counterpart in the next one, (x1, y1), to the right or below.
static void draw_end(const struct wires *w, const struct surface *a, struct list here,
                     struct list there, int x0, int y0, int x1, int y1)
{
    bool across = x1 != x0, found = false, back = a->back;
    struct border b = {0};
    for (uint32_t side = 0; side < 2 && !found; side++) {
        struct list l = side ? here : there; // a crease shows the other plane there
        for (uint32_t i = 0; i < l.count && !found; i++) {
            const struct surface *o = &l.items[i];
            if (o->leaf == a->leaf && o->face == a->face)
                found = side == 0 && border_of_parts(w, a, x0, y0, x1, y1, &b);
            else if (!same_plane(w, a, o, x0, y0))
                found = border_of_planes(a, o, x0, y0, x1, y1, &b);
            if (found)
                back |= o->back;
        }
    }
    for (uint32_t i = 0; i < there.count && !found; i++) // it ends at one that is seen edge-on
        back |= there.items[i].back;
    double share = found ? b.here / (b.here - b.there) : 0.5;
    if (found && (fabs(b.x) >= fabs(b.y)) != across)
        return; // it is taken where it is crossed more steeply
    double x = x0 + (x1 - x0) * share, y = y0 + (y1 - y0) * share;
    double weight = weight_at(a, x, y);
    struct rgb colour = back ? w->scheme->edge_back : w->scheme->edge_front;
    int first = (int)ceil((across ? x : y) - EDGE / 2.0);
    for (int i = first; i < first + EDGE; i++)
        put(w, colour, across ? i : x0, across ? y0 : i, weight);
}

static void compare(const struct wires *w, struct list here, struct list there, int x0, int y0,
                    int x1, int y1)
{
    for (int side = 0; side < 2; side++) {
        struct list from = side ? there : here, to = side ? here : there;
        int x[] = {side ? x1 : x0, side ? x0 : x1}, y[] = {side ? y1 : y0, side ? y0 : y1};
        for (uint32_t i = 0; i < from.count; i++) {
            bool goes_on = false;
            for (uint32_t k = 0; k < to.count && !goes_on; k++)
                goes_on = same_plane(w, &from.items[i], &to.items[k], x[1], y[1]);
            if (!goes_on)
                draw_end(w, &from.items[i], from, to, x[0], y[0], x[1], y[1]);
        }
    }
}

static void draw_point(const struct wires *w, bool back, double x, double y, double weight)
{
    int x0 = (int)ceil(x - POINT / 2.0), y0 = (int)ceil(y - POINT / 2.0);
    for (int i = 0; i < POINT * POINT; i++)
        put(w, back ? point_back : point_front, x0 + i % POINT, y0 + i / POINT, weight);
}

// Between four pixels, or so little outside that no ray between sees all that meets there.
static bool in_corner(double px, double py, int x, int y)
{
    return fabs(px - x - 0.5) <= 0.5 + OUTSIDE && fabs(py - y - 0.5) <= 0.5 + OUTSIDE;
}

// Where three planes meet.
static void draw_meeting(const struct wires *w, const struct surface *a, const struct surface *b,
                         const struct surface *c, int x, int y)
{
    double abx = a->wx - b->wx, aby = a->wy - b->wy, ab = a->w0 - b->w0;
    double acx = a->wx - c->wx, acy = a->wy - c->wy, ac = a->w0 - c->w0;
    double det = abx * acy - aby * acx;
    double px = (aby * ac - acy * ab) / det, py = (acx * ab - abx * ac) / det;
    if (in_corner(px, py, x, y))
        draw_point(w, a->back || b->back || c->back, px, py, weight_at(a, px, py));
}

// Where the sides of a triangle that is a part of a face end, or go through another plane.
static void draw_side_ends(const struct wires *w, const struct surface *part,
                           const struct surface *const *planes, uint32_t n, int x, int y)
{
    const struct affine *to_world = &w->body->leaves[part->leaf].to_world;
    struct vec3 corners[3];
    for (int i = 0; i < 3; i++)
        corners[i] = affine_point(to_world, part->facet.corners[i]);
    for (int i = 0; i < 3; i++) {
        struct vec3 from = corners[i], along = vec3_sub(corners[(i + 1) % 3], from);
        struct vec3 place = rays_place(w->rays, from);
        if (in_corner(place.x, place.y, x, y))
            draw_point(w, part->back, place.x, place.y, weight_at(part, place.x, place.y));
        for (uint32_t k = 0; k < n; k++) {
            const struct surface *o = planes[k];
            if (o->leaf == part->leaf && o->face == part->face)
                continue;
            struct vec3 point =
                affine_point(&w->body->leaves[o->leaf].to_world, o->facet.corners[0]);
            double t = vec3_dot(o->normal, vec3_sub(point, from)) / vec3_dot(o->normal, along);
            if (!(t >= 0 && t <= 1))
                continue;
            place = rays_place(w->rays, vec3_add(from, vec3_scale(along, t)));
            if (in_corner(place.x, place.y, x, y))
                draw_point(w, part->back || o->back, place.x, place.y,
                           weight_at(part, place.x, place.y));
        }
    }
}

// Planes around a corner between four pixels, and in how many of the pixels each is seen.
struct meeting {
    const struct surface *planes[PLANES_MOST];
    int seen[PLANES_MOST];
    uint32_t count;
};

static void gather(const struct wires *w, const struct row rows[2], int x, int y,
                   struct meeting *out)
{
    out->count = 0;
    for (int i = 0; i < 4; i++) {
        struct list l = list_at(&rows[i / 2], x + i % 2);
        for (uint32_t k = 0; k < l.count; k++) {
            uint32_t p = 0;
            while (p < out->count && !same_plane(w, out->planes[p], &l.items[k], x, y))
                p++;
            if (p == PLANES_MOST)
                continue;
            if (p == out->count) {
                out->planes[out->count] = &l.items[k];
                out->seen[out->count++] = 0;
            }
            out->seen[p]++;
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
            for (uint32_t p = 0; p < m->count && in_corner(place.x, place.y, x, y); p++)
                if (m->seen[p] % 2)
                    draw_point(w, m->planes[p]->back || m->planes[i]->back, place.x, place.y,
                               weight_at(m->planes[p], place.x, place.y));
        }
    }
}

// Vertices between the middles of four pixels, of the planes that are seen there.
static void draw_points(const struct wires *w, const struct row rows[2], int x, int y)
{
    struct meeting m;
    gather(w, rows, x, y, &m);
    for (uint32_t i = 0; i < m.count && m.count > 1; i++) {
        if (m.planes[i]->parted)
            draw_side_ends(w, m.planes[i], m.planes, m.count, x, y);
        for (uint32_t j = i + 1; j < m.count; j++)
            for (uint32_t k = j + 1; k < m.count; k++)
                draw_meeting(w, m.planes[i], m.planes[j], m.planes[k], x, y);
    }
    if (w->rays->orthographic)
        draw_seen_along(w, &m, x, y);
}

static void draw_band(const struct wires *w, int rows, bool points)
{
    struct row two[2] = {{0}};
    for (int i = 0; i < 2; i++)
        two[i].first = mem_alloc(((size_t)w->width + 1) * sizeof *two[i].first);
    fill_row(w, &two[0], w->band);
    for (int y = w->band; y < w->band + rows; y++) {
        bool below = y + 1 < w->rays->height;
        if (below)
            fill_row(w, &two[1], y + 1);
        for (int x = 0; x < w->width; x++) {
            struct list here = list_at(&two[0], x);
            bool beside = x + 1 < w->width;
            if (points && below && beside)
                draw_points(w, two, x, y);
            if (!points && beside)
                compare(w, here, list_at(&two[0], x + 1), x, y, x + 1, y);
            if (!points && below)
                compare(w, here, list_at(&two[1], x), x, y, x, y + 1);
        }
        struct row swap = two[0];
        two[0] = two[1];
        two[1] = swap;
    }
    for (int i = 0; i < 2; i++) {
        free(two[i].first);
        free(two[i].surfaces);
    }
}

void wires_draw(const struct canvas *c, struct device *device, const struct model *m,
                const struct scheme *scheme, const struct facets *facets, const struct rays *rays,
                const struct render_settings *settings)
{
    if (!m->body_count)
        return;
    size_t room = (size_t)rays->width * (BAND + 1);
    struct wires w = {.canvas = c,
                      .body = &m->bodies[0],
                      .scheme = scheme,
                      .facets = facets,
                      .rays = rays,
                      .tolerance = fmax(settings->epsilon, 1e-6 * fabs(rays->reference)),
                      .pixels = mem_zalloc(room * sizeof *w.pixels),
                      .width = rays->width};
    // Points lie over all edges.
    for (int points = 0; points < 2; points++)
        for (w.band = 0; w.band < rays->height; w.band += BAND) {
            struct render_stats stats;
            struct rays part = *rays;
            int rows = rays->height - w.band < BAND ? rays->height - w.band : BAND;
            part.height = w.band + rows < rays->height ? rows + 1 : rows;
            struct vec3 down = vec3_scale(rays->step_y, w.band);
            *(rays->orthographic ? &part.origin : &part.forward) =
                vec3_add(rays->orthographic ? rays->origin : rays->forward, down);
            device_spans(device, w.body, &part, settings, keep_spans, &w, &stats);
            draw_band(&w, rows, points);
            for (size_t i = 0; i < room; i++)
                free(w.pixels[i].block);
            memset(w.pixels, 0, room * sizeof *w.pixels);
        }
    free(w.pixels);
}
