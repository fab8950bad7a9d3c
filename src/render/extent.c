// extent.c - the box of what is solid, without ever making its mesh.
#include "render/extent.h"

#include "base/mem.h"
#include "render/normals.h"
#include "render/part.h"

#include <stdlib.h>

enum {
    ZOOM_PIXELS = 32, // side of the pictures that refine
    ROUNDS = 10,      // of refinement
    BEAM = 6,         // places that are refined in a round
    APART = 8,        // parts that are looked at one by one without a look at the whole before
    PARTS_MOST = 100  // that are looked at for one side
};
#define STEEPEST 32.0 // slope that is reckoned with

// Coordinates by axis, so that a side is one number.
struct sides {
    double low[3], high[3];
};

static struct sides sides_of(struct box b)
{
    return (struct sides){{b.min.x, b.min.y, b.min.z}, {b.max.x, b.max.y, b.max.z}};
}

static struct box box_of(const struct sides *s)
{
    return (struct box){{s->low[0], s->low[1], s->low[2]}, {s->high[0], s->high[1], s->high[2]}};
}

// ---------------------------------------------------------------- bounds from the leaves

// The members of the outermost union that are cut or intersected, and the box of the others.
struct bounds {
    struct sides *parts; // each holds all that its part can be
    uint32_t *nodes;     // of the expression
    uint32_t count;
    struct box whole; // of them, and of the others
    struct box least; // of what is solid for certain
};

static struct box leaf_box(const struct leaf *leaf)
{
    const struct mesh *m = &leaf->solid->mesh;
    struct box b = BOX_EMPTY;
    for (uint32_t i = 0; i < m->vertex_count; i++)
        b = box_of_point(b, affine_point(&leaf->to_world, m->vertices[i]));
    return b;
}

static struct box node_box(const struct expr *e, const struct expr_node *n, const struct box *boxes)
{
    struct box b = boxes[e->kids[n->first]];
    for (uint32_t k = 1; k < n->count; k++) {
        struct box kid = boxes[e->kids[n->first + k]];
        b = n->op == EXPR_UNION ? box_union(b, kid) : box_intersection(b, kid);
    }
    return box_is_empty(b) ? BOX_EMPTY : b;
}

static void find_bounds(struct bounds *out, const struct body *body)
{
    const struct expr *e = &body->expr;
    struct box *boxes = mem_alloc((e->node_count + 1) * sizeof *boxes);
    *out = (struct bounds){.whole = BOX_EMPTY, .least = BOX_EMPTY};
    out->parts = mem_alloc((e->node_count + 1) * sizeof *out->parts);
    out->nodes = mem_alloc((e->node_count + 1) * sizeof *out->nodes);
    for (uint32_t i = 0; i < e->node_count; i++) { // children before parents
        const struct expr_node *n = &e->nodes[i];
        boxes[i] = n->op == EXPR_LEAF ? leaf_box(&body->leaves[n->leaf]) : node_box(e, n, boxes);
        bool part = i == e->root ? n->op != EXPR_UNION
                                 : n->parent == e->root && e->nodes[e->root].op == EXPR_UNION;
        if (part && n->op == EXPR_LEAF)
            out->least = box_union(out->least, boxes[i]);
        else if (part && !box_is_empty(boxes[i])) {
            out->nodes[out->count] = i;
            out->parts[out->count++] = sides_of(boxes[i]);
        }
        if (i == e->root)
            out->whole = boxes[i];
    }
    free(boxes);
}

// ---------------------------------------------------------------- one side

// A picture of a part of one side: from `low`, in the two axes that follow that of the side.
struct window {
    double low[2], pixel[2];
    int size[2];
    double reference; // depths are precise near it
};

// A place of a picture where something may stand out further than what was seen.
struct place_at {
    struct window around;
    double seen;      // how far in the nearest surface was
    double potential; // how far in one may be
};

struct beam {
    struct place_at places[BEAM];
    uint32_t count;
};

// Depths count from the bound of the side inwards.
struct search {
    struct device *device;
    const struct body *body;
    const struct normals *normals;
    struct render_settings settings;
    int axis;
    bool high;        // the side of the larger coordinates
    double at, range; // coordinate of the bound, depth of the box
    double best;      // least depth found so far
    double tolerance;
    struct surface_image image;
    double *potential; // per pixel
};

static struct vec3 axis_vector(int axis, double length)
{
    axis %= 3;
    return (struct vec3){axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

static void draw(struct search *s, const struct window *w)
{
    double margin = s->range * 0.01 + s->tolerance;
    struct render_stats stats;
    struct rays r = {.orthographic = true,
                     .width = w->size[0],
                     .height = w->size[1],
                     .far = s->range + 2 * margin,
                     .reference = w->reference + margin};
    r.forward = axis_vector(s->axis, s->high ? -1 : 1);
    r.step_x = axis_vector(s->axis + 1, w->pixel[0]);
    r.step_y = axis_vector(s->axis + 2, w->pixel[1]);
    r.origin = vec3_add(axis_vector(s->axis + 1, w->low[0] + w->pixel[0] / 2),
                        axis_vector(s->axis + 2, w->low[1] + w->pixel[1] / 2));
    r.origin = vec3_add(r.origin, axis_vector(s->axis, s->high ? s->at + margin : s->at - margin));
    device_first_surface(s->device, s->body, &r, &s->settings, &s->image, NULL, NULL, &stats);
}

// How much nearer the surface of pixel i may come within a pixel in each direction.
static double rise(const struct search *s, const struct window *w, int i)
{
    const struct leaf *leaf = &s->body->leaves[s->image.leaf[i]];
    if (s->image.face[i] == SURFACE_CAP)
        return 0;
    struct vec3 n = normals_find(s->normals, leaf, s->image.face[i]);
    double along = fmax(fabs(vec3_dot(n, axis_vector(s->axis, 1))), 1e-9), sum = 0;
    for (int k = 0; k < 2; k++) {
        double slope = fabs(vec3_dot(n, axis_vector(s->axis + 1 + k, 1))) / along;
        sum += w->pixel[k] * fmin(STEEPEST, slope);
    }
    return sum;
}

// Notes what is nearest in the picture and how near its surroundings may be.
static void look(struct search *s, const struct window *w)
{
    for (int i = 0; i < w->size[0] * w->size[1]; i++) {
        s->potential[i] = INFINITY;
        if (s->image.leaf[i] == SURFACE_NONE)
            continue;
        double depth = s->image.depth[i] + w->reference;
        s->best = fmin(s->best, depth);
        s->potential[i] = depth - rise(s, w, i);
    }
}

// Keeps the places that are nearest, in order.
static void keep(struct beam *b, struct place_at p)
{
    uint32_t at = b->count;
    if (at == BEAM && p.seen >= b->places[--at].seen)
        return;
    if (b->count < BEAM)
        b->count++;
    for (; at > 0 && b->places[at - 1].seen > p.seen; at--)
        b->places[at] = b->places[at - 1];
    b->places[at] = p;
}

// The window around a pixel and its neighbours.
static struct window window_around(const struct window *w, int x, int y, double depth)
{
    struct window out = {.size = {ZOOM_PIXELS, ZOOM_PIXELS}, .reference = depth};
    const int at[2] = {x, y};
    for (int k = 0; k < 2; k++) {
        out.low[k] = w->low[k] + (at[k] - 1) * w->pixel[k];
        out.pixel[k] = 3 * w->pixel[k] / ZOOM_PIXELS;
    }
    return out;
}

// Picks the pixels of the picture around which something nearer than the best may be.
static void pick(struct search *s, const struct window *w, struct beam *out)
{
    int width = w->size[0], height = w->size[1];
    for (int n = 0; n < BEAM; n++) {
        int least = -1;
        for (int i = 0; i < width * height; i++)
            if (s->potential[i] < s->best - s->tolerance &&
                (least < 0 || s->image.depth[i] < s->image.depth[least]))
                least = i;
        if (least < 0)
            return;
        int x = least % width, y = least / width;
        double depth = s->image.depth[least] + w->reference;
        keep(out, (struct place_at){window_around(w, x, y, depth), depth, s->potential[least]});
        for (int k = y > 0 ? y - 1 : 0; k <= y + 1 && k < height; k++) // it sees them, too
            for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++)
                s->potential[k * width + i] = INFINITY;
    }
}

// Looks closer and closer at what stands out in the window that was looked at.
static void refine(struct search *s, const struct window *w)
{
    struct beam now = {.count = 0};
    pick(s, w, &now);
    for (int round = 0; round < ROUNDS && now.count; round++) {
        struct beam next = {.count = 0};
        for (uint32_t i = 0; i < now.count; i++) {
            const struct place_at *p = &now.places[i];
            if (!(p->potential < s->best - s->tolerance))
                continue;
            draw(s, &p->around);
            look(s, &p->around);
            pick(s, &p->around, &next);
        }
        now = next;
    }
}

static struct window look_at(struct search *s, const struct sides *box)
{
    struct window w = {.reference = s->range / 2};
    for (int k = 0; k < 2; k++) {
        int axis = (s->axis + 1 + k) % 3;
        double length = box->high[axis] - box->low[axis];
        w.low[k] = box->low[axis];
        w.size[k] = length > s->tolerance ? EXTENT_PIXELS : 1;
        w.pixel[k] = fmax(length, s->tolerance) / w.size[k];
    }
    draw(s, &w);
    look(s, &w);
    return w;
}

// Parts are looked at for themselves: the others would only take time.
static void search_part(struct search *s, const struct sides *box, uint32_t node)
{
    const struct body *whole = s->body;
    struct body part;
    part_init(&part, whole, node);
    s->body = &part;
    struct window w = look_at(s, box);
    refine(s, &w);
    s->body = whole;
    part_free(&part);
}

// How far in a part may begin.
static double bound_of(const struct search *s, const struct sides *part)
{
    return s->high ? s->at - part->high[s->axis] : part->low[s->axis] - s->at;
}

struct candidate {
    double bound;
    uint32_t part;
};

static int by_bound(const void *a, const void *b)
{
    const struct candidate *p = a, *q = b;
    if (p->bound != q->bound)
        return p->bound < q->bound ? -1 : 1;
    return p->part < q->part ? -1 : p->part > q->part;
}

// How far in the solid begins, seen from one side of the box; `certain`: of what is solid anyway.
static double search_side(struct search *s, const struct bounds *b, double certain)
{
    struct candidate *list = mem_alloc((b->count + 1) * sizeof *list);
    const struct sides whole = sides_of(b->whole);
    uint32_t count = 0;
    s->best = certain;
    for (uint32_t i = 0; i < b->count; i++) {
        double bound = bound_of(s, &b->parts[i]);
        if (bound < certain - s->tolerance)
            list[count++] = (struct candidate){bound, i};
    }
    if (count)
        qsort(list, count, sizeof *list, by_bound);
    if (count > APART)
        look_at(s, &whole);
    for (uint32_t i = 0; i < count && i < PARTS_MOST; i++) {
        if (!(list[i].bound < s->best - s->tolerance))
            break;
        search_part(s, &b->parts[list[i].part], b->nodes[list[i].part]);
    }
    free(list);
    return s->best;
}

// ---------------------------------------------------------------- the box

// A coordinate that was measured is mostly that of a corner of some leaf.
static double snapped(const struct body *body, int axis, double at, double tolerance)
{
    double found = at, away = tolerance;
    for (uint32_t l = 0; l < body->leaf_count; l++) {
        const struct leaf *leaf = &body->leaves[l];
        const struct mesh *m = &leaf->solid->mesh;
        struct sides box = sides_of(leaf->box);
        if (box.low[axis] > at + tolerance || box.high[axis] < at - tolerance)
            continue;
        for (uint32_t i = 0; i < m->vertex_count; i++) {
            struct vec3 p = affine_point(&leaf->to_world, m->vertices[i]);
            double c = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
            if (fabs(c - at) < away) {
                away = fabs(c - at);
                found = c;
            }
        }
    }
    return found;
}

struct box extent_find(struct device *d, const struct model *m,
                       const struct render_settings *settings)
{
    const struct body *body = &m->bodies[0];
    struct bounds bounds;
    find_bounds(&bounds, body);
    double diagonal = vec3_length(vec3_sub(bounds.whole.max, bounds.whole.min));
    struct sides out = sides_of(bounds.whole), certain = sides_of(bounds.least);
    size_t pixels = (size_t)EXTENT_PIXELS * EXTENT_PIXELS;
    struct normals normals;
    normals_init(&normals, m);
    struct search s = {.device = d,
                       .body = body,
                       .normals = &normals,
                       .settings = *settings,
                       .tolerance = EXTENT_TOLERANCE * diagonal / 4,
                       .image = {.depth = mem_alloc(pixels * sizeof(float)),
                                 .leaf = mem_alloc(pixels * sizeof(uint32_t)),
                                 .face = mem_alloc(pixels * sizeof(uint32_t))},
                       .potential = mem_alloc(pixels * sizeof(double))};
    for (int side = 0; side < 6 && bounds.count && isfinite(diagonal); side++) {
        s.axis = side / 2;
        s.high = side % 2;
        double *at = s.high ? &out.high[s.axis] : &out.low[s.axis];
        s.at = *at;
        s.range = sides_of(bounds.whole).high[s.axis] - sides_of(bounds.whole).low[s.axis];
        double depth = search_side(&s, &bounds, bound_of(&s, &certain));
        if (depth == INFINITY) {
            out = sides_of(BOX_EMPTY);
            break;
        }
        double found = s.high ? s.at - depth : s.at + depth;
        *at = depth <= s.tolerance ? s.at : snapped(body, s.axis, found, 3 * s.tolerance);
    }
    normals_free(&normals);
    free(bounds.parts);
    free(bounds.nodes);
    free(s.image.depth);
    free(s.image.leaf);
    free(s.image.face);
    free(s.potential);
    return box_of(&out);
}
