// read_surface.c - height fields from text (.dat) and PNG pictures.
#include "io/read_surface.h"

#include "geom/mesh.h"
#include "io/heights.h"

#include <stdlib.h>

// The corners of the grid come first among the vertices, by rows; then the middles of its cells,
// then the border once more at the level of the base, counter-clockwise from above.
struct relief {
    struct mesh_builder mesh;
    const struct heights *h;
    uint32_t rows, columns, border; // corners
    uint32_t base;                  // vertex under the first corner
};

bool heights_allowed(const char *path, uint64_t rows, uint64_t columns, struct error *err)
{
    if (!rows || columns <= HEIGHTS_MOST / rows)
        return true;
    error_set(err, "%s: a surface of %llu x %llu heights, more than the limit of %d", path,
              (unsigned long long)rows, (unsigned long long)columns, HEIGHTS_MOST);
    return false;
}

// The corner of the grid that is the k-th of its border.
static uint32_t border_corner(const struct relief *r, uint32_t k)
{
    uint32_t c = r->columns - 1, d = r->rows - 1;
    if (k < c)
        return k;
    if (k < c + d)
        return (k - c) * r->columns + c;
    if (k < c + d + c)
        return d * r->columns + (2 * c + d - k);
    return (r->border - k) % r->border * r->columns;
}

static void add_vertices(struct relief *r, bool center)
{
    double ox = center ? -(double)(r->columns - 1) / 2 : 0;
    double oy = center ? -(double)(r->rows - 1) / 2 : 0;
    const double *z = r->h->z;
    for (uint32_t i = 0; i < r->rows; i++)
        for (uint32_t j = 0; j < r->columns; j++)
            mesh_add_vertex(&r->mesh, (struct vec3){ox + j, oy + i, z[(size_t)i * r->columns + j]});
    for (uint32_t i = 1; i < r->rows; i++)
        for (uint32_t j = 1; j < r->columns; j++) {
            const double *low = z + (size_t)(i - 1) * r->columns + j, *high = low + r->columns;
            double mean = (low[-1] + low[0] + high[-1] + high[0]) / 4;
            mesh_add_vertex(&r->mesh, (struct vec3){ox + j - 0.5, oy + i - 0.5, mean});
        }
    double base = fmin(0, r->h->lowest - 1);
    r->base = r->mesh.mesh.vertex_count;
    for (uint32_t k = 0; k < r->border; k++) {
        struct vec3 p = r->mesh.mesh.vertices[border_corner(r, k)];
        mesh_add_vertex(&r->mesh, (struct vec3){p.x, p.y, base});
    }
}

static void add_top(struct relief *r)
{
    uint32_t middle = r->rows * r->columns;
    for (uint32_t i = 1; i < r->rows; i++)
        for (uint32_t j = 1; j < r->columns; j++, middle++) {
            uint32_t high = i * r->columns + j, low = high - r->columns;
            const uint32_t around[5] = {low - 1, low, high, high - 1, low - 1};
            for (int k = 0; k < 4; k++)
                mesh_add_triangle(&r->mesh, around[k], around[k + 1], middle,
                                  mesh_add_face(&r->mesh));
        }
}

static void add_sides(struct relief *r)
{
    for (uint32_t k = 0; k < r->border; k++) {
        uint32_t next = (k + 1) % r->border;
        const uint32_t quad[4] = {r->base + k, r->base + next, border_corner(r, next),
                                  border_corner(r, k)};
        mesh_add_convex(&r->mesh, quad, 4);
    }
}

// Numbers along the border, counter-clockwise from above: the bottom is seen from below.
static void add_below(struct relief *r, uint32_t i, uint32_t j, uint32_t k, uint32_t face)
{
    uint32_t n = r->border;
    mesh_add_triangle(&r->mesh, r->base + i % n, r->base + k % n, r->base + j % n, face);
}

// One face, over all points of the border and no others. Strips from one long side to the other,
// not a fan around a corner: trees over the triangles want small boxes.
static void add_bottom(struct relief *r)
{
    uint32_t face = mesh_add_face(&r->mesh), n = r->border;
    uint32_t last = r->columns - 1, north = n - (r->rows - 1); // north - x is across from x
    if (last == 1) {
        for (uint32_t y = 0; y + 1 < r->rows; y++) { // n - y is across from 1 + y
            add_below(r, n - y, 1 + y, 2 + y, face);
            add_below(r, n - y, 2 + y, n - y - 1, face);
        }
        return;
    }
    for (uint32_t k = north - 1; k < n; k++) // the first strip has one side of many points
        add_below(r, 1, k, k + 1, face);
    for (uint32_t x = 1; x + 1 < last; x++) {
        add_below(r, x, x + 1, north - x - 1, face);
        add_below(r, x, north - x - 1, north - x, face);
    }
    for (uint32_t k = last; k < north - (last - 1); k++)
        add_below(r, last - 1, k, k + 1, face);
}

static void raise(const struct heights *h, bool center, struct mesh *out)
{
    struct relief r = {.h = h, .rows = h->rows, .columns = h->columns};
    uint32_t cells = (r.rows - 1) * (r.columns - 1), corners = r.rows * r.columns;
    r.border = 2 * (r.rows + r.columns - 2);
    uint32_t triangles = 4 * cells + 3 * r.border - 2;
    array_reserve(&r.mesh.mesh.vertices, &r.mesh.vertex_room, corners + cells + r.border);
    array_reserve(&r.mesh.mesh.triangles, &r.mesh.triangle_room, triangles);
    array_reserve(&r.mesh.mesh.faces, &r.mesh.face_room, triangles);
    add_vertices(&r, center);
    add_top(&r);
    add_sides(&r);
    add_bottom(&r);

    // Only what short rows lack can lie on the base.
    bool touches = false;
    const struct vec3 *v = r.mesh.mesh.vertices;
    for (uint32_t k = 0; k < r.border; k++)
        touches |= v[border_corner(&r, k)].z == v[r.base].z;
    if (touches)
        mesh_weld(&r.mesh.mesh);
    *out = r.mesh.mesh;
}

bool read_surface(const char *path, const char *data, size_t size,
                  const struct surface_options *options, struct mesh *out,
                  struct messages *messages, struct error *err)
{
    struct heights h;
    if (!(heights_is_png(data, size) ? heights_from_png(path, data, size, options->invert, &h, err)
                                     : heights_from_text(path, data, size, &h, messages, err)))
        return false;
    *out = (struct mesh){0};
    if (h.rows > 1 && h.columns > 1)
        raise(&h, options->center, out);
    else
        messages_add(messages, MESSAGE_WARNING, (struct place){path, 0, 0},
                     "a surface of %u x %u heights encloses nothing", h.rows, h.columns);
    free(h.z);
    return true;
}
