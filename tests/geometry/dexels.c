// dexels.c - solids as what parallel rays along an axis meet.
#include "dexels.h"

#include "base/mem.h"

#include <math.h>
#include <stdlib.h>

static void dexels_init(struct dexels *d)
{
    size_t count = (size_t)DEXELS_SIDE * DEXELS_SIDE;
    d->length = mem_zalloc(count * sizeof *d->length);
    d->crossings = mem_zalloc(count * sizeof *d->crossings);
}

void dexels_free(struct dexels *d)
{
    free(d->length);
    free(d->crossings);
    *d = (struct dexels){0};
}

static double part(struct vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static struct vec3 along(int axis, double length)
{
    return (struct vec3){axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

struct rays dexels_rays(struct box box, int axis)
{
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    struct vec3 size = vec3_sub(box.max, box.min);
    double step = fmax(part(size, u), part(size, v)) / (DEXELS_SIDE - 0.62871);
    double margin = 1 + part(size, axis);
    struct vec3 origin = vec3_add(along(u, part(box.min, u) + 0.193817 * step),
                                  along(v, part(box.min, v) + 0.187193 * step));
    return (struct rays){.orthographic = true,
                         .origin = vec3_add(origin, along(axis, part(box.min, axis) - margin)),
                         .forward = along(axis, 1),
                         .step_x = along(u, step),
                         .step_y = along(v, step),
                         .width = DEXELS_SIDE,
                         .height = DEXELS_SIDE,
                         .near = 0,
                         .far = part(size, axis) + 2 * margin,
                         .reference = part(size, axis) / 2 + margin};
}

static void take_spans(void *context, uint32_t worker, const struct span_block *b)
{
    struct dexels *d = context;
    (void)worker;
    uint32_t i = 0;
    for (int y = b->y0; y < b->y1; y++)
        for (int x = b->x0; x < b->x1; x++, i++)
            for (uint32_t s = b->first[i]; s < b->first[i + 1]; s++) {
                size_t at = (size_t)y * DEXELS_SIDE + (size_t)x;
                d->length[at] += (double)b->spans[s].leave - (double)b->spans[s].enter;
                d->crossings[at] += 2;
            }
}

void dexels_of_body(struct dexels *out, const struct body *body, const struct rays *rays,
                    double epsilon)
{
    const struct render_settings settings = {.epsilon = epsilon, .threads = 1};
    struct render_stats stats = {0};
    struct device *device = cpu_device_new();
    dexels_init(out);
    device_spans(device, body, rays, &settings, take_spans, out, &stats);
    device_delete(device);
}

// Of a mesh with a ray. steep: cosine between ray and normal, positive where the solid ends.
struct crossing {
    uint32_t pixel;
    double z, steep;
};

struct crossings {
    struct crossing *items;
    uint32_t count, room;
};

// A corner in pixels, and its depth.
struct corner {
    double x, y, z;
};

// Where the edge is at row y: the same numbers whichever of its two triangles asks.
static double edge_at(const struct corner *a, const struct corner *b, double y)
{
    if (a->y > b->y || (a->y == b->y && a->x > b->x)) {
        const struct corner *swap = a;
        a = b;
        b = swap;
    }
    return a->x + (b->x - a->x) * ((y - a->y) / (b->y - a->y));
}

static void add_crossing(struct crossings *c, uint32_t pixel, double z, double steep)
{
    array_reserve(&c->items, &c->room, (size_t)c->count + 1);
    c->items[c->count++] = (struct crossing){.pixel = pixel, .z = z, .steep = steep};
}

// Adds the triangle's crossing with each ray: what is solid begins where it faces the eye.
static void add_triangle(struct crossings *out, const struct corner c[3], double steep)
{
    double ux = c[1].x - c[0].x, uy = c[1].y - c[0].y, vx = c[2].x - c[0].x, vy = c[2].y - c[0].y;
    double twice = ux * vy - uy * vx;
    if (twice == 0)
        return;
    double zx = ((c[1].z - c[0].z) * vy - (c[2].z - c[0].z) * uy) / twice;
    double zy = ((c[2].z - c[0].z) * ux - (c[1].z - c[0].z) * vx) / twice;
    int first = (int)ceil(fmin(c[0].y, fmin(c[1].y, c[2].y)));
    int last = (int)floor(fmax(c[0].y, fmax(c[1].y, c[2].y)));
    for (int y = first < 0 ? 0 : first; y <= last && y < DEXELS_SIDE; y++) {
        double from = INFINITY, to = -INFINITY;
        for (int k = 0; k < 3; k++) {
            const struct corner *a = &c[k], *b = &c[(k + 1) % 3];
            if ((a->y <= y) == (b->y <= y))
                continue;
            double x = edge_at(a, b, y);
            from = fmin(from, x);
            to = fmax(to, x);
        }
        for (int x = (int)ceil(fmax(from, 0)); x < to && x < DEXELS_SIDE; x++)
            add_crossing(out, (uint32_t)(y * DEXELS_SIDE + x),
                         c[0].z + (x - c[0].x) * zx + (y - c[0].y) * zy,
                         twice > 0 ? steep : -steep);
    }
}

static int by_depth(const void *a, const void *b)
{
    const struct crossing *p = a, *q = b;
    if (p->pixel != q->pixel)
        return p->pixel < q->pixel ? -1 : 1;
    return p->z < q->z ? -1 : p->z > q->z;
}

// Crossings in opposite directions closer than epsilon across the faces take each other away, as
// the device does it.
static void sum_crossings(struct dexels *out, struct crossings *c, double epsilon)
{
    uint32_t kept = 0;
    if (c->count)
        qsort(c->items, c->count, sizeof *c->items, by_depth);
    for (uint32_t i = 0; i < c->count; i++) {
        const struct crossing *now = &c->items[i], *last = kept ? &c->items[kept - 1] : NULL;
        if (last && last->pixel == now->pixel && (last->steep < 0) != (now->steep < 0) &&
            (now->z - last->z) * fmax(fabs(last->steep), fabs(now->steep)) < epsilon)
            kept--;
        else
            c->items[kept++] = *now;
    }
    for (uint32_t i = 0; i < kept; i++) {
        out->length[c->items[i].pixel] += c->items[i].steep > 0 ? c->items[i].z : -c->items[i].z;
        out->crossings[c->items[i].pixel]++;
    }
}

void dexels_of_mesh(struct dexels *out, const struct mesh *m, const struct rays *rays,
                    double epsilon)
{
    double step = vec3_length(rays->step_x);
    struct crossings crossings = {0};
    dexels_init(out);
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 p[3];
        struct corner c[3];
        for (int k = 0; k < 3; k++) {
            p[k] = vec3_sub(m->vertices[m->triangles[i][k]], rays->origin);
            c[k].x = vec3_dot(p[k], rays->step_x) / (step * step);
            c[k].y = vec3_dot(p[k], rays->step_y) / (step * step);
            c[k].z = vec3_dot(p[k], rays->forward) - rays->reference;
        }
        struct vec3 normal = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
        add_triangle(&crossings, c, fabs(vec3_dot(vec3_normalized(normal), rays->forward)));
    }
    sum_crossings(out, &crossings, epsilon);
    free(crossings.items);
}
