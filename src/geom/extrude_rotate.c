// extrude_rotate.c - solids from flat shapes that turn around the z axis.
#include "base/angle.h"
#include "geom/extrude_parts.h"

#include <stdlib.h>

struct turn {
    struct rings rings;
    uint32_t bands;
    double start, angle; // degrees from +x
    bool full;           // the last ring is the first one
};

static void add_ring(struct turn *t, uint32_t ring)
{
    const struct outline *o = t->rings.o;
    double angle = t->start + t->angle * ring / t->bands;
    double sine = sin_degrees(angle), cosine = cos_degrees(angle);
    for (uint32_t i = 0; i < o->point_count; i++) {
        struct vec2 p = o->points[i];
        mesh_add_vertex(&t->rings.b, (struct vec3){p.x * cosine, p.x * sine, p.y});
    }
}

// The sides of a path between a ring and the next one. Each is flat: its edges in the rings' planes
// meet the axis in one point, or run along it.
static void add_band(struct turn *t, uint32_t ring, uint32_t next, uint32_t begin, uint32_t end,
                     bool reversed)
{
    struct mesh_builder *b = &t->rings.b;
    uint32_t here = ring * t->rings.o->point_count, there = next * t->rings.o->point_count;
    for (uint32_t i = begin; i < end; i++) {
        uint32_t j = i + 1 < end ? i + 1 : begin, face = mesh_add_face(b);
        uint32_t middle[2] = {reversed ? here + j : there + i, reversed ? there + i : here + j};
        mesh_add_triangle(b, here + i, middle[0], there + j, face);
        mesh_add_triangle(b, here + i, there + j, middle[1], face);
    }
}

static void build(struct mesh *out, struct turn *t, bool reversed)
{
    rings_reserve(&t->rings, t->bands);
    uint32_t last = t->full ? t->bands - 1 : t->bands;
    for (uint32_t ring = 0; ring <= last; ring++)
        add_ring(t, ring);
    if (!t->full) {
        rings_cap(&t->rings, 0, reversed);
        rings_cap(&t->rings, last, !reversed);
    }
    const struct outline *o = t->rings.o;
    for (uint32_t path = 0, begin = 0; path < o->path_count; begin = o->ends[path++])
        for (uint32_t ring = 0; ring < t->bands; ring++)
            add_band(t, ring, ring < last ? ring + 1 : 0, begin, o->ends[path], reversed);
    rings_finish(&t->rings, out);
}

bool extrude_rotate(struct mesh *out, const struct outline *o, const struct rotation_extrusion *how,
                    struct error *err)
{
    *out = (struct mesh){0};
    double low = 0, high = 0;
    for (uint32_t i = 0; i < o->point_count; i++) {
        low = fmin(low, o->points[i].x);
        high = fmax(high, o->points[i].x);
    }
    if (low < 0 && high > 0) {
        error_set(err, "the shape lies on both sides of the axis: x from %g to %g", low, high);
        return false;
    }
    if (!o->path_count || how->angle == 0 || !isfinite(how->angle + how->start) ||
        !rings_are_finite(o))
        return true;

    struct detail detail = how->detail;
    if (how->newer && detail.fn > 0)
        detail.fn = ceil(detail.fn);
    struct turn t = {.rings = {.o = o},
                     .start = how->start,
                     .full = fabs(how->angle) >= 360,
                     .angle = fmax(-360, fmin(360, how->angle))};
    double bands = fmax(circle_fragments(high - low, detail) * fabs(t.angle) / 360, 1);
    bands = how->newer ? ceil(bands) : trunc(bands);
    if (!rings_fit(o, bands, err))
        return false;
    t.bands = (uint32_t)bands;
    if (!how->newer) {
        t.start = t.full ? 180 : 0;
        t.angle = t.full ? -360 : t.angle;
    }
    build(out, &t, (low < 0) != (t.angle < 0));
    return true;
}
