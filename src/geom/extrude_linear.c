// extrude_linear.c - solids from flat shapes that rise, turn and shrink, and plates.
#include "base/angle.h"
#include "geom/extrude_parts.h"

#include <stdlib.h>

struct rise {
    struct rings rings;
    const struct linear_extrusion *how;
    double scale_x, scale_y;
    struct vec3 low, high; // where the origin of the outline goes
    uint32_t slices;
    bool convex;
    uint32_t sides;             // convex: the first face of them
    struct vec2 *lower, *upper; // the outline as it is below and above the slice at work
};

// One slice of the side that stands on an edge.
struct quad {
    uint32_t prev1, curr1, prev2, curr2; // below, above
    uint32_t face;                       // of a convex solid
    bool flat;
};

static struct vec2 scale_at(const struct rise *r, uint32_t ring)
{
    return (struct vec2){1 - (1 - r->scale_x) * ring / r->slices,
                         1 - (1 - r->scale_y) * ring / r->slices};
}

static double angle_at(const struct rise *r, uint32_t ring)
{
    return r->how->twist * ring / r->slices;
}

// The outline as it is at a ring goes to `upper` and into the mesh; the last one becomes `lower`.
static void add_ring(struct rise *r, uint32_t ring)
{
    struct vec2 *flat = r->lower, scale = scale_at(r, ring);
    r->lower = r->upper;
    r->upper = flat;
    double sine = sin_degrees(-angle_at(r, ring)), cosine = cos_degrees(-angle_at(r, ring));
    struct vec3 way = vec3_scale(vec3_sub(r->high, r->low), (double)ring);
    struct vec3 at = vec3_add(r->low, vec3_scale(way, 1.0 / r->slices));
    if (ring == r->slices)
        at = r->high;
    for (uint32_t i = 0; i < r->rings.o->point_count; i++) {
        struct vec2 p = r->rings.o->points[i];
        flat[i] = (struct vec2){scale.x * cosine * p.x - scale.x * sine * p.y,
                                scale.y * sine * p.x + scale.y * cosine * p.y};
        mesh_add_vertex(&r->rings.b, (struct vec3){at.x + flat[i].x, at.y + flat[i].y, at.z});
    }
}

// -1, 0, 1 as the line a - b is shorter than c - d, about as long, longer.
static int compare_lengths(struct vec2 a, struct vec2 b, struct vec2 c, struct vec2 d)
{
    double first = sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
    double second = sqrt((c.x - d.x) * (c.x - d.x) + (c.y - d.y) * (c.y - d.y));
    if (!(2 * fabs(first - second) * 1e5 > first + second))
        return 0;
    return first < second ? -1 : 1;
}

static void add_quad(struct rise *r, const struct quad *q, bool from_prev1)
{
    struct mesh_builder *b = &r->rings.b;
    uint32_t face = r->convex ? q->face : mesh_add_face(b);
    uint32_t second = r->convex || q->flat ? face : mesh_add_face(b);
    if (from_prev1) {
        mesh_add_triangle(b, q->curr1, q->curr2, q->prev1, face);
        mesh_add_triangle(b, q->prev2, q->prev1, q->curr2, second);
    } else {
        mesh_add_triangle(b, q->curr1, q->prev2, q->prev1, face);
        mesh_add_triangle(b, q->curr1, q->curr2, q->prev2, second);
    }
}

// The sides of one path between the rings `top` - 1 and `top`, along the shorter diagonals as seen
// from above. At a scale of 0 these would give folded sheets: there the longer ones are taken.
static void add_band(struct rise *r, uint32_t top, uint32_t begin, uint32_t end, bool hole)
{
    const struct outline *o = r->rings.o;
    struct vec2 scale = scale_at(r, top);
    bool to_line = scale.x == 0 || scale.y == 0;
    bool backward = angle_at(r, top) <= angle_at(r, top - 1);
    bool bends = r->how->twist != 0 || r->scale_x != r->scale_y;
    uint32_t below = (top - 1) * o->point_count, above = top * o->point_count;
    for (uint32_t i = begin; i < end; i++) {
        uint32_t j = i + 1 < end ? i + 1 : begin;
        int order = compare_lengths(r->lower[i], r->upper[j], r->lower[j], r->upper[i]);
        bool from_prev1 = order < 0 || (order == 0 && hole == backward);
        bool along_axis = o->points[i].x == o->points[j].x || o->points[i].y == o->points[j].y;
        struct quad q = {below + i, below + j,    above + i,
                         above + j, r->sides + i, !bends || (r->how->twist == 0 && along_axis)};
        add_quad(r, &q, from_prev1 != to_line);
    }
}

static double path_area(const struct outline *o, uint32_t begin, uint32_t end)
{
    struct outline path = {.points = o->points + begin,
                           .ends = &(uint32_t){end - begin},
                           .point_count = end - begin,
                           .path_count = 1};
    return outline_area(&path);
}

// Faces come in OpenSCAD's order, by which it draws what can be seen through: bottom, top, sides.
static void build(struct mesh *out, struct rise *r)
{
    const struct outline *o = r->rings.o;
    rings_reserve(&r->rings, r->slices);
    r->lower = mem_alloc(o->point_count * sizeof *r->lower);
    r->upper = mem_alloc(o->point_count * sizeof *r->upper);
    bool *holes = mem_alloc(o->path_count * sizeof *holes);
    for (uint32_t path = 0, begin = 0; path < o->path_count; begin = o->ends[path++])
        holes[path] = path_area(o, begin, o->ends[path]) < 0;

    rings_cap(&r->rings, 0, true);
    rings_cap(&r->rings, r->slices, false);
    r->sides = r->rings.b.mesh.face_count;
    if (r->convex) // one face for all slices of a side
        r->rings.b.mesh.face_count += o->point_count;
    add_ring(r, 0);
    for (uint32_t top = 1; top <= r->slices; top++) {
        add_ring(r, top);
        for (uint32_t path = 0, begin = 0; path < o->path_count; begin = o->ends[path++])
            add_band(r, top, begin, o->ends[path], holes[path]);
    }
    free(holes);
    free(r->lower);
    free(r->upper);
    rings_finish(&r->rings, out);
}

bool extrude_linear(struct mesh *out, const struct outline *o, const struct linear_extrusion *given,
                    bool *convex, struct error *err)
{
    *out = (struct mesh){0};
    *convex = false;
    struct linear_extrusion how = *given;
    how.scale_x = fmax(how.scale_x, 0);
    how.scale_y = fmax(how.scale_y, 0);
    struct vec3 way = how.has_direction ? how.direction : (struct vec3){0, 0, how.height};
    if (!o->path_count || !(way.z > 0) || !rings_are_finite(o) ||
        !isfinite(way.x + way.y + way.z + how.twist + how.scale_x + how.scale_y))
        return true;

    double slices = how.slices ? how.slices : linear_slices(o, &how);
    if (!rings_fit(o, slices, err))
        return false;
    bool bends = how.twist != 0 || how.scale_x != how.scale_y;
    struct outline cut = {0};
    const struct outline *used = o;
    if (how.newer && (how.segments_given ? how.segments > 0 : bends)) {
        double most = EXTRUSION_TRIANGLES_MOST / (2 * (slices + 1));
        if (!linear_cut_edges(&cut, o, &how, (uint32_t)slices, most))
            return rings_fit(o, INFINITY, err);
        used = &cut;
    }
    struct rise r = {.rings = {.o = used},
                     .how = &how,
                     .scale_x = how.scale_x,
                     .scale_y = how.scale_y,
                     .slices = (uint32_t)slices,
                     .high = way};
    if (how.center) {
        r.high = vec3_scale(way, 0.5);
        r.low = vec3_scale(way, -0.5);
    }
    r.convex = *convex = !bends && outline_is_convex(used);
    build(out, &r);
    outline_free(&cut);
    return true;
}

void extrude_slab(struct mesh *out, const struct outline *o, double low, double high, bool *convex)
{
    *out = (struct mesh){0};
    *convex = false;
    if (!o->path_count || !rings_are_finite(o))
        return;
    struct rise r = {.rings = {.o = o},
                     .how = &(struct linear_extrusion){0},
                     .scale_x = 1,
                     .scale_y = 1,
                     .low = {0, 0, low},
                     .high = {0, 0, high},
                     .slices = 1,
                     .convex = outline_is_convex(o)};
    *convex = r.convex;
    build(out, &r);
}
