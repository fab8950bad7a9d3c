// polygon_flips.c - the diagonals that OpenSCAD's tessellator chooses in bent polygons.
//
// libtess2 computes with floats and sees a polygon along one axis. What a bent polygon looks like
// depends on its diagonals, so the rounding is the same here.
#include "geom/polygon_flips.h"

#include "base/mem.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { NONE = UINT32_MAX };
// Flips per diagonal, for polygons where rounding lets them go round in circles.
enum { FLIPS_MOST = 200 };

struct point {
    float at[3];
};

static struct point point_of(struct vec3 p)
{
    return (struct point){{(float)p.x, (float)p.y, (float)p.z}};
}

static float cross_length2(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
    return out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
}

static void difference(const struct point *a, const struct point *b, float out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a->at[i] - b->at[i];
}

// The first of the largest.
static uint32_t largest(const float v[3])
{
    uint32_t i = fabsf(v[1]) > fabsf(v[0]);
    return fabsf(v[2]) > fabsf(v[i]) ? 2 : i;
}

// Of the triangle that is the largest over the polygon's longest extent along an axis. The order of
// the points, which starts with the second, decides between equal ones.
static void triangle_normal(const struct point *p, uint32_t count, float normal[3])
{
    struct point low[3], high[3];
    for (uint32_t i = 0; i < count; i++) {
        const struct point *q = &p[(i + 1) % count];
        for (int k = 0; k < 3; k++) {
            if (i == 0 || q->at[k] < low[k].at[k])
                low[k] = *q;
            if (i == 0 || q->at[k] > high[k].at[k])
                high[k] = *q;
        }
    }
    float extents[3], base[3], best = 0;
    for (int k = 0; k < 3; k++)
        extents[k] = high[k].at[k] - low[k].at[k];
    uint32_t axis = largest(extents);
    difference(&low[axis], &high[axis], base);
    for (uint32_t i = 0; i < count; i++) {
        float side[3], n[3];
        difference(&p[(i + 1) % count], &high[axis], side);
        float length2 = cross_length2(base, side, n);
        if (length2 > best) {
            best = length2;
            for (int k = 0; k < 3; k++)
                normal[k] = n[k];
        }
    }
}

uint32_t polygon_axis(const struct vec3 *vertices, const uint32_t *corners, uint32_t count,
                      double *sign)
{
    struct point *p = mem_alloc(count * sizeof *p);
    for (uint32_t i = 0; i < count; i++)
        p[i] = point_of(vertices[corners[i]]);
    float normal[3] = {0}, area = 0;
    triangle_normal(p, count, normal);
    uint32_t axis = largest(normal), s = (axis + 1) % 3, t = (axis + 2) % 3;
    for (uint32_t i = 0; i < count; i++) {
        const struct point *a = &p[i], *b = &p[(i + 1) % count];
        area += (a->at[s] - b->at[s]) * (a->at[t] + b->at[t]);
    }
    *sign = area < 0 || (area == 0 && normal[axis] < 0) ? -1 : 1;
    free(p);
    return axis;
}

// A side of a triangle, in its direction. `twin` is the same one of the neighbour, or NONE.
struct half {
    uint32_t from, next, twin;
    bool queued; // it or its twin
};

struct flips {
    struct half *halves; // three per triangle
    const struct vec3 *vertices;
    uint32_t s, t; // axes
    uint32_t *stack, stacked;
};

struct side {
    uint32_t low, high, half;
};

static int compare_sides(const void *a, const void *b)
{
    const struct side *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return (x->half > y->half) - (x->half < y->half);
}

static void find_twins(struct half *h, uint32_t count)
{
    struct side *sides = mem_alloc(count * sizeof *sides);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = h[i].from, b = h[h[i].next].from;
        sides[i] = (struct side){a < b ? a : b, a < b ? b : a, i};
    }
    qsort(sides, count, sizeof *sides, compare_sides);
    for (uint32_t i = 0, end; i < count; i = end) {
        for (end = i + 1;
             end < count && sides[end].low == sides[i].low && sides[end].high == sides[i].high;)
            end++;
        uint32_t a = sides[i].half, b = sides[end - 1].half;
        if (end == i + 2 && a / 3 != b / 3 && h[a].from != h[b].from) {
            h[a].twin = b;
            h[b].twin = a;
        }
    }
    free(sides);
}

static float angle_at(const struct flips *f, uint32_t before, uint32_t corner, uint32_t after)
{
    struct point p = point_of(f->vertices[corner]), u = point_of(f->vertices[after]);
    struct point v = point_of(f->vertices[before]);
    float a[2] = {u.at[f->s] - p.at[f->s], u.at[f->t] - p.at[f->t]};
    float b[2] = {v.at[f->s] - p.at[f->s], v.at[f->t] - p.at[f->t]};
    float cosine = a[0] * b[0] + a[1] * b[1];
    float lengths = (float)(sqrt((double)(a[0] * a[0] + a[1] * a[1])) *
                            sqrt((double)(b[0] * b[0] + b[1] * b[1])));
    if (lengths > 0)
        cosine /= lengths;
    return (float)acos((double)fmaxf(-1, fminf(1, cosine)));
}

static float angle_opposite(const struct flips *f, uint32_t half)
{
    const struct half *a = &f->halves[half], *b = &f->halves[a->next];
    return angle_at(f, b->from, f->halves[b->next].from, a->from);
}

static bool is_delaunay(const struct flips *f, uint32_t half)
{
    float sum = angle_opposite(f, half) + angle_opposite(f, f->halves[half].twin);
    return !((double)sum >= M_PI + 0.01); // true also for NaN
}

static void push(struct flips *f, uint32_t half)
{
    uint32_t twin = f->halves[half].twin;
    if (twin == NONE || f->halves[half].queued)
        return;
    f->halves[half].queued = f->halves[twin].queued = true;
    f->stack[f->stacked++] = half;
}

static void flip(struct flips *f, uint32_t a0)
{
    struct half *h = f->halves;
    uint32_t a1 = h[a0].next, a2 = h[a1].next, b0 = h[a0].twin, b1 = h[b0].next, b2 = h[b1].next;
    h[a0].from = h[b2].from;
    h[b0].from = h[a2].from;
    h[a0].next = a2;
    h[a2].next = b1;
    h[b1].next = a0;
    h[b0].next = b2;
    h[b2].next = a1;
    h[a1].next = b0;
    // Not a1: OpenSCAD's does not look at it again either.
    push(f, a2);
    push(f, b1);
    push(f, b2);
}

static void store(struct flips *f, uint32_t (*triangles)[3], uint32_t count)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < 3 * count; i++) {
        struct half *h = f->halves;
        if (h[i].from == NONE)
            continue;
        for (uint32_t k = 0, at = i; k < 3; k++, at = h[at].next) {
            triangles[n][k] = h[at].from;
            h[at].from = NONE;
        }
        n++;
    }
}

void polygon_flip(const struct vec3 *vertices, uint32_t axis, uint32_t (*triangles)[3],
                  uint32_t count)
{
    struct flips f = {.vertices = vertices, .s = (axis + 1) % 3, .t = (axis + 2) % 3};
    f.halves = mem_alloc(3 * (size_t)count * sizeof *f.halves);
    f.stack = mem_alloc(3 * (size_t)count * sizeof *f.stack);
    for (uint32_t i = 0; i < 3 * count; i++)
        f.halves[i] = (struct half){triangles[i / 3][i % 3], i % 3 == 2 ? i - 2 : i + 1, NONE, 0};
    find_twins(f.halves, 3 * count);
    for (uint32_t i = count; i-- > 0;) // GLU gives the last triangle first
        for (uint32_t k = 0; k < 3; k++)
            push(&f, 3 * i + k);
    for (uint64_t left = (uint64_t)FLIPS_MOST * count; f.stacked && left;) {
        uint32_t half = f.stack[--f.stacked];
        f.halves[half].queued = f.halves[f.halves[half].twin].queued = false;
        if (!is_delaunay(&f, half)) {
            flip(&f, half);
            left--;
        }
    }
    store(&f, triangles, count);
    free(f.halves);
    free(f.stack);
}
