// hull_small.c - convex hulls of a handful of points.
#include "base/mem.h"
#include "geom/hull_parts.h"

#include <stdlib.h>

// Sets of points are bits of a number.
enum { FACES_MOST = 2 * HULL_SMALL - 4 };
#define FLAT 1e-12 // of the extent: what counts as in one plane

struct small {
    struct vec3 p[HULL_SMALL]; // about the first point, the farthest at distance 1
    uint32_t count;
    uint32_t faces[FACES_MOST];
    struct vec3 normals[FACES_MOST];
    uint32_t face_count;
};

// Of points at one place only the first takes part.
static void take_points(struct small *s, const struct vec3 *points, uint32_t count, uint32_t *used)
{
    double scale = 0;
    for (uint32_t i = 0; i < count; i++)
        scale = fmax(scale, vec3_length(vec3_sub(points[i], points[0])));
    *used = 0;
    s->count = count;
    for (uint32_t i = 0; i < count; i++) {
        s->p[i] = vec3_scale(vec3_sub(points[i], points[0]), 1 / scale);
        bool first = true;
        for (uint32_t k = 0; k < i; k++)
            first = first && vec3_length(vec3_sub(s->p[i], s->p[k])) > FLAT;
        *used |= (uint32_t)first << i;
    }
}

// The points of the plane through three of them when no other one lies beyond it, with the normal
// outward; else 0. Three points nearly in line give no plane.
static uint32_t face_through(const struct small *s, uint32_t used, const uint32_t *corner,
                             struct vec3 *normal)
{
    struct vec3 o = s->p[corner[0]];
    struct vec3 cross = vec3_cross(vec3_sub(s->p[corner[1]], o), vec3_sub(s->p[corner[2]], o));
    double area = vec3_length(cross);
    if (area < 1e-6)
        return 0;
    *normal = vec3_scale(cross, 1 / area);
    uint32_t above = 0, below = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        double d = vec3_dot(*normal, vec3_sub(s->p[i], o));
        above |= (uint32_t)(d > FLAT) << i;
        below |= (uint32_t)(d < -FLAT) << i;
    }
    if ((above & used) && (below & used))
        return 0;
    if (above & used)
        *normal = vec3_scale(*normal, -1);
    return used & ~above & ~below;
}

static bool find_faces(struct small *s, uint32_t used)
{
    uint32_t c[3];
    for (c[0] = 0; c[0] < s->count; c[0]++)
        for (c[1] = c[0] + 1; c[1] < s->count; c[1]++)
            for (c[2] = c[1] + 1; c[2] < s->count; c[2]++) {
                uint32_t three = 1u << c[0] | 1u << c[1] | 1u << c[2];
                bool known = (three & used) != three;
                for (uint32_t f = 0; f < s->face_count && !known; f++)
                    known = (three & s->faces[f]) == three;
                struct vec3 normal;
                uint32_t face = known ? 0 : face_through(s, used, c, &normal);
                if (!face)
                    continue;
                if (s->face_count == FACES_MOST)
                    return false;
                s->faces[s->face_count] = face;
                s->normals[s->face_count++] = normal;
            }
    return true;
}

// Points of three and more faces.
static uint32_t find_corners(const struct small *s)
{
    uint32_t once = 0, twice = 0, corners = 0;
    for (uint32_t f = 0; f < s->face_count; f++) {
        corners |= twice & s->faces[f];
        twice |= once & s->faces[f];
        once |= s->faces[f];
    }
    return corners;
}

// The corners of a face in order: each time the one that leaves all others to the left.
static uint32_t order_corners(const struct small *s, uint32_t face, struct vec3 normal,
                              uint32_t *ring)
{
    uint32_t n = 0, at = (uint32_t)__builtin_ctz(face), left = face;
    do {
        ring[n++] = at;
        left &= ~(1u << at);
        uint32_t next = ring[0];
        for (uint32_t i = 0; i < s->count; i++) {
            if (!(left >> i & 1))
                continue;
            struct vec3 to = vec3_sub(s->p[i], s->p[at]), best = vec3_sub(s->p[next], s->p[at]);
            if (next == at || vec3_dot(normal, vec3_cross(best, to)) < 0)
                next = i;
        }
        at = next;
    } while (at != ring[0]);
    return left ? 0 : n;
}

bool hull_small(struct hull_faces *out, const struct vec3 *points, uint32_t count)
{
    struct small s = {.face_count = 0};
    uint32_t used, from[HULL_SMALL] = {0}, into[HULL_SMALL] = {0}, edges = 0;
    take_points(&s, points, count, &used);
    if (!find_faces(&s, used))
        return false;
    uint32_t corners = find_corners(&s);
    for (uint32_t f = 0; f < s.face_count; f++) {
        uint32_t ring[HULL_SMALL];
        if (!(s.faces[f] & corners))
            return false;
        uint32_t n = order_corners(&s, s.faces[f] & corners, s.normals[f], ring);
        if (n < 3)
            return false;
        array_reserve(&out->corners, &out->corner_room, (size_t)out->corner_count + n);
        array_reserve(&out->ends, &out->face_room, (size_t)out->face_count + 1);
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = ring[i], b = ring[(i + 1) % n];
            if (from[a] >> b & 1)
                return false;
            from[a] |= 1u << b;
            into[b] |= 1u << a;
            out->corners[out->corner_count++] = a;
        }
        edges += n;
        out->ends[out->face_count++] = out->corner_count;
    }
    // Each edge has its opposite, and Euler's formula holds: the faces close up to one ball.
    for (uint32_t i = 0; i < count; i++)
        if (from[i] != into[i])
            return false;
    return (uint32_t)__builtin_popcount(corners) + s.face_count == edges / 2 + 2;
}
