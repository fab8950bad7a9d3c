// frame.c - what is worked out once per frame: the depth key, where each leaf shows, in what order.
#include "render/cpu/frame.h"

#include "base/mem.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "render/depth_key.h"

#include <stdlib.h>
#include <string.h>

enum { QUERY_DEPTH = 12, QUERY_NODES = 4096, FIELDS = 8, CHUNK = 256 };

double frame_key(const struct frame *f, double depth)
{
    return depth_key(f->rays, f->t0, depth);
}

double frame_depth(const struct frame *f, double key)
{
    return f->rays->orthographic ? key + f->t0 : f->t0 * f->t0 / (f->t0 - key);
}

static void init_depths(struct frame *f)
{
    const struct rays *r = f->rays;
    f->axis = depth_axis(r);
    f->t0 = depth_key_origin(r);
    f->start = (float)frame_key(f, r->near);
    f->end = (float)frame_key(f, r->far);
    f->epsilon = (float)f->settings->epsilon;
}

// The pixel rectangle and the keys of a box placed by `place`.
static void project_box(const struct frame *f, struct box box, const struct affine *place,
                        struct frame_leaf *out)
{
    const struct rays *r = f->rays;
    double xx = 1 / vec3_dot(r->step_x, r->step_x), yy = 1 / vec3_dot(r->step_y, r->step_y);
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    double t_min = INFINITY, t_max = -INFINITY;
    bool behind = false;

    for (int i = 0; i < 8; i++) {
        struct vec3 p = box_corner(box, i);
        struct vec3 v = vec3_sub(place ? affine_point(place, p) : p, r->origin);
        double t = vec3_dot(v, f->axis);
        t_min = fmin(t_min, t);
        t_max = fmax(t_max, t);
        if (!r->orthographic) {
            if (t < r->near * 0.5) {
                behind = true;
                continue;
            }
            v = vec3_sub(vec3_scale(v, 1 / t), r->forward);
        }
        double x = vec3_dot(v, r->step_x) * xx, y = vec3_dot(v, r->step_y) * yy;
        x0 = fmin(x0, x);
        x1 = fmax(x1, x);
        y0 = fmin(y0, y);
        y1 = fmax(y1, y);
    }
    if (behind) { // some of it passes the eye: it may show anywhere
        x0 = y0 = -1;
        x1 = r->width;
        y1 = r->height;
    }
    double slack = 1e-6 * (fabs(t_min) + fabs(t_max)); // rounding of the float keys
    out->x0 = (float)fmax(x0 - 0.01, -1e9);
    out->y0 = (float)fmax(y0 - 0.01, -1e9);
    out->x1 = (float)fmin(x1 + 0.01, 1e9);
    out->y1 = (float)fmin(y1 + 0.01, 1e9);
    if (t_max < r->near || t_min > r->far || !(t_min <= t_max)) {
        out->x1 = out->x0 - 1; // nowhere
        out->near = out->far = f->end;
        return;
    }
    out->near = t_min - slack <= r->near ? f->start : (float)frame_key(f, t_min - slack);
    out->far = t_max + slack >= r->far ? f->end : (float)frame_key(f, t_max + slack);
}

struct projection {
    struct frame *f;
    const uint32_t *part_of_leaf;
    struct frame_leaf *out;
};

static void project_chunk(void *context, uint32_t chunk, uint32_t worker)
{
    struct projection *p = context;
    const struct body *b = p->f->body;
    (void)worker;
    uint32_t end = (chunk + 1) * CHUNK < b->leaf_count ? (chunk + 1) * CHUNK : b->leaf_count;

    for (uint32_t i = chunk * CHUNK; i < end; i++) {
        struct frame_leaf *l = &p->out[i];
        struct frame_leaf roi;
        *l = (struct frame_leaf){.leaf = i, .part = p->part_of_leaf[i], .x1 = -1};
        if (l->part == EXPR_NONE)
            continue;
        project_box(p->f, b->leaves[i].solid->bounds, &b->leaves[i].to_world, l);
        if (!b->roi || box_is_empty(b->roi[i]) || isinf(b->roi[i].min.x))
            continue;
        project_box(p->f, b->roi[i], NULL, &roi);
        l->x0 = fmaxf(l->x0, roi.x0);
        l->y0 = fmaxf(l->y0, roi.y0);
        l->x1 = fminf(l->x1, roi.x1);
        l->y1 = fminf(l->y1, roi.y1);
    }
}

// Numbers the parts in the order of the file and says to which each leaf belongs.
static uint32_t find_parts(const struct body *b, struct frame_part *parts, uint32_t *part_of_leaf)
{
    const struct expr *e = &b->expr;
    uint32_t count = 0;
    for (uint32_t i = 0; i < b->leaf_count; i++)
        part_of_leaf[i] = EXPR_NONE;
    if (!e->node_count || e->root == EXPR_NONE)
        return 0;

    uint32_t *part = mem_alloc(e->node_count * sizeof *part);
    uint32_t *depth = mem_alloc(e->node_count * sizeof *depth);
    uint32_t *nodes = mem_zalloc((e->node_count + 1) * sizeof *nodes);
    const struct expr_node *root = &e->nodes[e->root];
    for (uint32_t n = e->node_count; n-- > 0;) { // parents before children
        const struct expr_node *node = &e->nodes[n];
        bool top = n == e->root ? root->op != EXPR_UNION
                                : node->parent == e->root && root->op == EXPR_UNION;
        if (top) {
            parts[count] = (struct frame_part){.node = n, .query = true};
            part[n] = count++;
            depth[n] = 0;
        } else if (n == e->root) {
            part[n] = EXPR_NONE;
            depth[n] = 0;
        } else {
            part[n] = part[node->parent];
            depth[n] = depth[node->parent] + 1;
        }
        if (part[n] == EXPR_NONE)
            continue;
        if (node->op == EXPR_LEAF)
            part_of_leaf[node->leaf] = part[n];
        else
            nodes[part[n]]++;
        if (depth[n] > QUERY_DEPTH || nodes[part[n]] > QUERY_NODES)
            parts[part[n]].query = false;
    }
    free(part);
    free(depth);
    free(nodes);
    return count;
}

static bool is_outside(const struct frame *f, const struct frame_leaf *l)
{
    return l->part == EXPR_NONE || l->x1 < l->x0 || l->y1 < l->y0 || l->x1 < 0 || l->y1 < 0 ||
           l->x0 > (float)(f->rays->width - 1) || l->y0 > (float)(f->rays->height - 1);
}

// Puts the parts in order, front to back. items and spare have room for all of them; afterwards
// items[i].index is the new place of the part that was number i.
static void sort_parts(struct frame *f, struct sort_item *items, struct sort_item *spare)
{
    for (uint32_t i = 0; i < f->part_count; i++)
        items[i] = (struct sort_item){sort_number(f->parts[i].near), i};
    sort_items(items, spare, f->part_count);
    struct frame_part *sorted = mem_alloc((f->part_count + 1) * sizeof *sorted);
    for (uint32_t i = 0; i < f->part_count; i++)
        sorted[i] = f->parts[items[i].index];
    for (uint32_t i = 0; i < f->part_count; i++)
        spare[items[i].index].index = i;
    for (uint32_t i = 0; i < f->part_count; i++)
        items[i].index = spare[i].index;
    free(f->parts);
    f->parts = sorted;
}

// Keeps of all leaves of the body those that are in the picture: parts front to back, leaves of a
// part front to back.
static void sort_leaves(struct frame *f, const struct frame_leaf *all)
{
    uint32_t most = f->body->leaf_count > f->part_count ? f->body->leaf_count : f->part_count;
    struct sort_item *items = mem_alloc((most + 1) * sizeof *items);
    struct sort_item *spare = mem_alloc((most + 1) * sizeof *spare);
    uint32_t count = 0;

    for (uint32_t i = 0; i < f->part_count; i++)
        f->parts[i].near = INFINITY;
    for (uint32_t i = 0; i < f->body->leaf_count; i++)
        if (!is_outside(f, &all[i]) && all[i].near < f->parts[all[i].part].near)
            f->parts[all[i].part].near = all[i].near;
    sort_parts(f, items, spare);
    uint32_t *rank = mem_alloc((f->part_count + 1) * sizeof *rank);
    for (uint32_t i = 0; i < f->part_count; i++)
        rank[i] = items[i].index;

    for (uint32_t i = 0; i < f->body->leaf_count; i++)
        if (!is_outside(f, &all[i]))
            items[count++] =
                (struct sort_item){(uint64_t)rank[all[i].part] << 32 | sort_number(all[i].near), i};
    sort_items(items, spare, count);
    f->leaves = mem_alloc((count + 1) * sizeof *f->leaves);
    f->leaf_count = count;
    for (uint32_t i = 0; i < count; i++) {
        struct frame_leaf *l = &f->leaves[i];
        *l = all[items[i].index];
        l->part = rank[l->part];
        struct frame_part *part = &f->parts[l->part];
        if (!part->count++)
            part->first = i;
        const struct solid *s = f->body->leaves[l->leaf].solid;
        if (s->planes.padded > f->planes_most)
            f->planes_most = s->planes.padded;
    }
    free(rank);
    free(items);
    free(spare);
}

// Fields that a leaf's rectangle touches.
static void field_range(const struct frame *f, const struct frame_leaf *l, int *x0, int *y0,
                        int *x1, int *y1)
{
    *x0 = (int)fmaxf(l->x0, 0) / f->field;
    *y0 = (int)fmaxf(l->y0, 0) / f->field;
    *x1 = (int)fminf(l->x1, (float)(f->rays->width - 1)) / f->field;
    *y1 = (int)fminf(l->y1, (float)(f->rays->height - 1)) / f->field;
}

static void make_fields(struct frame *f)
{
    int w = f->rays->width, h = f->rays->height, larger = w > h ? w : h;
    f->tiles_x = (w + TILE - 1) / TILE;
    f->tiles_y = (h + TILE - 1) / TILE;
    f->field = ((larger + FIELDS - 1) / FIELDS + TILE - 1) / TILE * TILE;
    f->fields_x = (w + f->field - 1) / f->field;
    f->fields_y = (h + f->field - 1) / f->field;
    uint32_t fields = (uint32_t)(f->fields_x * f->fields_y);
    int x0, y0, x1, y1;

    f->field_first = mem_zalloc((fields + 1) * sizeof *f->field_first);
    for (uint32_t i = 0; i < f->leaf_count; i++) {
        field_range(f, &f->leaves[i], &x0, &y0, &x1, &y1);
        for (int y = y0; y <= y1; y++)
            for (int x = x0; x <= x1; x++)
                f->field_first[y * f->fields_x + x + 1]++;
    }
    for (uint32_t i = 0; i < fields; i++)
        f->field_first[i + 1] += f->field_first[i];
    uint32_t *next = mem_alloc((fields + 1) * sizeof *next);
    memcpy(next, f->field_first, fields * sizeof *next);
    f->field_leaf = mem_alloc((f->field_first[fields] + 1) * sizeof *f->field_leaf);
    for (uint32_t i = 0; i < f->leaf_count; i++) {
        field_range(f, &f->leaves[i], &x0, &y0, &x1, &y1);
        for (int y = y0; y <= y1; y++)
            for (int x = x0; x <= x1; x++)
                f->field_leaf[next[y * f->fields_x + x]++] = i;
    }
    free(next);
    f->bytes += (fields + f->field_first[fields]) * sizeof *next;
}

void frame_init(struct frame *f, const struct body *body, const struct rays *rays,
                const struct render_settings *settings)
{
    *f = (struct frame){.body = body, .rays = rays, .settings = settings};
    init_depths(f);
    uint32_t most = body->expr.node_count + 1;
    uint32_t *part_of_leaf = mem_alloc((body->leaf_count + 1) * sizeof *part_of_leaf);
    struct frame_leaf *all = mem_alloc((body->leaf_count + 1) * sizeof *all);
    f->parts = mem_alloc(most * sizeof *f->parts);
    f->bytes = most * sizeof *f->parts +
               (body->leaf_count + 1) *
                   (2 * sizeof *all + sizeof *part_of_leaf + 2 * sizeof(struct sort_item));
    f->part_count = find_parts(body, f->parts, part_of_leaf);
    struct projection p = {.f = f, .part_of_leaf = part_of_leaf, .out = all};
    parallel_for((body->leaf_count + CHUNK - 1) / CHUNK, settings->threads, project_chunk, &p);
    sort_leaves(f, all);
    free(all);
    free(part_of_leaf);
    make_fields(f);
}

void frame_free(struct frame *f)
{
    free(f->leaves);
    free(f->parts);
    free(f->field_first);
    free(f->field_leaf);
    *f = (struct frame){0};
}
