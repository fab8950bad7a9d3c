// wire_rows.h - what the drawing of edges and vertices shares: the planes that pixels meet.
#pragma once
#include "render/bent.h"
#include "render/lines.h"

// A surface of the result at a pixel.
struct surface {
    uint32_t leaf, face;
    struct facet facet;    // in the solid's coordinates
    struct bent_part part; // of the face
    struct vec3 normal;    // unit, in the world
    double w0, wx, wy;     // its plane's weight at (0, 0) of the picture and per pixel
    bool back;             // made by what is taken away
};

// Surfaces of a pixel.
struct list {
    const struct surface *items;
    uint32_t count;
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
    struct bent *bent;
    const struct rays *rays; // of the picture
    double tolerance;        // depths within it are equal
};

// The surfaces of pixel (x, y) at the ends of its spans, added to the row.
struct span;
void wire_row_add(const struct wires *w, struct row *row, int x, int y, const struct span *spans,
                  uint32_t count);

static inline struct list wire_row_at(const struct row *row, int x)
{
    return (struct list){row->surfaces + row->first[x], row->first[x + 1] - row->first[x]};
}

static inline double wire_weight(const struct surface *s, double x, double y)
{
    return s->w0 + s->wx * x + s->wy * y;
}

// In the world.
struct vec3 wire_place(const struct wires *w, const struct surface *s, double x, double y);

// Whether two surfaces are one and the same plane, whatever leaves they belong to.
bool wire_same_plane(const struct wires *w, const struct surface *a, const struct surface *b,
                     double x, double y);

// A pixel of a line or point, as far as the depths of the canvas let it show.
void wire_put(const struct wires *w, struct rgb colour, int x, int y, double weight);

// wire_edges.c: between two pixels, one of which is to the right of the other one or below it.
void wire_edges_draw(const struct wires *w, struct list here, struct list there, int x0, int y0,
                     int x1, int y1);
// wire_points.c: between the middles of four pixels, of which (x, y) is the upper left.
void wire_points_draw(const struct wires *w, const struct row rows[2], int x, int y);
