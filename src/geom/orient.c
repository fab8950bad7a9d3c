// orient.c - turning triangles so that all of a closed mesh face the same way.
#include "geom/orient.h"

#include "base/hash.h"
#include "geom/mesh.h"

#include <stdlib.h>
#include <string.h>

// The side of a triangle that starts at its corner `side % 3`; a side has one partner, the side of
// the neighbour along the same edge.
struct sides {
    const struct mesh *mesh;
    uint32_t *partner;
    uint32_t count; // 3 per triangle
};
#define NO_SIDE UINT32_MAX

static uint32_t start_of(const struct sides *s, uint32_t side)
{
    return s->mesh->triangles[side / 3][side % 3];
}

static uint32_t end_of(const struct sides *s, uint32_t side)
{
    return s->mesh->triangles[side / 3][(side + 1) % 3];
}

// Neighbours that agree run along their edge in opposite directions.
static bool agrees(const struct sides *s, uint32_t side)
{
    return start_of(s, side) != start_of(s, s->partner[side]);
}

static bool same_edge(const struct sides *s, uint32_t a, uint32_t b)
{
    return (start_of(s, a) == start_of(s, b) && end_of(s, a) == end_of(s, b)) ||
           (start_of(s, a) == end_of(s, b) && end_of(s, a) == start_of(s, b));
}

static uint64_t edge_hash(uint32_t a, uint32_t b)
{
    return hash_mix(a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a);
}

// Pairs the sides. False when an edge has not exactly two of them.
static bool find_partners(struct sides *s)
{
    size_t size = 16;
    while (size < (size_t)s->count * 2)
        size *= 2;
    uint32_t *slots = mem_alloc(size * sizeof *slots);
    for (size_t i = 0; i < size; i++)
        slots[i] = NO_SIDE;
    uint32_t open = 0;
    bool fine = true;
    for (uint32_t i = 0; i < s->count; i++)
        s->partner[i] = NO_SIDE;
    for (uint32_t i = 0; i < s->count && fine; i++) {
        size_t at = edge_hash(start_of(s, i), end_of(s, i)) & (size - 1);
        while (slots[at] != NO_SIDE && !same_edge(s, slots[at], i))
            at = (at + 1) & (size - 1);
        uint32_t other = slots[at];
        if (other == NO_SIDE) {
            slots[at] = i;
            open++;
            continue;
        }
        fine = s->partner[other] == NO_SIDE;
        s->partner[other] = i;
        s->partner[i] = other;
        open--;
    }
    free(slots);
    return fine && !open;
}

static void turn(struct mesh *m, uint32_t triangle)
{
    uint32_t *t = m->triangles[triangle], swap = t[1];
    t[1] = t[2];
    t[2] = swap;
}

// Six times the volume between the triangle and a point.
static double volume_at(const struct mesh *m, uint32_t triangle, struct vec3 o)
{
    const uint32_t *t = m->triangles[triangle];
    struct vec3 a = vec3_sub(m->vertices[t[0]], o), b = vec3_sub(m->vertices[t[1]], o);
    return vec3_dot(vec3_cross(a, b), vec3_sub(m->vertices[t[2]], o));
}

enum { UNSEEN, KEPT, TURNED };

// Gathers the component of a triangle in `found` and decides which of it turn for neighbours to
// agree. False when none has to, or when no choice makes all agree, as on a Klein bottle.
static bool decide(const struct sides *s, uint32_t first, unsigned char *state, uint32_t *found,
                   uint32_t *count)
{
    bool mixed = false, possible = true;
    *count = 0;
    found[(*count)++] = first;
    state[first] = KEPT;
    for (uint32_t done = 0; done < *count; done++) {
        uint32_t t = found[done];
        for (uint32_t side = 3 * t; side < 3 * t + 3; side++) {
            uint32_t other = s->partner[side] / 3;
            unsigned char wanted = agrees(s, side) == (state[t] == KEPT) ? KEPT : TURNED;
            mixed |= !agrees(s, side);
            if (state[other] == UNSEEN) {
                state[other] = wanted;
                found[(*count)++] = other;
            }
            possible &= state[other] == wanted;
        }
    }
    return mixed && possible;
}

static void turn_component(struct mesh *m, const unsigned char *state, const uint32_t *found,
                           uint32_t count)
{
    struct vec3 o = m->vertices[m->triangles[found[0]][0]];
    double volume = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (state[found[i]] == TURNED)
            turn(m, found[i]);
        volume += volume_at(m, found[i], o);
    }
    if (!m->turned)
        m->turned = mem_zalloc(m->face_count);
    for (uint32_t i = 0; i < count; i++) {
        if (volume < 0)
            turn(m, found[i]);
        m->turned[m->faces[found[i]]] = (state[found[i]] == TURNED) != (volume < 0);
    }
}

static void orient_components(struct mesh *m, const struct sides *s)
{
    unsigned char *state = mem_zalloc(m->triangle_count);
    uint32_t *found = mem_alloc(m->triangle_count * sizeof *found), count;
    for (uint32_t i = 0; i < m->triangle_count; i++)
        if (state[i] == UNSEEN && decide(s, i, state, found, &count))
            turn_component(m, state, found, count);
    free(found);
    free(state);
}

static bool orient_closed(struct mesh *m)
{
    struct sides s = {.mesh = m, .count = 3 * m->triangle_count};
    s.partner = mem_alloc(s.count * sizeof *s.partner);
    bool closed = find_partners(&s);
    if (closed)
        orient_components(m, &s);
    free(s.partner);
    return closed;
}

// The corners of a triangle in ascending order, then its number.
struct corners {
    uint32_t sorted[3], number;
};

static int compare_corners(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    for (int i = 0; i < 4; i++)
        if (p[i] != q[i])
            return p[i] < q[i] ? -1 : 1;
    return 0;
}

// Makes triangles that repeat an earlier one points, which mesh_drop_unused drops. Returns their
// number.
static uint32_t collapse_repeated(struct mesh *m)
{
    uint32_t n = m->triangle_count, repeated = 0;
    struct corners *list = mem_alloc(n * sizeof *list);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t *t = m->triangles[i];
        uint32_t low = t[0] < t[1] ? t[0] : t[1], high = t[0] < t[1] ? t[1] : t[0];
        list[i] = (struct corners){{low < t[2] ? low : t[2],
                                    t[2] < low    ? low
                                    : t[2] > high ? high
                                                  : t[2],
                                    high > t[2] ? high : t[2]},
                                   i};
    }
    qsort(list, n, sizeof *list, compare_corners);
    for (uint32_t i = 1; i < n; i++)
        if (!memcmp(list[i].sorted, list[i - 1].sorted, sizeof list[i].sorted)) {
            uint32_t *t = m->triangles[list[i].number];
            t[1] = t[2] = t[0];
            repeated++;
        }
    free(list);
    return repeated;
}

void mesh_orient(struct mesh *m)
{
    if (!m->triangle_count || m->triangle_count > UINT32_MAX / 3 || orient_closed(m))
        return;
    if (!collapse_repeated(m))
        return;
    mesh_drop_unused(m);
    orient_closed(m);
}
