// compare.c - does the device's answer for a pixel agree with the oracle?
#include "compare.h"

#include "base/hash.h"

#include <string.h>

const char *const fit_text[FITS_COUNT] = {
    [FITS] = "fits",
    [FIT_NO_LEAF] = "no such leaf",
    [FIT_OWNER_TURNED] = "the owner faces the other way",
    [FIT_OWNER_IDLE] = "the owner does not matter there",
    [FIT_OWNER_ELSEWHERE] = "the owner has no face there",
    [FIT_FACE] = "another face of the owner",
    [FIT_CAP_ELSEWHERE] = "a cap away from near",
    [FIT_CAP_OWNER] = "the owner of the cap is not there",
    [FIT_ENTER] = "solid begins elsewhere",
    [FIT_LEAVE] = "solid ends elsewhere",
    [FIT_VISITS] = "the pixel was not given once",
    [FIT_SPANS] = "another number of spans",
    [FIT_OPEN_END] = "open end away from far",
    [FIT_EXTRA] = "a surface where there is none",
    [FIT_MISSING] = "a surface is missing",
};

static const double thin[3] = {1, 0.2, 5};
static const double aside[2] = {1e-3, 1.5e-4}; // pixels

static bool within(double depth, struct oracle_end end, double tolerance)
{
    return depth >= end.low - tolerance && depth <= end.high + tolerance;
}

// Is a face at the end, as far as the filter can tell?
static bool coincident(const struct comparison *c, const struct oracle_crossing *x,
                       struct oracle_end end)
{
    double gap = fmax(end.low - x->depth, x->depth - end.high);
    return gap <= c->tolerance || gap * fmax(x->cosine, end.at->cosine) < c->slack * c->epsilon;
}

static bool end_fits(const struct comparison *c, const struct oracle_ray *ray,
                     struct oracle_end end, double depth)
{
    if (within(depth, end, c->tolerance))
        return true;
    for (uint32_t i = 0; i < ray->crossing_count; i++) {
        const struct oracle_crossing *x = &ray->crossings[i];
        if (fabs(x->depth - depth) <= c->tolerance && coincident(c, x, end))
            return true;
    }
    return false;
}

// Does the plane of a face of the leaf hold the end? On an edge the ray may be said to hit either
// face.
static bool face_fits(const struct comparison *c, const struct oracle_ray *ray, uint32_t leaf,
                      uint32_t face, struct oracle_end end)
{
    const struct oracle_placed *p = &c->oracle->leaves[leaf];
    struct vec3 point = vec3_add(ray->origin, vec3_scale(ray->direction, end.low));
    for (uint32_t i = 0; i < p->mesh->triangle_count; i++) {
        if (p->mesh->faces[i] != face)
            continue;
        struct vec3 corner = p->vertices[p->mesh->triangles[i][0]];
        if (fabs(vec3_dot(p->normals[i], vec3_sub(point, corner))) < c->tolerance)
            return true;
    }
    return false;
}

// Can a crossing turn the result at the end, whichever faces there come before it?
static bool matters(const struct comparison *c, const struct oracle_ray *ray, struct oracle_end end,
                    const struct oracle_crossing *owner)
{
    enum { OTHERS = 6 };
    const struct oracle_crossing *others[OTHERS];
    uint32_t n = 0;
    memset(ray->count, 0, c->oracle->leaf_count * sizeof *ray->count);
    for (uint32_t i = 0; i < ray->crossing_count; i++) {
        const struct oracle_crossing *x = &ray->crossings[i];
        if (x == owner)
            continue;
        if (!coincident(c, x, end)) {
            ray->count[x->leaf] += x->depth < end.low ? x->delta : 0;
        } else {
            if (n == OTHERS)
                return true; // too many to try
            others[n++] = x;
        }
    }
    for (uint32_t set = 0; set < 1u << n; set++) {
        for (uint32_t k = 0; k < n; k++)
            ray->count[others[k]->leaf] += set >> k & 1 ? others[k]->delta : 0;
        bool before = oracle_evaluate(c->oracle, ray->count, ray->stack);
        ray->count[owner->leaf] += owner->delta;
        bool after = oracle_evaluate(c->oracle, ray->count, ray->stack);
        ray->count[owner->leaf] -= owner->delta;
        for (uint32_t k = 0; k < n; k++)
            ray->count[others[k]->leaf] -= set >> k & 1 ? others[k]->delta : 0;
        if (before != after)
            return true;
    }
    return false;
}

// May this leaf and face own the end? way: +1 where solid begins, -1 where it ends.
static enum fit check_owner_on(const struct comparison *c, const struct oracle_ray *ray,
                               struct oracle_end end, uint32_t leaf, uint32_t face, int way)
{
    enum fit found = FIT_OWNER_ELSEWHERE;
    for (uint32_t i = 0; i < ray->crossing_count; i++) {
        const struct oracle_crossing *x = &ray->crossings[i];
        if (x->leaf != leaf || !coincident(c, x, end))
            continue;
        if (c->strict && x->delta * c->oracle->polarity[leaf] != way) {
            found = FIT_OWNER_TURNED;
            continue;
        }
        if (c->strict && !matters(c, ray, end, x))
            return FIT_OWNER_IDLE;
        if (x->face == face)
            return FITS;
        found = face_fits(c, ray, leaf, face, end) ? FITS : FIT_FACE;
    }
    return found;
}

static enum fit check_owner(const struct comparison *c, const struct oracle_ray *ray,
                            struct oracle_end end, uint32_t leaf, uint32_t face, int way)
{
    if (leaf >= c->oracle->leaf_count)
        return FIT_NO_LEAF;
    enum fit found = check_owner_on(c, ray, end, leaf, face, way);
    for (int k = 0; k < 9 && found && c->nearby; k++)
        if (!check_owner_on(c, &c->around[k], end, leaf, face, way))
            return FITS;
    return found;
}

// Does the leaf hold the point at near?
static enum fit check_cap(const struct comparison *c, const struct oracle_ray *ray,
                          struct oracle_end end, uint32_t leaf)
{
    if (!within(c->rays->near, end, c->tolerance))
        return FIT_CAP_ELSEWHERE;
    if (leaf >= c->oracle->leaf_count)
        return FIT_NO_LEAF;
    int before = 0, after = 0;
    for (uint32_t i = 0; i < ray->crossing_count; i++) {
        const struct oracle_crossing *x = &ray->crossings[i];
        if (x->leaf == leaf && x->depth <= c->rays->near - c->tolerance)
            before += x->delta;
        if (x->leaf == leaf && x->depth <= c->rays->near + c->tolerance)
            after += x->delta;
    }
    return before > 0 || after > 0 ? FITS : FIT_CAP_OWNER;
}

static enum fit check_enter(const struct comparison *c, const struct oracle_ray *ray,
                            struct oracle_end end, double depth, uint32_t leaf, uint32_t face)
{
    if (!end_fits(c, ray, end, depth))
        return FIT_ENTER;
    return face == SURFACE_CAP ? check_cap(c, ray, end, leaf)
                               : check_owner(c, ray, end, leaf, face, 1);
}

static enum fit check_spans(const struct comparison *c, const struct oracle_ray *ray,
                            const struct oracle_answer *a, const struct pixel_spans *device)
{
    if (device->visits != 1)
        return FIT_VISITS;
    if (device->count != a->count)
        return FIT_SPANS;
    for (uint32_t i = 0; i < a->count; i++) {
        const struct oracle_span *truth = &a->spans[i];
        const struct span *s = &device->items[i];
        enum fit reason = check_enter(c, ray, truth->enter, s->enter + c->rays->reference,
                                      s->enter_leaf, s->enter_face);
        if (reason)
            return reason;
        if (!end_fits(c, ray, truth->leave, s->leave + c->rays->reference))
            return FIT_LEAVE;
        if (s->leave_leaf == SURFACE_NONE) {
            if (!within(c->rays->far, truth->leave, c->tolerance))
                return FIT_OPEN_END;
            continue;
        }
        reason = check_owner(c, ray, truth->leave, s->leave_leaf, s->leave_face, -1);
        if (reason)
            return reason;
    }
    return FITS;
}

static enum fit check_pixel(const struct comparison *c, const struct oracle_ray *ray,
                            const struct oracle_answer *a, const struct picture *p, int i)
{
    bool hit = p->image.leaf[i] != SURFACE_NONE;
    if (hit != (a->count > 0))
        return hit ? FIT_EXTRA : FIT_MISSING;
    if (hit) {
        enum fit reason =
            check_enter(c, ray, a->spans[0].enter, p->image.depth[i] + c->rays->reference,
                        p->image.leaf[i], p->image.face[i]);
        if (reason)
            return reason;
    }
    return check_spans(c, ray, a, &p->spans[i]);
}

// Is the end of a neighbouring ray where the plane of this ray's end says, but for corners?
static bool end_continues(const struct comparison *c, const struct oracle_ray *other,
                          struct oracle_end here, struct oracle_end there)
{
    if (here.at->kind != BOUND_FACE || there.at->kind != here.at->kind)
        return there.at->kind == here.at->kind;
    struct vec3 point = vec3_add(c->ray.origin, vec3_scale(c->ray.direction, here.low));
    struct vec3 n = here.at->normal;
    double along = vec3_dot(n, other->direction);
    double depth = vec3_dot(n, vec3_sub(point, other->origin)) / along;
    return fabs(depth - there.low) < c->tolerance / 2;
}

// Do two rays cross the same leaves, in any order?
static bool same_leaves(const struct oracle_ray *a, const struct oracle_ray *b)
{
    uint64_t sum = 0;
    if (a->crossing_count != b->crossing_count)
        return false;
    for (uint32_t i = 0; i < a->crossing_count; i++)
        sum += hash_mix(a->crossings[i].leaf + 1) - hash_mix(b->crossings[i].leaf + 1);
    return sum == 0;
}

static bool answers_continue(const struct comparison *c, const struct oracle_ray *other,
                             const struct oracle_answer *here, const struct oracle_answer *there)
{
    if (here->count != there->count || !same_leaves(&c->ray, other))
        return false;
    for (uint32_t i = 0; i < here->count; i++)
        if (!end_continues(c, other, here->spans[i].enter, there->spans[i].enter) ||
            !end_continues(c, other, here->spans[i].leave, there->spans[i].leave))
            return false;
    return true;
}

// Is a face near the end, but neither clearly apart from it nor clearly in one place with it?
static bool undecided(const struct comparison *c, struct oracle_end end)
{
    for (uint32_t i = 0; i < c->ray.crossing_count; i++) {
        const struct oracle_crossing *x = &c->ray.crossings[i];
        double gap = fmax(end.low - x->depth, x->depth - end.high);
        double thickness = gap * fmax(x->cosine, end.at->cosine) / c->epsilon;
        if (thickness >= thin[1] && thickness <= thin[2])
            return true;
    }
    return false;
}

static void cast_around(struct comparison *c, int x, int y, double distance)
{
    for (int k = 0; k < 9; k++)
        oracle_cast(c->oracle, c->rays, x + distance * (k % 3 - 1), y + distance * (k / 3 - 1),
                    &c->around[k]);
}

bool compare_unstable(struct comparison *c, int x, int y)
{
    for (int i = 1; i < 3; i++) {
        oracle_spans(&c->ray, thin[i] * c->epsilon, &c->trial);
        if (c->trial.count != c->answer.count)
            return true;
    }
    for (uint32_t i = 0; i < c->answer.count; i++)
        if (undecided(c, c->answer.spans[i].enter) || undecided(c, c->answer.spans[i].leave))
            return true;
    cast_around(c, x, y, aside[0]);
    for (int k = 0; k < 9; k++) {
        oracle_spans(&c->around[k], c->epsilon, &c->trial);
        if (!answers_continue(c, &c->around[k], &c->answer, &c->trial))
            return true;
    }
    return false;
}

// Is the device's answer right for a ray that passes very close by?
static bool explained(struct comparison *c, const struct picture *p, int x, int y)
{
    bool found = false;
    c->slack = thin[2];
    c->nearby = true;
    for (int d = 0; d < 2 && !found; d++) {
        cast_around(c, x, y, aside[d]);
        for (int k = 0; k < 9 && !found; k++)
            for (int i = 0; i < 3 && !found; i++) {
                oracle_spans(&c->around[k], thin[i] * c->epsilon, &c->trial);
                found = !check_pixel(c, &c->around[k], &c->trial, p, y * c->rays->width + x);
            }
    }
    c->slack = thin[1];
    c->nearby = false;
    return found;
}

enum verdict compare_pixel(struct comparison *c, const struct picture *p, int x, int y)
{
    int i = y * c->rays->width + x;
    c->slack = thin[1];
    oracle_cast(c->oracle, c->rays, x, y, &c->ray);
    oracle_spans(&c->ray, c->epsilon, &c->answer);
    c->strict = true;
    c->reason = check_pixel(c, &c->ray, &c->answer, p, i);
    if (!c->reason)
        return VERDICT_AGREES;
    bool unstable = compare_unstable(c, x, y);
    c->strict = false;
    enum fit loose = check_pixel(c, &c->ray, &c->answer, p, i);
    if (!loose)
        return unstable ? VERDICT_FORGIVEN : VERDICT_OWNER;
    c->reason = loose;
    if (!unstable)
        return VERDICT_WRONG;
    return explained(c, p, x, y) ? VERDICT_FORGIVEN : VERDICT_UNEXPLAINED;
}

void compare_free(struct comparison *c)
{
    oracle_ray_free(&c->ray);
    for (int k = 0; k < 9; k++)
        oracle_ray_free(&c->around[k]);
    oracle_answer_free(&c->answer);
    oracle_answer_free(&c->trial);
}
