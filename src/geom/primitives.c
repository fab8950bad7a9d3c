// primitives.c - cube, sphere and cylinder cut into faces exactly as OpenSCAD does it.
#include "geom/primitives.h"

#include "base/angle.h"
#include "base/mem.h"
#include "geom/mesh.h"

#include <stdlib.h>

#define SMALLEST_RADIUS 0x1p-20 // OpenSCAD's fine grid

uint32_t circle_fragments(double r, struct detail detail)
{
    if (r < SMALLEST_RADIUS || !isfinite(detail.fn))
        return 3;
    double n = detail.fn > 0 ? trunc(fmax(detail.fn, 3))
                             : ceil(fmax(fmin(360 / detail.fa, r * 2 * M_PI / detail.fs), 5));
    return n < UINT32_MAX ? (uint32_t)n : UINT32_MAX;
}

void primitive_cube(struct mesh *out)
{
    static const uint32_t sides[6][4] = {{4, 5, 7, 6}, {2, 3, 1, 0}, {0, 1, 5, 4},
                                         {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    struct mesh_builder b = {0};
    struct box unit = {{0, 0, 0}, {1, 1, 1}};
    for (int i = 0; i < 8; i++)
        mesh_add_vertex(&b, box_corner(unit, i));
    for (int i = 0; i < 6; i++)
        mesh_add_convex(&b, sides[i], 4);
    *out = b.mesh;
}

// n corners from +x counter-clockwise; returns the first one's number.
static uint32_t add_ring(struct mesh_builder *b, uint32_t n, double r, double z)
{
    uint32_t first = b->mesh.vertex_count;
    for (uint32_t i = 0; i < n; i++) {
        double angle = 360.0 * i / n;
        mesh_add_vertex(b, (struct vec3){r * cos_degrees(angle), r * sin_degrees(angle), z});
    }
    return first;
}

static void add_cap(struct mesh_builder *b, uint32_t first, uint32_t n, bool upward)
{
    uint32_t *corners = mem_alloc(n * sizeof *corners);
    for (uint32_t i = 0; i < n; i++)
        corners[i] = first + (upward ? i : n - 1 - i);
    mesh_add_convex(b, corners, n);
    free(corners);
}

// Plane four-sided faces between two rings, each cut from the upper i to the lower i + 1.
static void add_band(struct mesh_builder *b, uint32_t lower, uint32_t upper, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = (i + 1) % n, face = mesh_add_face(b);
        mesh_add_triangle(b, lower + i, lower + j, upper + i, face);
        mesh_add_triangle(b, lower + j, upper + j, upper + i, face);
    }
}

void primitive_sphere(struct mesh *out, uint32_t n)
{
    struct mesh_builder b = {0};
    uint32_t rings = (n + 1) / 2, upper = 0;
    for (uint32_t i = 0; i < rings; i++) {
        double polar = 180 * (i + 0.5) / rings;
        uint32_t ring = add_ring(&b, n, sin_degrees(polar), cos_degrees(polar));
        if (i == 0)
            add_cap(&b, ring, n, true);
        else
            add_band(&b, ring, upper, n);
        upper = ring;
    }
    add_cap(&b, upper, n, false);
    *out = b.mesh;
}

static void add_cone_side(struct mesh_builder *b, uint32_t ring, uint32_t apex, uint32_t n,
                          bool upward)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = (i + 1) % n;
        uint32_t corners[3] = {ring + (upward ? i : j), ring + (upward ? j : i), apex};
        mesh_add_convex(b, corners, 3);
    }
}

void primitive_cylinder(struct mesh *out, uint32_t n, double r1, double r2)
{
    struct mesh_builder b = {0};
    uint32_t bottom = r1 > 0 ? add_ring(&b, n, r1, 0) : mesh_add_vertex(&b, (struct vec3){0});
    uint32_t top = r2 > 0 ? add_ring(&b, n, r2, 1) : mesh_add_vertex(&b, (struct vec3){0, 0, 1});
    if (r1 > 0 && r2 > 0)
        add_band(&b, bottom, top, n);
    else if (r1 > 0)
        add_cone_side(&b, bottom, top, n, true);
    else
        add_cone_side(&b, top, bottom, n, false);
    if (r1 > 0)
        add_cap(&b, bottom, n, false);
    if (r2 > 0)
        add_cap(&b, top, n, true);
    *out = b.mesh;
}
