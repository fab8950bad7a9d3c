// hull_merge.c - triangles of a hull that lie in one plane as one face.
#include "geom/hull_parts.h"

#include "base/mem.h"

#include <stdlib.h>

#define NONE UINT32_MAX

// Side 3t + i of triangle t goes from its corner i to the next one.
struct merge {
    const struct hull_faces *in;
    const struct vec3 *points;
    double flat;       // how far points may be off the plane of their face
    uint32_t *beyond;  // by side: the same one of the neighbour
    uint32_t *face;    // by triangle: the one that its face began with
    uint32_t *members; // triangles, face after face
    uint32_t *next;    // by point: the next one around the face at hand
};

struct side {
    uint32_t low, high, number;
};

static int compare_sides(const void *a, const void *b)
{
    const struct side *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    if (p->high != q->high)
        return p->high < q->high ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

static uint32_t after(uint32_t side)
{
    return side % 3 == 2 ? side - 2 : side + 1;
}

static bool find_neighbours(struct merge *m)
{
    uint32_t count = m->in->corner_count;
    const uint32_t *corners = m->in->corners;
    struct side *sides = mem_alloc(count * sizeof *sides);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = corners[i], b = corners[after(i)];
        sides[i] = (struct side){a < b ? a : b, a < b ? b : a, i};
    }
    qsort(sides, count, sizeof *sides, compare_sides);
    bool closed = count % 2 == 0;
    for (uint32_t i = 0; i < count && closed; i += 2) {
        struct side p = sides[i], q = sides[i + 1];
        closed = p.low == q.low && p.high == q.high && corners[p.number] != corners[q.number];
        m->beyond[p.number] = q.number;
        m->beyond[q.number] = p.number;
    }
    free(sides);
    return closed;
}

struct sized {
    double area;
    uint32_t triangle;
};

static int compare_sized(const void *a, const void *b)
{
    const struct sized *p = a, *q = b;
    if (p->area != q->area)
        return p->area > q->area ? -1 : 1;
    return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

// Twice the area along the normal.
static struct vec3 normal_of(const struct merge *m, uint32_t t)
{
    const uint32_t *c = m->in->corners + 3 * (size_t)t;
    struct vec3 o = m->points[c[0]];
    return vec3_cross(vec3_sub(m->points[c[1]], o), vec3_sub(m->points[c[2]], o));
}

// All around a triangle that is in its plane joins it. Returns how many are in a face then.
static uint32_t spread(struct merge *m, uint32_t first, uint32_t done)
{
    const uint32_t *corners = m->in->corners;
    struct vec3 o = m->points[corners[3 * first]], normal = vec3_normalized(normal_of(m, first));
    m->face[first] = first;
    m->members[done++] = first;
    if (!(vec3_dot(normal, normal) > 0.5)) // without area
        return done;
    for (uint32_t i = done - 1; i < done; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = m->beyond[3 * m->members[i] + k], t = other / 3;
            struct vec3 tip = m->points[corners[after(after(other))]];
            if (m->face[t] != NONE || fabs(vec3_dot(normal, vec3_sub(tip, o))) > m->flat)
                continue;
            m->face[t] = first;
            m->members[done++] = t;
        }
    return done;
}

// The sides of a face's triangles with another face beyond them are its ring. False when they are
// not one.
static bool add_ring(struct merge *m, uint32_t from, uint32_t to, struct hull_faces *out)
{
    const uint32_t *corners = m->in->corners;
    uint32_t sides = 0, first = 0, face = m->face[m->members[from]];
    for (uint32_t i = from; i < to; i++)
        for (uint32_t side = 3 * m->members[i]; side < 3 * m->members[i] + 3; side++) {
            if (m->face[m->beyond[side] / 3] == face)
                continue;
            first = corners[side];
            m->next[first] = corners[after(side)];
            sides++;
        }
    array_reserve(&out->corners, &out->corner_room, (size_t)out->corner_count + sides);
    array_reserve(&out->ends, &out->face_room, (size_t)out->face_count + 1);
    uint32_t at = first;
    for (uint32_t i = 0; i < sides; i++) {
        out->corners[out->corner_count++] = at;
        at = m->next[at];
        if ((at == first) != (i + 1 == sides))
            return false;
    }
    out->ends[out->face_count++] = out->corner_count;
    return sides >= 3;
}

// Large triangles first, whose planes are the surest.
static bool merge_all(struct merge *m, struct hull_faces *out)
{
    uint32_t count = m->in->face_count, done = 0;
    struct sized *order = mem_alloc(count * sizeof *order);
    bool ok = true;
    for (uint32_t t = 0; t < count; t++) {
        order[t] = (struct sized){vec3_length(normal_of(m, t)), t};
        m->face[t] = NONE;
    }
    qsort(order, count, sizeof *order, compare_sized);
    for (uint32_t i = 0; i < count; i++)
        if (m->face[order[i].triangle] == NONE)
            done = spread(m, order[i].triangle, done);
    for (uint32_t from = 0, to; from < count && ok; from = to) {
        for (to = from + 1; to < count && m->face[m->members[to]] == m->face[m->members[from]];)
            to++;
        ok = add_ring(m, from, to, out);
    }
    free(order);
    return ok;
}

bool hull_merge(struct hull_faces *out, const struct hull_faces *triangles,
                const struct vec3 *points, uint32_t count, double flat)
{
    struct merge m = {.in = triangles, .points = points, .flat = flat};
    m.beyond = mem_alloc(triangles->corner_count * sizeof *m.beyond);
    m.face = mem_alloc(triangles->face_count * sizeof *m.face);
    m.members = mem_alloc(triangles->face_count * sizeof *m.members);
    m.next = mem_zalloc(count * sizeof *m.next);
    bool ok = find_neighbours(&m) && merge_all(&m, out);
    free(m.beyond);
    free(m.face);
    free(m.members);
    free(m.next);
    return ok;
}
