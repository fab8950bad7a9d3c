// polygon_gaps.c - triangles over a polygon's own corners where its sides seem to cross.
//
// The neighbours of a bent polygon know no corners but their common ones, so a crossing that is one
// only from where it is looked at must not become a corner. As in OpenSCAD the sides that no
// triangle has are gathered to loops and their ears cut off. It takes the ears as they lie in a
// hash table; here the shortest cut is the next.
#include "geom/polygon_gaps.h"

#include "base/mem.h"

#include <stdbool.h>
#include <stdlib.h>

enum { NONE = UINT32_MAX };

// What the triangles still to come must have on their border, in their direction.
struct border {
    uint32_t (*sides)[2];
    uint32_t count;
};

static uint32_t find(const struct border *b, uint32_t from, uint32_t to)
{
    for (uint32_t i = 0; i < b->count; i++)
        if (b->sides[i][0] == from && b->sides[i][1] == to)
            return i;
    return NONE;
}

static void take(struct border *b, uint32_t i)
{
    b->count--;
    b->sides[i][0] = b->sides[b->count][0];
    b->sides[i][1] = b->sides[b->count][1];
}

// Adds a side, or takes away the one that it closes.
static void put(struct border *b, uint32_t from, uint32_t to)
{
    uint32_t i = find(b, to, from);
    if (i != NONE) {
        take(b, i);
        return;
    }
    b->sides[b->count][0] = from;
    b->sides[b->count++][1] = to;
}

static bool is_turned(const struct border *b, const uint32_t t[3])
{
    bool turned = false;
    for (int k = 0; k < 3; k++) {
        if (find(b, t[k], t[(k + 1) % 3]) != NONE)
            return false;
        turned |= find(b, t[(k + 1) % 3], t[k]) != NONE;
    }
    return turned;
}

// Follows the sides from the last one until they return; they leave the border.
static uint32_t take_loop(struct border *b, uint32_t *loop)
{
    uint32_t n = 0, start = b->sides[b->count - 1][0], at = b->sides[b->count - 1][1];
    loop[n++] = start;
    b->count--;
    while (at != start) {
        uint32_t i = 0;
        while (i < b->count && b->sides[i][0] != at)
            i++;
        if (i == b->count)
            break;
        loop[n++] = at;
        at = b->sides[i][1];
        take(b, i);
    }
    return n;
}

static void cut_ears(const struct vec3 *v, uint32_t *loop, uint32_t n, uint32_t (*triangles)[3],
                     uint32_t *count)
{
    for (; n >= 3; n--) {
        uint32_t ear = 0;
        double best = INFINITY;
        for (uint32_t i = 0; i < n; i++) {
            struct vec3 d = vec3_sub(v[loop[(i + n - 1) % n]], v[loop[(i + 1) % n]]);
            double length2 = vec3_dot(d, d);
            if (length2 < best) {
                best = length2;
                ear = i;
            }
        }
        uint32_t *t = triangles[(*count)++];
        t[0] = loop[(ear + n - 1) % n];
        t[1] = loop[ear];
        t[2] = loop[(ear + 1) % n];
        for (uint32_t i = ear; i + 1 < n; i++)
            loop[i] = loop[i + 1];
    }
}

void polygon_fill_gaps(const struct vec3 *vertices, const uint32_t *corners, uint32_t corner_count,
                       uint32_t first_new, uint32_t (*triangles)[3], uint32_t *count)
{
    size_t most = corner_count + 3 * (size_t)*count;
    struct border b = {mem_alloc(most * sizeof *b.sides), 0};
    for (uint32_t i = 0; i < corner_count; i++)
        put(&b, corners[i], corners[(i + 1) % corner_count]);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < *count; i++) {
        uint32_t t[3] = {triangles[i][0], triangles[i][1], triangles[i][2]};
        if (t[0] >= first_new || t[1] >= first_new || t[2] >= first_new)
            continue;
        bool turned = is_turned(&b, t);
        uint32_t order[3] = {t[0], turned ? t[2] : t[1], turned ? t[1] : t[2]};
        for (int k = 0; k < 3; k++) {
            uint32_t from = order[k], to = order[(k + 1) % 3], side = find(&b, from, to);
            if (side != NONE)
                take(&b, side);
            else
                put(&b, to, from);
            triangles[kept][k] = from;
        }
        kept++;
    }
    *count = kept;
    uint32_t *loop = mem_alloc(most * sizeof *loop);
    while (b.count)
        cut_ears(vertices, loop, take_loop(&b, loop), triangles, count);
    free(loop);
    free(b.sides);
}
