// lattice.c - sums over the solid intervals that a lattice of parallel rays meets.
#include "render/lattice.h"

#include "base/hash.h"
#include "base/mem.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

// A turned picture of a long narrow side is mostly empty, so such a side is cut in pieces of about
// PIECE_ASPECT, each with a picture of its own.
enum { PIECES_MOST = 64, PIXELS_MOST = 16384, SLOPES = 1024 };
#define PIECE_ASPECT 2

// Threads add in any order. So what they add are whole numbers: parts of 2^-36 of the box, and
// 2^-32 of a cell.
#define LENGTH_UNIT 0x1p36
#define SLOPE_UNIT  0x1p32

struct worker {
    int64_t covered, length, moment[3], slopes, thin, crossings;
    struct { // |n| along the axis of faces met lately
        uint32_t leaf, face;
        double slope;
    } cache[SLOPES];
};

struct lattice_run {
    const struct lattice_target *target;
    struct rays rays;
    int along, wide, high;  // axes: of the rays, of the longer and of the shorter side of the box
    double size, reference; // extent of the box that lengths are divided by; depth of its centre
    double from, to;        // part of the longer side that counts, about the centre
    double u, u_x, u_y;     // place of pixel 0, 0 on the longer side, and its steps
    double v, v_x, v_y;     // on the shorter one
    struct worker *workers;
};

static double part(struct vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static struct vec3 along(int axis, double length)
{
    return (struct vec3){axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

static double slope_of(const struct lattice_run *r, struct worker *w, uint32_t leaf, uint32_t face)
{
    uint32_t i = (leaf * 31 + face) % SLOPES;
    if (w->cache[i].leaf != leaf || w->cache[i].face != face) {
        const struct leaf *placed = &r->target->body->leaves[leaf];
        struct vec3 n = normals_find(r->target->normals, placed, face);
        w->cache[i].leaf = leaf;
        w->cache[i].face = face;
        w->cache[i].slope = fabs(part(n, r->along));
    }
    return w->cache[i].slope;
}

// A span's end with a face: what it adds to the surface.
static double crossing(const struct lattice_run *r, struct worker *w, uint32_t leaf, uint32_t face)
{
    if (leaf == SURFACE_NONE || face == SURFACE_CAP) // only of meshes that are not closed
        return 0;
    atomic_bool *seen = &r->target->seen[leaf];
    if (!atomic_load_explicit(seen, memory_order_relaxed))
        atomic_store_explicit(seen, true, memory_order_relaxed);
    w->crossings++;
    return slope_of(r, w, leaf, face);
}

static int64_t whole(double v, double unit)
{
    return (int64_t)rint(v * unit);
}

// Between two faces that lie `distance` apart on a ray: of their slopes, what counts as thin.
static double thin(const struct lattice_run *r, double distance, double a, double b)
{
    return distance * fmax(a, b) < 2 * r->target->settings.epsilon ? a + b : 0;
}

static void take_ray(const struct lattice_run *r, struct worker *w, double u, double v,
                     const struct span *spans, uint32_t count)
{
    double length = 0, moment = 0, slopes = 0, thins = 0, last = 0, last_slope = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct span *s = &spans[i];
        double enter = (double)s->enter, leave = (double)s->leave;
        double in = crossing(r, w, s->enter_leaf, s->enter_face);
        double out = crossing(r, w, s->leave_leaf, s->leave_face);
        length += (leave - enter) / r->size;
        moment += (leave - enter) * (leave + enter) / (2 * r->size * r->size);
        slopes += in + out;
        thins += thin(r, leave - enter, in, out) + (i ? thin(r, enter - last, last_slope, in) : 0);
        last = leave;
        last_slope = out;
    }
    w->covered++;
    w->length += whole(length, LENGTH_UNIT);
    w->moment[r->along] += whole(moment, LENGTH_UNIT);
    w->moment[r->wide] += whole(length * u / r->size, LENGTH_UNIT);
    w->moment[r->high] += whole(length * v / r->size, LENGTH_UNIT);
    w->slopes += whole(slopes, SLOPE_UNIT);
    w->thin += whole(thins, SLOPE_UNIT);
}

static void take_block(void *context, uint32_t worker, const struct span_block *b)
{
    const struct lattice_run *r = context;
    uint32_t i = 0;
    for (int y = b->y0; y < b->y1; y++)
        for (int x = b->x0; x < b->x1; x++, i++) {
            double u = r->u + x * r->u_x + y * r->u_y;
            if (b->first[i] < b->first[i + 1] && u >= r->from && u < r->to)
                take_ray(r, &r->workers[worker], u, r->v + x * r->v_x + y * r->v_y,
                         b->spans + b->first[i], b->first[i + 1] - b->first[i]);
        }
}

// The rays over `width` of the longer side around `middle`, and all of the shorter one.
static void aim(struct lattice_run *r, double middle, double width, double height, double step,
                double angle, uint64_t *random)
{
    struct vec3 size = vec3_sub(r->target->box.max, r->target->box.min);
    struct vec3 centre = vec3_scale(vec3_add(r->target->box.max, r->target->box.min), 0.5);
    double c = cos(angle), s = sin(angle), margin = 0.25 * r->size;
    double half_x = (width * fabs(c) + height * fabs(s)) / 2;
    double half_y = (width * fabs(s) + height * fabs(c)) / 2;
    double x = -half_x - random_unit(random) * step, y = -half_y - random_unit(random) * step;
    r->u = middle + x * c - y * s;
    r->v = x * s + y * c;
    r->u_x = step * c;
    r->v_x = step * s;
    r->u_y = -step * s;
    r->v_y = step * c;
    r->reference = part(size, r->along) / 2 + margin;
    struct vec3 origin = vec3_add(centre, vec3_add(along(r->wide, r->u), along(r->high, r->v)));
    r->rays = (struct rays){.orthographic = true,
                            .origin = vec3_sub(origin, along(r->along, r->reference)),
                            .forward = along(r->along, 1),
                            .step_x = vec3_add(along(r->wide, r->u_x), along(r->high, r->v_x)),
                            .step_y = vec3_add(along(r->wide, r->u_y), along(r->high, r->v_y)),
                            .width = (int)(2 * half_x / step) + 2,
                            .height = (int)(2 * half_y / step) + 2,
                            .near = 0,
                            .far = 2 * r->reference,
                            .reference = r->reference};
}

static void draw(struct lattice_run *r, struct lattice_sums *out)
{
    struct render_stats stats = {0};
    device_spans(r->target->device, r->target->body, &r->rays, &r->target->settings, take_block, r,
                 &stats);
    out->effort += (double)r->rays.width * r->rays.height / 8 + (double)stats.fragments;
    out->open_rays += stats.open_rays;
}

// The side of a cell, such that a picture of a piece stays within PIXELS_MOST.
static double cell_side(double width, double height, double rays)
{
    double step = sqrt(width * height / rays);
    return fmax(step, (width + height) / PIXELS_MOST);
}

static void finish(struct lattice_sums *out, const struct lattice_run *r, uint32_t workers)
{
    struct worker sum = {0};
    for (uint32_t i = 0; i < workers; i++) {
        const struct worker *w = &r->workers[i];
        sum.covered += w->covered;
        sum.length += w->length;
        sum.slopes += w->slopes;
        sum.thin += w->thin;
        sum.crossings += w->crossings;
        for (int k = 0; k < 3; k++)
            sum.moment[k] += w->moment[k];
    }
    double volume = out->cell * r->size / LENGTH_UNIT, moment = volume * r->size;
    out->covered = out->cell * (double)sum.covered;
    out->volume = volume * (double)sum.length;
    out->moment = (struct vec3){moment * (double)sum.moment[0], moment * (double)sum.moment[1],
                                moment * (double)sum.moment[2]};
    out->area = out->cell * (double)sum.slopes / SLOPE_UNIT;
    out->thin = out->cell * (double)sum.thin / SLOPE_UNIT;
    out->crossings = (double)sum.crossings;
}

void lattice_sum(struct lattice_sums *out, const struct lattice_target *target,
                 const struct lattice *lattice)
{
    struct vec3 size = vec3_sub(target->box.max, target->box.min);
    struct lattice_run r = {.target = target, .along = lattice->axis};
    uint32_t workers = parallel_workers(target->settings.threads);
    uint64_t random = lattice->random;
    *out = (struct lattice_sums){0};
    r.wide = (lattice->axis + 1) % 3;
    r.high = (lattice->axis + 2) % 3;
    if (part(size, r.wide) < part(size, r.high)) {
        int swap = r.wide;
        r.wide = r.high;
        r.high = swap;
    }
    double width = part(size, r.wide), height = part(size, r.high);
    r.size = fmax(part(size, r.along), width);
    if (!(height > 0))
        return;
    double pieces = fmin(fmax(rint(width / height / PIECE_ASPECT), 1), PIECES_MOST);
    double step = cell_side(width / pieces, height, lattice->rays / pieces);
    out->cell = step * step;
    r.workers = mem_zalloc(workers * sizeof *r.workers);
    for (uint32_t i = 0; i < workers; i++) // a leaf of all ones is SURFACE_NONE
        memset(r.workers[i].cache, 0xff, sizeof r.workers[i].cache);
    for (double i = 0; i < pieces; i++) {
        double from = width * (i / pieces - 0.5), to = width * ((i + 1) / pieces - 0.5);
        r.from = i == 0 ? -INFINITY : from;
        r.to = i + 1 == pieces ? INFINITY : to;
        aim(&r, (from + to) / 2, to - from, height, step, lattice->angle, &random);
        draw(&r, out);
    }
    finish(out, &r, workers);
    free(r.workers);
}
