// wire_edges.c - edges: where a plane ends between two pixels.
//
// The edge is where its weight is that of another plane there. As by OpenGL an edge takes five
// pixels of each row or column, whichever it crosses more steeply.
#include "render/wire_rows.h"

enum { EDGE = 5 }; // pixels

// A function of the pixel whose zeros are an edge.
struct border {
    double here, there; // its values at the two pixels
    double x, y;        // its change per pixel
};

// Where the way to the next pixel leaves a part of a face: over the first side on it.
static bool border_of_parts(const struct wires *w, const struct surface *a, int x0, int y0, int x1,
                            int y1, struct border *out)
{
    const struct leaf *leaf = &w->body->leaves[a->leaf];
    int xs[] = {x0, x1, x0 + 1, x0}, ys[] = {y0, y1, y0, y0 + 1};
    struct vec3 origin[4], direction[4];
    double nearest = INFINITY;
    for (int i = 0; i < 4; i++) {
        origin[i] = affine_point(&leaf->to_local, rays_origin(w->rays, xs[i], ys[i]));
        direction[i] = affine_vector(&leaf->to_local, rays_direction(w->rays, xs[i], ys[i]));
    }
    for (uint32_t k = 0; k < a->part.count; k++) {
        double s[4];
        for (int i = 0; i < 4; i++)
            s[i] = bent_side(leaf->solid, a->part, k, origin[i], direction[i]);
        if (!(s[0] > 0 && s[1] <= 0) || s[0] / (s[0] - s[1]) >= nearest)
            continue;
        *out = (struct border){s[0], s[1], s[2] - s[0], s[3] - s[0]};
        nearest = s[0] / (s[0] - s[1]);
    }
    return nearest < INFINITY;
}

static bool border_of_planes(const struct surface *a, const struct surface *b, int x0, int y0,
                             int x1, int y1, struct border *out)
{
    *out = (struct border){wire_weight(a, x0, y0) - wire_weight(b, x0, y0),
                           wire_weight(a, x1, y1) - wire_weight(b, x1, y1), a->wx - b->wx,
                           a->wy - b->wy};
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
            else if (!wire_same_plane(w, a, o, x0, y0))
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
    double weight = wire_weight(a, x, y);
    struct rgb colour = back ? w->scheme->edge_back : w->scheme->edge_front;
    int first = (int)ceil((across ? x : y) - EDGE / 2.0);
    for (int i = first; i < first + EDGE; i++)
        wire_put(w, colour, across ? i : x0, across ? y0 : i, weight);
}

void wire_edges_draw(const struct wires *w, struct list here, struct list there, int x0, int y0,
                     int x1, int y1)
{
    for (int side = 0; side < 2; side++) {
        struct list from = side ? there : here, to = side ? here : there;
        int x[] = {side ? x1 : x0, side ? x0 : x1}, y[] = {side ? y1 : y0, side ? y0 : y1};
        for (uint32_t i = 0; i < from.count; i++) {
            bool goes_on = false;
            for (uint32_t k = 0; k < to.count && !goes_on; k++)
                goes_on = wire_same_plane(w, &from.items[i], &to.items[k], x[1], y[1]);
            if (!goes_on)
                draw_end(w, &from.items[i], from, to, x[0], y[0], x[1], y[1]);
        }
    }
}
