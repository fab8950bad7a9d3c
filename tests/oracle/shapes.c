// shapes.c - closed meshes from formulas.
#include "shapes.h"

#include "base/mem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

const char *const shape_names[SHAPES] = {"cube", "sphere", "cylinder", "frustum",
                                         "cone", "ell",    "star",     "torus"};

struct builder {
    struct mesh *mesh;
    uint32_t vertex_capacity, triangle_capacity, face_capacity;
};

static uint32_t vertex(struct builder *b, double x, double y, double z)
{
    array_reserve(&b->mesh->vertices, &b->vertex_capacity, b->mesh->vertex_count + 1);
    b->mesh->vertices[b->mesh->vertex_count] = (struct vec3){x, y, z};
    return b->mesh->vertex_count++;
}

static void triangle(struct builder *b, uint32_t i, uint32_t j, uint32_t k)
{
    struct mesh *m = b->mesh;
    array_reserve(&m->triangles, &b->triangle_capacity, m->triangle_count + 1);
    array_reserve(&m->faces, &b->face_capacity, m->triangle_count + 1);
    memcpy(m->triangles[m->triangle_count], (uint32_t[3]){i, j, k}, sizeof *m->triangles);
    m->faces[m->triangle_count++] = m->face_count;
}

// Closes the current face.
static void end_face(struct builder *b)
{
    b->mesh->face_count++;
}

static void quad(struct builder *b, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    triangle(b, i, j, k);
    triangle(b, i, k, l);
    end_face(b);
}

// Prism over a counter-clockwise outline that is star-shaped around `centre`; the upper outline is
// the lower one scaled by `top` around the z axis.
static void prism(struct builder *b, const double (*outline)[2], uint32_t n, const double centre[2],
                  double top)
{
    uint32_t low = b->mesh->vertex_count;
    for (uint32_t i = 0; i < n; i++)
        vertex(b, outline[i][0], outline[i][1], -0.5);
    uint32_t low_centre = vertex(b, centre[0], centre[1], -0.5);
    uint32_t high = b->mesh->vertex_count;
    for (uint32_t i = 0; i < n && top > 0; i++)
        vertex(b, outline[i][0] * top, outline[i][1] * top, 0.5);
    uint32_t high_centre = vertex(b, centre[0] * top, centre[1] * top, 0.5);
    for (uint32_t i = 0; i < n; i++)
        triangle(b, low_centre, low + (i + 1) % n, low + i);
    end_face(b);
    for (uint32_t i = 0; i < n && top > 0; i++)
        triangle(b, high_centre, high + i, high + (i + 1) % n);
    if (top > 0)
        end_face(b);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = (i + 1) % n;
        if (top > 0) {
            quad(b, low + i, low + j, high + j, high + i);
        } else {
            triangle(b, low + i, low + j, high_centre);
            end_face(b);
        }
    }
}

static void round_outline(double (*outline)[2], int n, double r, double inner)
{
    for (int i = 0; i < n; i++) {
        double radius = i % 2 ? inner : r, angle = 2 * pi * i / n;
        outline[i][0] = radius * cos(angle);
        outline[i][1] = radius * sin(angle);
    }
}

// Rings of fn corners without vertices at the poles, closed by flat caps.
static void sphere(struct builder *b, int fn)
{
    int rings = (fn + 1) / 2;
    for (int i = 0; i < rings; i++) {
        double polar = pi * (i + 0.5) / rings;
        for (int k = 0; k < fn; k++)
            vertex(b, 0.5 * sin(polar) * cos(2 * pi * k / fn),
                   0.5 * sin(polar) * sin(2 * pi * k / fn), 0.5 * cos(polar));
    }
    uint32_t n = (uint32_t)fn, last = (uint32_t)(rings - 1) * n;
    for (uint32_t k = 1; k + 1 < n; k++)
        triangle(b, 0, k, k + 1);
    end_face(b);
    for (uint32_t k = 1; k + 1 < n; k++)
        triangle(b, last, last + k + 1, last + k);
    end_face(b);
    for (uint32_t ring = 0; ring < last; ring += n)
        for (uint32_t k = 0; k < n; k++)
            quad(b, ring + k, ring + n + k, ring + n + (k + 1) % n, ring + (k + 1) % n);
}

static void torus(struct builder *b, int fn)
{
    uint32_t n = (uint32_t)fn, m = 5;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            double along = 2 * pi * i / n, around = 2 * pi * k / m;
            double r = 0.35 + 0.15 * cos(around);
            vertex(b, r * cos(along), r * sin(along), 0.15 * sin(around));
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            uint32_t i1 = (i + 1) % n, k1 = (k + 1) % m;
            quad(b, i * m + k, i1 * m + k, i1 * m + k1, i * m + k1);
        }
}

bool shape_make(struct mesh *out, enum shape shape, int fn)
{
    static const double ell[6][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, -0.1},
                                     {-0.1, -0.1}, {-0.1, 0.5}, {-0.5, 0.5}};
    static const double ell_centre[2] = {-0.3, -0.3}, origin[2] = {0, 0};
    static const double square[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    double outline[64][2];
    *out = (struct mesh){0};
    struct builder b = {.mesh = out};
    fn = fn < 3 ? 3 : fn > 30 ? 30 : fn;
    round_outline(outline, fn, 0.5, 0.5);
    switch (shape) {
    case SHAPE_CUBE:
        prism(&b, square, 4, origin, 1);
        break;
    case SHAPE_SPHERE:
        sphere(&b, fn);
        break;
    case SHAPE_CYLINDER:
        prism(&b, (const double(*)[2])outline, (uint32_t)fn, origin, 1);
        break;
    case SHAPE_FRUSTUM:
        prism(&b, (const double(*)[2])outline, (uint32_t)fn, origin, 0.6);
        break;
    case SHAPE_CONE:
        prism(&b, (const double(*)[2])outline, (uint32_t)fn, origin, 0);
        break;
    case SHAPE_ELL:
        prism(&b, ell, 6, ell_centre, 1);
        break;
    case SHAPE_STAR:
        round_outline(outline, 2 * fn, 0.5, 0.2);
        prism(&b, (const double(*)[2])outline, (uint32_t)(2 * fn), origin, 1);
        break;
    default:
        torus(&b, fn);
    }
    return shape < SHAPE_ELL;
}

void shape_copy(struct mesh *out, const struct mesh *from)
{
    *out = *from;
    out->vertices = mem_alloc(from->vertex_count * sizeof *out->vertices);
    out->triangles = mem_alloc(from->triangle_count * sizeof *out->triangles);
    out->faces = mem_alloc(from->triangle_count * sizeof *out->faces);
    memcpy(out->vertices, from->vertices, from->vertex_count * sizeof *out->vertices);
    memcpy(out->triangles, from->triangles, from->triangle_count * sizeof *out->triangles);
    memcpy(out->faces, from->faces, from->triangle_count * sizeof *out->faces);
}

void shape_free(struct mesh *m)
{
    free(m->vertices);
    free(m->triangles);
    free(m->faces);
    *m = (struct mesh){0};
}
