// extrude_edges.c - long edges cut before they are twisted and scaled, as newer OpenSCADs do it.
#include "base/angle.h"
#include "geom/extrude_parts.h"

#include <stdlib.h>

// The edges of one path, of which number i goes from point i to the next.
struct edges {
    const struct vec2 *points;
    uint32_t count;
    double *lengths;  // the largest of all slices
    uint32_t *pieces; // to cut into
    uint32_t *heap;   // numbers of edges, the one to be cut first at 0
};

static struct vec2 edge_end(const struct edges *e, uint32_t i)
{
    return e->points[i + 1 < e->count ? i + 1 : 0];
}

static void measure(struct edges *e, const struct linear_extrusion *how, uint32_t slices)
{
    bool uniform = how->scale_x == how->scale_y;
    for (uint32_t i = 0; i < e->count; i++) {
        struct vec2 p = e->points[i], q = edge_end(e, i);
        double dx = q.x - p.x, dy = q.y - p.y;
        e->lengths[i] = uniform ? sqrt(dx * dx + dy * dy) * fmax(how->scale_x, 1) : 0;
    }
    if (uniform)
        return;
    for (uint32_t s = 0; s <= slices; s++) {
        double t = (double)s / slices, angle = -how->twist * t;
        double sine = sin_degrees(angle), cosine = cos_degrees(angle);
        double x = (1 - t) + t * how->scale_x, y = (1 - t) + t * how->scale_y;
        for (uint32_t i = 0; i < e->count; i++) {
            struct vec2 p = e->points[i], q = edge_end(e, i);
            double dx = (x * cosine * q.x - x * sine * q.y) - (x * cosine * p.x - x * sine * p.y);
            double dy = (y * sine * q.x + y * cosine * q.y) - (y * sine * p.x + y * cosine * p.y);
            e->lengths[i] = fmax(e->lengths[i], sqrt(dx * dx + dy * dy));
        }
    }
}

// The mean of the lengths of the pieces before and after one more cut.
static double urgency(const struct edges *e, uint32_t edge)
{
    return e->lengths[edge] / (e->pieces[edge] + 0.5);
}

static void heap_sink(const struct edges *e, uint32_t at, uint32_t count)
{
    uint32_t moved = e->heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && urgency(e, e->heap[child + 1]) > urgency(e, e->heap[child]))
            child++;
        if (urgency(e, moved) >= urgency(e, e->heap[child]))
            break;
        e->heap[at] = e->heap[child];
    }
    e->heap[at] = moved;
}

static void heap_rise(const struct edges *e, uint32_t at)
{
    uint32_t moved = e->heap[at];
    while (at > 0 && urgency(e, e->heap[(at - 1) / 2]) < urgency(e, moved)) {
        e->heap[at] = e->heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    e->heap[at] = moved;
}

// Takes the most urgent edge and all within 0.1 % of it off the heap; they stand behind its rest
// then. Returns how many remain.
static uint32_t take_group(const struct edges *e)
{
    uint32_t rest = e->count;
    double first = urgency(e, e->heap[0]);
    while (rest > 0 && (rest == e->count || urgency(e, e->heap[0]) / first >= 0.999)) {
        uint32_t taken = e->heap[0];
        e->heap[0] = e->heap[--rest];
        e->heap[rest] = taken;
        if (rest > 0)
            heap_sink(e, 0, rest);
    }
    return rest;
}

// Edges of the same length are cut together or not at all, which keeps symmetries.
static void cut_to_number(struct edges *e, double number)
{
    double total = e->count;
    for (uint32_t i = 0; i < e->count; i++) {
        e->pieces[i] = 1;
        e->heap[i] = i;
    }
    for (uint32_t i = e->count / 2; i > 0; i--)
        heap_sink(e, i - 1, e->count);
    while (total < number && urgency(e, e->heap[0]) > 0) {
        uint32_t rest = take_group(e);
        total += e->count - rest;
        if (total > number)
            break;
        for (; rest < e->count; rest++) {
            e->pieces[e->heap[rest]]++;
            heap_rise(e, rest);
        }
    }
}

// False, and nothing done, when that makes `most` points or more.
static bool cut_to_length(struct edges *e, double length, double most)
{
    double total = 0;
    for (uint32_t i = 0; i < e->count; i++)
        total += ceil(e->lengths[i] / length);
    if (!(total < most))
        return false;
    for (uint32_t i = 0; i < e->count; i++)
        e->pieces[i] = (uint32_t)fmax(ceil(e->lengths[i] / length), 1);
    return true;
}

static void add_path(struct outline *out, const struct edges *e)
{
    for (uint32_t i = 0; i < e->count; i++) {
        struct vec2 p = e->points[i], q = edge_end(e, i);
        for (uint32_t k = 0; k < e->pieces[i]; k++) {
            double t = (double)k / e->pieces[i];
            outline_add(out, (struct vec2){(1 - t) * p.x + t * q.x, (1 - t) * p.y + t * q.y});
        }
    }
    outline_close(out);
}

bool linear_cut_edges(struct outline *out, const struct outline *o,
                      const struct linear_extrusion *how, uint32_t slices, double most)
{
    struct detail d = how->detail;
    bool by_number = how->segments_given || d.fn > 0;
    double number = how->segments_given ? how->segments : d.fn > 0 ? d.fn : ceil(360 / d.fa);
    struct edges e = {
        .lengths = mem_alloc(o->point_count * sizeof *e.lengths),
        .pieces = mem_alloc(o->point_count * sizeof *e.pieces),
        .heap = mem_alloc(o->point_count * sizeof *e.heap),
    };
    bool fits = true;
    for (uint32_t path = 0, begin = 0; path < o->path_count && fits; begin = o->ends[path++]) {
        e.points = o->points + begin;
        e.count = o->ends[path] - begin;
        measure(&e, how, slices);
        if (by_number || e.count >= number || !cut_to_length(&e, d.fs, number))
            cut_to_number(&e, fmin(number, most + e.count + 1)); // enough to be refused
        add_path(out, &e);
        fits = out->point_count <= most;
    }
    free(e.lengths);
    free(e.pieces);
    free(e.heap);
    out->clean = o->clean;
    if (!fits)
        outline_free(out);
    return fits;
}
