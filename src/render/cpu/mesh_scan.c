// mesh_scan.c - crossings of triangles with the rays of a block, by scan conversion.
//
// Watertight: vertices are rounded to a fixed grid of the picture and edges are tested in exact
// integers; a ray exactly on an edge counts as moved by (-e*e, +e) for an infinitely small e, which
// every edge answers alike. So a ray crosses a closed mesh consistently, whatever the triangles
// look like.
#include "render/cpu/mesh_scan.h"

#include "base/mem.h"
#include "render/depth_key.h"

#include <float.h>

enum { GRID_BITS = 18, COORDINATE_BITS = 29, STACK = 128 };

// Picture coordinates of a point p of the mesh: x = (gx.p + hx) / t, t = gt.p + ht in perspective,
// x = gx.p + hx in orthographic views; x and y are pixels times grid.
struct mesh_view {
    struct vec3 gx, gy, gt;
    double hx, hy, ht;
    int bits;    // one pixel is 2^bits grid units
    double clip; // perspective: what is nearer than this depth is cut off
    bool orthographic;
};

static void linear(const struct affine *m, struct vec3 origin, struct vec3 g, struct vec3 *local,
                   double *constant)
{
    *local = affine_normal(m, g);
    *constant = vec3_dot(g, vec3_sub((struct vec3){m->m[0][3], m->m[1][3], m->m[2][3]}, origin));
}

static struct mesh_view mesh_view(const struct frame *f, const struct leaf *leaf)
{
    const struct rays *r = f->rays;
    struct mesh_view v = {.orthographic = r->orthographic, .clip = depth_clip(r, f->t0)};
    struct vec3 sx = vec3_scale(r->step_x, 1 / vec3_dot(r->step_x, r->step_x));
    struct vec3 sy = vec3_scale(r->step_y, 1 / vec3_dot(r->step_y, r->step_y));
    if (!r->orthographic) { // forward itself is pixel (0, 0)
        sx = vec3_sub(sx, vec3_scale(f->axis, vec3_dot(r->forward, sx)));
        sy = vec3_sub(sy, vec3_scale(f->axis, vec3_dot(r->forward, sy)));
    }
    linear(&leaf->to_world, r->origin, sx, &v.gx, &v.hx);
    linear(&leaf->to_world, r->origin, sy, &v.gy, &v.hy);
    linear(&leaf->to_world, r->origin, f->axis, &v.gt, &v.ht);

    double largest = 1; // picture coordinate
    for (int i = 0; i < 8; i++) {
        struct vec3 p = box_corner(leaf->solid->bounds, i);
        double t = r->orthographic ? 1 : fmax(vec3_dot(v.gt, p) + v.ht, v.clip);
        largest = fmax(largest, fabs(vec3_dot(v.gx, p) + v.hx) / t);
        largest = fmax(largest, fabs(vec3_dot(v.gy, p) + v.hy) / t);
    }
    if (!r->orthographic) // clipped edges reach between the corners
        largest *= 2;
    v.bits = COORDINATE_BITS - 1 - ilogb(largest);
    v.bits = v.bits > GRID_BITS ? GRID_BITS : v.bits < 0 ? 0 : v.bits;
    return v;
}

struct grid_point {
    int64_t x, y;
};

static int64_t to_grid(double v)
{
    const double most = (double)(1 << COORDINATE_BITS);
    return (int64_t)rint(v > most ? most : v < -most ? -most : v);
}

static struct grid_point project(const struct mesh_view *v, struct vec3 p)
{
    double s = ldexp(1, v->bits);
    if (!v->orthographic)
        s /= vec3_dot(v->gt, p) + v->ht;
    return (struct grid_point){to_grid((vec3_dot(v->gx, p) + v->hx) * s),
                               to_grid((vec3_dot(v->gy, p) + v->hy) * s)};
}

// Which side of the line a -> b a point lies on: exact, never 0.
static int side(struct grid_point a, struct grid_point b, struct grid_point p)
{
    int flip = 1;
    if (a.x > b.x || (a.x == b.x && a.y > b.y)) {
        struct grid_point swap = a;
        a = b;
        b = swap;
        flip = -1;
    }
    int64_t e = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return e >= 0 ? flip : -flip;
}

struct triangle_key { // key(x, y) = a + b x + c y from the centre of the tile
    double a, b, c;
    float low, high; // of the vertices
    float steep;
    uint32_t triangle;
};

// The key plane of a triangle with local normal n through point p.
static void key_plane(const struct tile *t, const struct leaf *leaf, struct vec3 n, struct vec3 p,
                      struct triangle_key *out)
{
    const struct frame *f = t->frame;
    const struct affine *m = &leaf->to_local;
    struct vec3 o = rays_origin(f->rays, t->cx, t->cy), d = rays_direction(f->rays, t->cx, t->cy);
    struct vec3 world = vec3_normalized(affine_normal(m, n));
    struct vec3 at = affine_point(&leaf->to_world, p);
    double num = vec3_dot(world, vec3_sub(at, vec3_add(o, vec3_scale(d, f->t0))));
    double den =
        f->rays->orthographic ? vec3_dot(world, d) : vec3_dot(world, vec3_sub(at, o)) / f->t0;
    double s = f->rays->orthographic ? 1 : f->t0;
    double inv = fabs(den) < 1e-25 ? 0 : 1 / den;
    out->a = num * inv;
    out->b = -s * vec3_dot(world, f->rays->step_x) * inv;
    out->c = -s * vec3_dot(world, f->rays->step_y) * inv;
    out->steep = (float)fabs(vec3_dot(world, d));
}

// Adds the crossings of one triangle given by grid points.
static void scan(struct tile *t, const struct mesh_view *v, const struct grid_point q[3],
                 const struct triangle_key *k)
{
    int64_t unit = (int64_t)1 << v->bits;
    int64_t area = (q[1].x - q[0].x) * (q[2].y - q[0].y) - (q[1].y - q[0].y) * (q[2].x - q[0].x);
    if (!area)
        return;
    int facing = area > 0 ? 1 : -1;
    int64_t x0 = q[0].x, x1 = q[0].x, y0 = q[0].y, y1 = q[0].y;
    for (int i = 1; i < 3; i++) {
        x0 = q[i].x < x0 ? q[i].x : x0;
        x1 = q[i].x > x1 ? q[i].x : x1;
        y0 = q[i].y < y0 ? q[i].y : y0;
        y1 = q[i].y > y1 ? q[i].y : y1;
    }
    for (int y = 0; y < BLOCK; y++) {
        int64_t gy = (t->by + y) * unit;
        if (gy < y0 - 1 || gy > y1 + 1)
            continue;
        for (int x = 0; x < BLOCK; x++) {
            int64_t gx = (t->bx + x) * unit;
            if (gx < x0 - 1 || gx > x1 + 1)
                continue;
            struct grid_point p = {gx, gy};
            if (side(q[0], q[1], p) != facing || side(q[1], q[2], p) != facing ||
                side(q[2], q[0], p) != facing)
                continue;
            float key = (float)(k->a + k->b * (t->bx + x - t->cx) + k->c * (t->by + y - t->cy));
            key = key < k->low ? k->low : key > k->high ? k->high : key;
            struct mesh_pool *m = &t->mesh;
            float steep = k->steep;
            if (!v->orthographic) // of this ray
                steep *=
                    fabsf(1 - (float)((k->b * (t->bx + x - t->cx) + k->c * (t->by + y - t->cy)) /
                                      (t->frame->t0 - k->a)));
            array_reserve(&m->crossings, &m->crossing_capacity, m->crossing_count + 1);
            // y runs down in the picture: counter-clockwise from outside is clockwise there
            m->crossings[m->crossing_count++] =
                (struct mesh_crossing){.key = key,
                                       .steep = steep,
                                       .triangle = k->triangle,
                                       .sign = (int16_t)-facing,
                                       .ray = (uint16_t)(y * BLOCK + x)};
        }
    }
}

// The point of an edge at the clipping depth: the same for both triangles of the edge.
static struct vec3 clip_point(struct vec3 a, double ta, struct vec3 b, double tb, double clip)
{
    if (a.x > b.x || (a.x == b.x && (a.y > b.y || (a.y == b.y && a.z > b.z)))) {
        struct vec3 swap = a;
        a = b;
        b = swap;
        double t = ta;
        ta = tb;
        tb = t;
    }
    return vec3_add(a, vec3_scale(vec3_sub(b, a), (clip - ta) / (tb - ta)));
}

static void triangle(struct tile *t, const struct mesh_view *v, const struct leaf *leaf, uint32_t i)
{
    const struct mesh *m = &leaf->solid->mesh;
    struct vec3 p[3], q[4];
    double depth[3];
    int near_count = 0, n = 0;
    struct triangle_key k = {.triangle = i, .low = FLT_MAX, .high = -FLT_MAX};

    for (int j = 0; j < 3; j++) {
        p[j] = m->vertices[m->triangles[i][j]];
        depth[j] = vec3_dot(v->gt, p[j]) + v->ht;
        near_count += !v->orthographic && depth[j] < v->clip;
        double limited = v->orthographic ? depth[j] : fmax(depth[j], v->clip);
        float key = (float)frame_key(t->frame, limited);
        k.low = key < k.low ? key : k.low;
        k.high = key > k.high ? key : k.high;
    }
    if (near_count == 3)
        return;
    struct vec3 normal = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    key_plane(t, leaf, normal, p[0], &k);
    for (int j = 0; j < 3; j++) {
        int next = (j + 1) % 3;
        bool in = !near_count || depth[j] >= v->clip;
        bool next_in = !near_count || depth[next] >= v->clip;
        if (in)
            q[n++] = p[j];
        if (in != next_in)
            q[n++] = clip_point(p[j], depth[j], p[next], depth[next], v->clip);
    }
    struct grid_point g[4];
    for (int j = 0; j < n; j++)
        g[j] = project(v, q[j]);
    if (leaf->mirrored) // the mirror turned the triangle over
        for (int j = 0; j < n / 2; j++) {
            struct grid_point swap = g[j];
            g[j] = g[n - 1 - j];
            g[n - 1 - j] = swap;
        }
    for (int j = 2; j < n; j++)
        scan(t, v, (struct grid_point[3]){g[0], g[j - 1], g[j]}, &k);
}

// False when no point of the box can show in the block: grid functions x - low * t and so on are
// linear.
static bool may_show(const struct tile *t, const struct mesh_view *v, struct box b)
{
    for (int i = 0; i < 4; i++) {
        int sign = i & 1 ? -1 : 1;
        double bound = i & 2 ? t->by + (i & 1 ? BLOCK : -1) : t->bx + (i & 1 ? BLOCK : -1);
        struct vec3 g = i & 2 ? v->gy : v->gx;
        double h = i & 2 ? v->hy : v->hx;
        if (v->orthographic) {
            h -= bound;
        } else {
            g = vec3_sub(g, vec3_scale(v->gt, bound));
            h -= v->ht * bound;
        }
        g = vec3_scale(g, sign);
        double most = sign * h + fmax(g.x * b.min.x, g.x * b.max.x) +
                      fmax(g.y * b.min.y, g.y * b.max.y) + fmax(g.z * b.min.z, g.z * b.max.z);
        if (most < 0)
            return false;
    }
    return true;
}

void mesh_scan(struct tile *t, const struct tile_leaf *l)
{
    const struct leaf *leaf = &t->frame->body->leaves[l->leaf];
    const struct mesh_tree *tree = t->frame->leaves[l->frame_leaf].tree;
    struct mesh_view view = mesh_view(t->frame, leaf);
    uint32_t stack[STACK], depth = 0;
    t->mesh.crossing_count = 0;
    if (!tree->node_count)
        return;
    stack[depth++] = 0;
    while (depth) {
        const struct mesh_node *node = &tree->nodes[stack[--depth]];
        if (!may_show(t, &view, node->box))
            continue;
        if (!node->count) {
            stack[depth++] = node->first;
            stack[depth++] = node->first + 1;
            continue;
        }
        for (uint32_t i = 0; i < node->count; i++)
            triangle(t, &view, leaf, tree->order[node->first + i]);
    }
}
