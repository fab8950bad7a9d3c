// outline.c - flat shapes: closed paths in the plane.
#include "geom/outline.h"

#include "base/hash.h"
#include "base/mem.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static uint32_t last_end(const struct outline *o)
{
    return o->path_count ? o->ends[o->path_count - 1] : 0;
}

void outline_add(struct outline *o, struct vec2 p)
{
    array_reserve(&o->points, &o->point_room, (size_t)o->point_count + 1);
    o->points[o->point_count++] = p;
}

void outline_close(struct outline *o)
{
    uint32_t begin = last_end(o);
    if (o->point_count - begin < 3) {
        o->point_count = begin;
        return;
    }
    array_reserve(&o->ends, &o->path_room, (size_t)o->path_count + 1);
    o->ends[o->path_count++] = o->point_count;
}

void outline_append(struct outline *o, const struct outline *more)
{
    uint32_t base = last_end(o), points = last_end(more), paths = more->path_count;
    assert(o->point_count == base); // no path is being made
    if (!paths)
        return;
    array_reserve(&o->points, &o->point_room, (size_t)base + points);
    array_reserve(&o->ends, &o->path_room, (size_t)o->path_count + paths);
    memcpy(o->points + base, more->points, points * sizeof *o->points);
    for (uint32_t i = 0; i < paths; i++)
        o->ends[o->path_count + i] = base + more->ends[i];
    o->point_count = base + points;
    o->path_count += paths;
}

void outline_copy(struct outline *out, const struct outline *o)
{
    *out = (struct outline){.clean = o->clean};
    outline_append(out, o);
}

void outline_free(struct outline *o)
{
    free(o->points);
    free(o->ends);
    *o = (struct outline){0};
}

void outline_transform(struct outline *o, const struct affine *a)
{
    const double(*m)[4] = a->m;
    for (uint32_t i = 0; i < o->point_count; i++) {
        struct vec2 p = o->points[i];
        o->points[i] = (struct vec2){m[0][0] * p.x + m[0][1] * p.y + m[0][3],
                                     m[1][0] * p.x + m[1][1] * p.y + m[1][3]};
    }
    // Mirrored paths run the wrong way round, flattened ones lie on each other.
    if (!(m[0][0] * m[1][1] - m[0][1] * m[1][0] > 0))
        o->clean = false;
}

struct box outline_bounds(const struct outline *o)
{
    struct box b = BOX_EMPTY;
    for (uint32_t i = 0; i < o->point_count; i++)
        b = box_of_point(b, (struct vec3){o->points[i].x, o->points[i].y, 0});
    return b;
}

static struct vec2 step(struct vec2 from, struct vec2 to)
{
    return (struct vec2){to.x - from.x, to.y - from.y};
}

static double cross(struct vec2 a, struct vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

double outline_area(const struct outline *o)
{
    double twice = 0;
    for (uint32_t path = 0, begin = 0; path < o->path_count; begin = o->ends[path++]) {
        struct vec2 origin = o->points[begin]; // near the path, for accuracy far from (0, 0)
        for (uint32_t i = begin + 2; i < o->ends[path]; i++)
            twice += cross(step(origin, o->points[i - 1]), step(origin, o->points[i]));
    }
    return twice / 2;
}

// Does the direction point up, or level to the right?
static bool is_upward(struct vec2 d)
{
    return d.y > 0 || (d.y == 0 && d.x > 0);
}

// The side of a single path that ends at point i.
static struct vec2 side(const struct outline *o, uint32_t i)
{
    return step(o->points[i ? i - 1 : o->ends[0] - 1], o->points[i]);
}

bool outline_is_convex(const struct outline *o)
{
    if (o->path_count != 1)
        return false;
    uint32_t n = o->ends[0];
    struct vec2 before = {0, 0};
    for (uint32_t i = n; i > 0 && before.x == 0 && before.y == 0; i--)
        before = side(o, i - 1);
    // Without right turns the directions go round at least once. More than once, and the path
    // crosses itself: then they pass +x more often.
    uint32_t rounds = 0;
    for (uint32_t i = 0; i < n; i++) {
        struct vec2 along = side(o, i);
        if (along.x == 0 && along.y == 0)
            continue;
        double turn = cross(before, along);
        bool ahead = before.x * along.x + before.y * along.y > 0;
        if (!(turn > 0 || (turn == 0 && ahead)))
            return false;
        rounds += !is_upward(before) && is_upward(along);
        before = along;
    }
    return rounds == 1;
}

uint64_t outline_hash(const struct outline *o)
{
    uint64_t h = hash_bytes(o->clean, o->ends, o->path_count * sizeof *o->ends);
    return hash_bytes(h, o->points, last_end(o) * sizeof *o->points);
}
