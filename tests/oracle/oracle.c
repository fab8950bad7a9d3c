// oracle.c - the truth: one ray, all triangles, the plain expression, in double precision.
#include "oracle.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

static void place_leaf(struct oracle_placed *out, const struct oracle_leaf *leaf)
{
    const struct mesh *m = leaf->mesh;
    out->mesh = m;
    out->vertices = mem_alloc(m->vertex_count * sizeof *out->vertices);
    out->normals = mem_alloc(m->triangle_count * sizeof *out->normals);
    out->sign = affine_determinant(&leaf->to_world) < 0 ? -1 : 1;
    struct box box = BOX_EMPTY;
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        out->vertices[i] = affine_point(&leaf->to_world, m->vertices[i]);
        box = box_of_point(box, out->vertices[i]);
    }
    out->centre = vec3_scale(vec3_add(box.min, box.max), 0.5);
    out->radius = 0;
    for (uint32_t i = 0; i < m->vertex_count; i++)
        out->radius =
            fmax(out->radius, vec3_length(vec3_sub(out->vertices[i], out->centre)) * (1 + 1e-9));
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 a = out->vertices[m->triangles[i][0]];
        struct vec3 ab = vec3_sub(out->vertices[m->triangles[i][1]], a);
        struct vec3 ac = vec3_sub(out->vertices[m->triangles[i][2]], a);
        out->normals[i] = vec3_scale(vec3_normalized(vec3_cross(ab, ac)), out->sign);
    }
}

// From the last token back: each operator hands its polarity to its operands, last operand on top.
static void find_polarity(struct oracle *o)
{
    int *stack = mem_alloc((o->token_count + 1) * sizeof *stack);
    size_t top = 0;
    stack[top++] = 1;
    for (size_t i = o->token_count; i-- > 0;) {
        struct expr_token token = o->tokens[i];
        int polarity = stack[--top];
        if (token.op == EXPR_LEAF)
            o->polarity[token.arg] = polarity;
        else
            for (uint32_t k = 0; k < token.arg; k++)
                stack[top++] = token.op == EXPR_DIFFERENCE && k ? -polarity : polarity;
    }
    free(stack);
}

void oracle_init(struct oracle *out, const struct oracle_leaf *leaves, uint32_t leaf_count,
                 const struct expr_token *tokens, size_t token_count)
{
    *out = (struct oracle){.leaf_count = leaf_count, .tokens = tokens, .token_count = token_count};
    out->leaves = mem_alloc((leaf_count + 1) * sizeof *out->leaves);
    for (uint32_t i = 0; i < leaf_count; i++) {
        place_leaf(&out->leaves[i], &leaves[i]);
        if (leaves[i].mesh->vertex_count > out->max_vertices)
            out->max_vertices = leaves[i].mesh->vertex_count;
    }
    out->polarity = mem_zalloc(leaf_count * sizeof *out->polarity);
    find_polarity(out);
}

void oracle_free(struct oracle *o)
{
    for (uint32_t i = 0; i < o->leaf_count; i++) {
        free(o->leaves[i].vertices);
        free(o->leaves[i].normals);
    }
    free(o->leaves);
    free(o->polarity);
    *o = (struct oracle){0};
}

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

// On which side of the edge a-b the origin lies, exactly: the sign of a.x b.y - a.y b.x. Zero is
// decided as if the origin were moved by (e, e^2) for an infinitely small e, so it stays only for
// edges that are points.
static int edge_side(const double *a, const double *b)
{
    double p = a[0] * b[1], q = a[1] * b[0];
    if (p != q)
        return p > q ? 1 : -1;
    int side = sign_of(fma(a[0], b[1], -p) - fma(a[1], b[0], -q));
    if (!side)
        side = sign_of(a[1] - b[1]);
    return side ? side : sign_of(b[0] - a[0]);
}

// Depth of a triangle that the ray is known to hit. p: its projected corners, z along the ray.
static double triangle_depth(const struct oracle_ray *ray, struct vec3 normal, struct vec3 corner,
                             const double *const p[3], double scale)
{
    double low = fmin(p[0][2], fmin(p[1][2], p[2][2])) * scale;
    double high = fmax(p[0][2], fmax(p[1][2], p[2][2])) * scale;
    if (low > high) {
        double swap = low;
        low = high;
        high = swap;
    }
    double along = vec3_dot(normal, ray->direction), depth;
    if (fabs(along) > 1e-7 * vec3_length(ray->direction)) {
        depth = vec3_dot(normal, vec3_sub(corner, ray->origin)) / along;
    } else {
        double weight[3], sum = 0, z = 0;
        for (int i = 0; i < 3; i++) {
            const double *b = p[(i + 1) % 3], *c = p[(i + 2) % 3];
            weight[i] = b[0] * c[1] - b[1] * c[0];
            sum += weight[i];
            z += weight[i] * p[i][2];
        }
        depth = sum != 0 ? z / sum * scale : low;
    }
    return fmin(fmax(depth, low), high);
}

static void cast_leaf(const struct oracle_placed *leaf, uint32_t number, struct oracle_ray *ray)
{
    struct vec3 to = vec3_sub(leaf->centre, ray->origin);
    struct vec3 off = vec3_cross(to, ray->direction);
    if (vec3_length(off) > (leaf->radius + 1e-6) * vec3_length(ray->direction))
        return;
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    int z = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(d[i]) > fabs(d[z]))
            z = i;
    int x = (z + 1) % 3, y = (z + 2) % 3;
    double shear_x = d[x] / d[z], shear_y = d[y] / d[z];
    for (uint32_t i = 0; i < leaf->mesh->vertex_count; i++) {
        struct vec3 v = vec3_sub(leaf->vertices[i], ray->origin);
        const double c[3] = {v.x, v.y, v.z};
        ray->projected[i][0] = c[x] - shear_x * c[z];
        ray->projected[i][1] = c[y] - shear_y * c[z];
        ray->projected[i][2] = c[z];
    }
    int balance = 0;
    for (uint32_t i = 0; i < leaf->mesh->triangle_count; i++) {
        const uint32_t *t = leaf->mesh->triangles[i];
        const double *const p[3] = {ray->projected[t[0]], ray->projected[t[1]],
                                    ray->projected[t[2]]};
        int side = edge_side(p[0], p[1]);
        if (!side || edge_side(p[1], p[2]) != side || edge_side(p[2], p[0]) != side)
            continue;
        array_reserve(&ray->crossings, &ray->crossing_capacity, ray->crossing_count + 1);
        struct oracle_crossing *c = &ray->crossings[ray->crossing_count++];
        *c = (struct oracle_crossing){.leaf = number,
                                      .face = leaf->mesh->faces[i],
                                      .normal = leaf->normals[i],
                                      .delta = (d[z] > 0 ? -side : side) * leaf->sign};
        c->depth = triangle_depth(ray, c->normal, leaf->vertices[t[0]], p, 1 / d[z]);
        c->cosine = fabs(vec3_dot(c->normal, ray->direction));
        balance += c->delta;
    }
    ray->open_leaves += balance != 0;
}

static int compare_crossings(const void *a, const void *b)
{
    const struct oracle_crossing *p = a, *q = b;
    if (p->depth != q->depth)
        return p->depth < q->depth ? -1 : 1;
    return p->leaf < q->leaf ? -1 : p->leaf > q->leaf;
}

bool oracle_evaluate(const struct oracle *o, const int *inside, bool *stack)
{
    size_t top = 0;
    for (size_t i = 0; i < o->token_count; i++) {
        struct expr_token token = o->tokens[i];
        if (token.op == EXPR_LEAF) {
            stack[top++] = inside[token.arg] > 0;
            continue;
        }
        bool any = false, all = token.arg > 0, others = false;
        for (size_t k = top - token.arg; k < top; k++) {
            any |= stack[k];
            all &= stack[k];
            others |= stack[k] && k > top - token.arg;
        }
        bool first = token.arg > 0 && stack[top - token.arg];
        top -= token.arg;
        stack[top++] = token.op == EXPR_UNION          ? any
                       : token.op == EXPR_INTERSECTION ? all
                                                       : first && !others;
    }
    return top > 0 && stack[0];
}

static void add_boundary(struct oracle_ray *ray, struct oracle_boundary b)
{
    array_reserve(&ray->boundaries, &ray->boundary_capacity, ray->boundary_count + 1);
    ray->boundaries[ray->boundary_count++] = b;
}

static void walk(const struct oracle *o, const struct rays *rays, struct oracle_ray *ray)
{
    if (o->leaf_count)
        memset(ray->count, 0, o->leaf_count * sizeof *ray->count);
    ray->boundary_count = 0;
    bool solid = false, started = false;
    uint32_t i = 0;
    while (i < ray->crossing_count) {
        double depth = ray->crossings[i].depth;
        if (!started && depth > rays->near) {
            started = true;
            solid = oracle_evaluate(o, ray->count, ray->stack);
            if (solid)
                add_boundary(ray, (struct oracle_boundary){
                                      .depth = rays->near, .cosine = 1, .kind = BOUND_NEAR});
        }
        if (depth >= rays->far)
            break;
        const struct oracle_crossing *steepest = &ray->crossings[i];
        for (; i < ray->crossing_count && ray->crossings[i].depth == depth; i++) {
            ray->count[ray->crossings[i].leaf] += ray->crossings[i].delta;
            if (ray->crossings[i].cosine > steepest->cosine)
                steepest = &ray->crossings[i];
        }
        if (!started)
            continue;
        bool after = oracle_evaluate(o, ray->count, ray->stack);
        if (after != solid)
            add_boundary(ray, (struct oracle_boundary){depth, steepest->cosine, steepest->normal,
                                                       BOUND_FACE});
        solid = after;
    }
    if (solid)
        add_boundary(ray,
                     (struct oracle_boundary){.depth = rays->far, .cosine = 1, .kind = BOUND_FAR});
}

void oracle_cast(const struct oracle *o, const struct rays *rays, double x, double y,
                 struct oracle_ray *ray)
{
    ray->origin = rays_origin(rays, x, y);
    ray->direction = rays_direction(rays, x, y);
    array_reserve(&ray->count, &ray->count_capacity, o->leaf_count + 1);
    array_reserve(&ray->stack, &ray->stack_capacity, o->token_count + 1);
    array_reserve(&ray->projected, &ray->projected_capacity, o->max_vertices);
    ray->crossing_count = 0;
    ray->open_leaves = 0;
    for (uint32_t i = 0; i < o->leaf_count; i++)
        cast_leaf(&o->leaves[i], i, ray);
    if (ray->crossing_count)
        qsort(ray->crossings, ray->crossing_count, sizeof *ray->crossings, compare_crossings);
    walk(o, rays, ray);
}

void oracle_ray_free(struct oracle_ray *ray)
{
    free(ray->crossings);
    free(ray->boundaries);
    free(ray->count);
    free(ray->stack);
    free(ray->projected);
    *ray = (struct oracle_ray){0};
}

void oracle_spans(const struct oracle_ray *ray, double epsilon, struct oracle_answer *out)
{
    out->count = 0;
    bool solid = false;
    const struct oracle_boundary *b = ray->boundaries;
    for (uint32_t i = 0, j; i < ray->boundary_count; i = j + 1) {
        for (j = i; j + 1 < ray->boundary_count; j++)
            if ((b[j + 1].depth - b[j].depth) * fmax(b[j].cosine, b[j + 1].cosine) >= epsilon)
                break;
        if ((j - i) % 2)
            continue; // after a bundle of thin intervals the state is what it was before
        struct oracle_end end = {b[i].depth, b[j].depth, &b[i]};
        solid = !solid;
        if (solid) {
            array_reserve(&out->spans, &out->capacity, out->count + 1);
            out->spans[out->count++].enter = end;
        } else {
            out->spans[out->count - 1].leave = end;
        }
    }
}

void oracle_answer_free(struct oracle_answer *a)
{
    free(a->spans);
    *a = (struct oracle_answer){0};
}
