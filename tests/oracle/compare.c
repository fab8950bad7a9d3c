// compare.c - does the device's answer for a pixel agree with the oracle?
#include "compare.h"

const char *const fit_text[FITS_COUNT] = {
    [FITS] = "fits",
    [FIT_NO_LEAF] = "no such leaf",
    [FIT_OWNER_TURNED] = "the owner faces the other way",
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
static const double aside = 1e-3; // pixels

static bool within(double depth, struct oracle_end end, double tolerance)
{
    return depth >= end.low - tolerance && depth <= end.high + tolerance;
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

// May this leaf and face own the end? way: +1 where solid begins, -1 where it ends.
static enum fit check_owner(const struct comparison *c, const struct oracle_ray *ray,
                            struct oracle_end end, uint32_t leaf, uint32_t face, int way)
{
    if (leaf >= c->oracle->leaf_count)
        return FIT_NO_LEAF;
    bool there = false, turned = false;
    for (uint32_t i = 0; i < ray->crossing_count; i++) {
        const struct oracle_crossing *x = &ray->crossings[i];
        if (x->leaf != leaf || !within(x->depth, end, c->tolerance))
            continue;
        bool right = !c->strict || x->delta * c->oracle->polarity[leaf] == way;
        there |= right;
        turned |= !right;
        if (right && x->face == face)
            return FITS;
    }
    if (!there)
        return turned ? FIT_OWNER_TURNED : FIT_OWNER_ELSEWHERE;
    return face_fits(c, ray, leaf, face, end) ? FITS : FIT_FACE;
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
    if (!within(depth, end, c->tolerance))
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
        if (!within(s->leave + c->rays->reference, truth->leave, c->tolerance))
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
static bool end_continues(const struct comparison *c, struct oracle_end here,
                          struct oracle_end there)
{
    if (here.at->kind != BOUND_FACE || there.at->kind != here.at->kind)
        return there.at->kind == here.at->kind;
    struct vec3 point = vec3_add(c->ray.origin, vec3_scale(c->ray.direction, here.low));
    struct vec3 n = here.at->normal;
    double along = vec3_dot(n, c->other.direction);
    double depth = vec3_dot(n, vec3_sub(point, c->other.origin)) / along;
    return fabs(depth - there.low) < c->tolerance / 2;
}

static bool answers_continue(const struct comparison *c, const struct oracle_answer *here,
                             const struct oracle_answer *there)
{
    if (here->count != there->count)
        return false;
    for (uint32_t i = 0; i < here->count; i++)
        if (!end_continues(c, here->spans[i].enter, there->spans[i].enter) ||
            !end_continues(c, here->spans[i].leave, there->spans[i].leave))
            return false;
    return true;
}

static void cast_aside(struct comparison *c, int x, int y, int k)
{
    oracle_cast(c->oracle, c->rays, x + aside * (k % 3 - 1), y + aside * (k / 3 - 1), &c->other);
}

bool compare_unstable(struct comparison *c, int x, int y)
{
    for (int i = 1; i < 3; i++) {
        oracle_spans(&c->ray, thin[i] * c->epsilon, &c->trial);
        if (c->trial.count != c->answer.count)
            return true;
    }
    for (int k = 0; k < 9; k++) {
        if (k == 4)
            continue;
        cast_aside(c, x, y, k);
        oracle_spans(&c->other, c->epsilon, &c->trial);
        if (!answers_continue(c, &c->answer, &c->trial))
            return true;
    }
    return false;
}

static bool explained(struct comparison *c, const struct picture *p, int x, int y)
{
    for (int k = 0; k < 9; k++) {
        cast_aside(c, x, y, k);
        for (int i = 0; i < 3; i++) {
            oracle_spans(&c->other, thin[i] * c->epsilon, &c->trial);
            if (!check_pixel(c, &c->other, &c->trial, p, y * c->rays->width + x))
                return true;
        }
    }
    return false;
}

enum verdict compare_pixel(struct comparison *c, const struct picture *p, int x, int y)
{
    oracle_cast(c->oracle, c->rays, x, y, &c->ray);
    oracle_spans(&c->ray, c->epsilon, &c->answer);
    c->strict = true;
    c->reason = check_pixel(c, &c->ray, &c->answer, p, y * c->rays->width + x);
    if (!c->reason)
        return VERDICT_AGREES;
    c->strict = false;
    enum fit loose = check_pixel(c, &c->ray, &c->answer, p, y * c->rays->width + x);
    if (!loose)
        return VERDICT_TURNED;
    c->reason = loose;
    if (!compare_unstable(c, x, y))
        return VERDICT_WRONG;
    return explained(c, p, x, y) ? VERDICT_FORGIVEN : VERDICT_UNEXPLAINED;
}

void compare_free(struct comparison *c)
{
    oracle_ray_free(&c->ray);
    oracle_ray_free(&c->other);
    oracle_answer_free(&c->answer);
    oracle_answer_free(&c->trial);
}
