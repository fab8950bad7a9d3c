// hull_plane.c - hulls in the plane, and of points that lie in one plane.
#include "geom/hull_parts.h"

#include "base/mem.h"
#include "geom/mesh.h"

#include <stdlib.h>

#define NOISE 1e-12 // of the extent

struct hull_span hull_span(const struct vec3 *points, uint32_t count)
{
    struct hull_span s = {.rank = 0};
    double far[4] = {0}, largest = 0;
    for (uint32_t i = 0; i < count; i++) {
        double sum = fabs(points[i].x) + fabs(points[i].y) + fabs(points[i].z);
        if (!isfinite(sum)) {
            s.rank = -1;
            return s;
        }
        largest = fmax(largest, sum);
    }
    if (!(largest > 0x1p-1000))
        return s;
    // Sizes near the limits of double must not overflow when they are squared.
    double scale = ldexp(1, -ilogb(largest));
    struct vec3 o = vec3_scale(points[0], scale), axis = {0};
    for (; s.rank < 3; s.rank++) {
        int k = s.rank + 1;
        for (uint32_t i = 0; i < count; i++) {
            struct vec3 p = vec3_sub(vec3_scale(points[i], scale), o);
            double d = k == 1   ? vec3_length(p)
                       : k == 2 ? vec3_length(vec3_cross(axis, p))
                                : fabs(vec3_dot(s.normal, p));
            if (d > far[k]) {
                far[k] = d;
                s.corner[k] = i;
            }
        }
        if (!(far[k] > NOISE * far[1] + 0x1p-51))
            break;
        struct vec3 to = vec3_sub(vec3_scale(points[s.corner[k]], scale), o);
        if (k == 1)
            axis = vec3_normalized(to);
        else if (k == 2)
            s.normal = vec3_normalized(vec3_cross(axis, to));
    }
    return s;
}

struct numbered {
    struct vec2 p;
    uint32_t number;
};

static int compare_points(const void *a, const void *b)
{
    const struct numbered *p = a, *q = b;
    if (p->p.x != q->p.x)
        return p->p.x < q->p.x ? -1 : 1;
    if (p->p.y != q->p.y)
        return p->p.y < q->p.y ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

// Is a, b, c a turn to the left for certain? The bound is that of the rounding of the determinant,
// relative to its terms, so that short edges of large shapes count.
static bool turns_left(struct vec2 a, struct vec2 b, struct vec2 c)
{
    double left = (b.x - a.x) * (c.y - b.y), right = (b.y - a.y) * (c.x - b.x);
    return left - right > 0x1p-51 * (fabs(left) + fabs(right));
}

// Andrew's monotone chain, in place: the corners counter-clockwise; returns how many.
static uint32_t chain(struct numbered **points, uint32_t count)
{
    struct numbered *in = *points;
    qsort(in, count, sizeof *in, compare_points);
    struct numbered *out = mem_alloc(((size_t)count * 2 + 1) * sizeof *out);
    uint32_t n = 0;
    for (uint32_t half = 0, base = 0; half < 2; half++, base = n - 1) {
        for (uint32_t k = half; k < count; k++) {
            struct numbered p = in[half ? count - 1 - k : k];
            while (n - base > 1 && !turns_left(out[n - 2].p, out[n - 1].p, p.p))
                n--;
            if (n == base || out[n - 1].p.x != p.p.x || out[n - 1].p.y != p.p.y)
                out[n++] = p;
        }
    }
    free(in);
    *points = out;
    return n > 3 ? n - 1 : 0; // the last is the first again
}

void hull_outline(struct outline *out, const struct vec2 *points, uint32_t count)
{
    *out = (struct outline){.clean = true};
    struct numbered *items = mem_alloc((size_t)count * sizeof *items);
    uint32_t finite = 0;
    for (uint32_t i = 0; i < count; i++)
        if (isfinite(points[i].x) && isfinite(points[i].y))
            items[finite++] = (struct numbered){points[i], i};
    uint32_t n = finite < 3 ? 0 : chain(&items, finite);
    for (uint32_t i = 0; i < n; i++)
        outline_add(out, items[i].p);
    if (n)
        outline_close(out);
    free(items);
}

bool hull_sheet(struct mesh *out, const struct vec3 *points, uint32_t count)
{
    *out = (struct mesh){0};
    struct hull_span span = hull_span(points, count);
    if (span.rank < 2)
        return false;
    // Seen along the main axis of the normal, mirrored if need be so that turns keep their sense.
    struct vec3 n = {fabs(span.normal.x), fabs(span.normal.y), fabs(span.normal.z)};
    struct numbered *items = mem_alloc((size_t)count * sizeof *items);
    for (uint32_t i = 0; i < count; i++) {
        struct vec3 p = points[i];
        struct vec2 q = n.x >= n.y && n.x >= n.z ? (struct vec2){p.y, p.z}
                        : n.y >= n.z             ? (struct vec2){p.z, p.x}
                                                 : (struct vec2){p.x, p.y};
        items[i] = (struct numbered){q, i};
    }
    uint32_t corner_count = chain(&items, count);
    uint32_t *corners = mem_alloc((size_t)corner_count * 2 * sizeof *corners);
    uint32_t *back = corners + corner_count;
    struct mesh_builder b = {0};
    for (uint32_t i = 0; i < corner_count; i++) {
        mesh_add_vertex(&b, points[items[i].number]);
        corners[i] = i;
        back[i] = corner_count - 1 - i; // its fan starts elsewhere: no edge stands twice
    }
    if (corner_count) {
        mesh_add_convex(&b, corners, corner_count);
        mesh_add_convex(&b, back, corner_count);
    }
    *out = b.mesh;
    free(corners);
    free(items);
    return corner_count > 0;
}
