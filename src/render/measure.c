// measure.c - volume, surface, centre of mass of a model, each with the error it may have.
#include "render/measure.h"

#include "base/mem.h"
#include "render/lattice.h"

#include <stdlib.h>

enum { LATTICES = 6, AXES = 3, ALL = AXES * LATTICES };

// Student's t for the five degrees of freedom that the six lattices of one axis leave, should it
// decide alone, is 9.7 at odds of 1 : 10,000 and 6.9 at 1 : 1,000.
#define BOUND_FACTOR 10
// Of the extent: what the depth of a crossing may be wrong by.
#define DEPTH_ROUNDING 0x1p-21

#define RAYS_FIRST  4096.0 // of a lattice
#define EFFORT_MOST 0x1p26 // rays and crossings of all lattices
#define MISSED      64     // cells: a box as large as that is met, if what it holds shows
#define SHIFT_SEED  0x68637367u

// Slopes of rows: quadratic irrationals, whose multiples stay away from whole numbers.
static double row_angle(int lattice)
{
    const double slopes[LATTICES / 2] = {
        0.7320508075688772, 0.6457513110645906,
        0.7912878474779199}; // sqrt 3 - 1, sqrt 7 - 2, (sqrt 21 - 3) / 2
    return (lattice % 2 ? -1 : 1) * atan(slopes[lattice / 2]);
}

struct level {
    struct lattice_sums sums[AXES][LATTICES];
    double effort;
    uint64_t open_rays;
};

static struct box body_box(const struct body *body)
{
    struct box all = BOX_EMPTY;
    for (uint32_t i = 0; i < body->leaf_count; i++)
        if (body->expr.leaf_node[i] != EXPR_NONE)
            all = box_union(all, box_intersection(body->roi[i], body->leaves[i].box));
    return all;
}

static bool body_is_flat(const struct body *body)
{
    bool any = false;
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        if (body->expr.leaf_node[i] == EXPR_NONE)
            continue;
        if (!body->leaves[i].flat)
            return false;
        any = true;
    }
    return any;
}

static void sample(struct level *out, const struct lattice_target *target, double rays, bool flat)
{
    *out = (struct level){0};
    for (uint32_t i = 0; i < target->body->leaf_count; i++)
        atomic_store(&target->seen[i], false);
    for (int axis = flat ? AXES - 1 : 0; axis < AXES; axis++)
        for (int k = 0; k < LATTICES; k++) {
            struct lattice lattice = {.axis = axis, .rays = rays, .angle = row_angle(k)};
            lattice.random = SHIFT_SEED + (uint64_t)(axis * LATTICES + k) + ((uint64_t)rays << 8);
            lattice_sum(&out->sums[axis][k], target, &lattice);
            out->effort += out->sums[axis][k].effort;
            out->open_rays += out->sums[axis][k].open_rays;
        }
}

// The mean, and so many standard errors of it.
static struct measured estimate(const double *values, int count)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < count; i++)
        sum += values[i];
    double mean = sum / count;
    for (int i = 0; i < count; i++)
        squares += (values[i] - mean) * (values[i] - mean);
    return (struct measured){mean, BOUND_FACTOR * sqrt(squares / count / (count - 1))};
}

// What is in leaves that no ray met though they are there: volume, and surface of their boxes.
struct missed {
    double volume, area, flat;
};

static struct missed find_missed(const struct lattice_target *t, const struct level *level)
{
    struct missed missed = {0};
    for (uint32_t i = 0; i < t->body->leaf_count; i++) {
        if (t->body->expr.leaf_node[i] == EXPR_NONE || atomic_load(&t->seen[i]))
            continue;
        struct vec3 size = vec3_sub(t->body->roi[i].max, t->body->roi[i].min);
        double sides[AXES] = {size.y * size.z, size.z * size.x, size.x * size.y};
        bool small = true;
        for (int axis = 0; axis < AXES; axis++)
            small &=
                level->sums[axis][0].cell == 0 || sides[axis] < MISSED * level->sums[axis][0].cell;
        if (!small)
            continue;
        missed.volume += size.x * size.y * size.z;
        missed.area += 2 * (sides[0] + sides[1] + sides[2]);
        missed.flat += sides[2];
    }
    return missed;
}

static void evaluate_flat(struct measure *out, const struct level *level,
                          const struct missed *missed)
{
    double values[LATTICES];
    for (int k = 0; k < LATTICES; k++)
        values[k] = level->sums[2][k].covered;
    out->area = estimate(values, LATTICES);
    out->area.bound += missed->flat;
}

static double part(struct vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// A quotient of two sums: moment over volume. Its error is that of moment - centre * volume.
static struct measured centre_of(const struct level *level, int axis, double weight,
                                 const double *weights)
{
    double moment = 0, residuals[ALL];
    for (int i = 0; i < ALL; i++)
        moment += part(level->sums[i / LATTICES][i % LATTICES].moment, axis) / ALL;
    double centre = weight > 0 ? moment / weight : 0;
    for (int i = 0; i < ALL; i++)
        residuals[i] =
            part(level->sums[i / LATTICES][i % LATTICES].moment, axis) - centre * weights[i];
    return (struct measured){centre, estimate(residuals, ALL).bound / weight};
}

static void evaluate_solid(struct measure *out, const struct lattice_target *t,
                           const struct level *level, const struct missed *missed)
{
    struct vec3 size = vec3_sub(t->box.max, t->box.min);
    double values[ALL], rounding = 0, thin = 0;
    out->area = (struct measured){0};
    for (int axis = 0; axis < AXES; axis++) {
        double shares[LATTICES];
        for (int k = 0; k < LATTICES; k++) {
            const struct lattice_sums *s = &level->sums[axis][k];
            values[axis * LATTICES + k] = s->volume;
            shares[k] = s->area;
            thin += s->thin / LATTICES;
            rounding += s->crossings * s->cell * DEPTH_ROUNDING * part(size, axis) / ALL;
        }
        struct measured share = estimate(shares, LATTICES);
        out->area.value += share.value;
        out->area.bound = hypot(out->area.bound, share.bound);
    }
    out->area.bound += missed->area + 2 * thin;
    out->volume = estimate(values, ALL);
    double unseen = rounding + missed->volume + thin * t->settings.epsilon;
    for (int axis = 0; axis < AXES; axis++) {
        struct measured c = centre_of(level, axis, out->volume.value, values);
        // What was not seen pulls with its share of all, from within the box.
        double least = fmax(out->volume.value - out->volume.bound, 0);
        double reach = part(size, axis) / 2 + fabs(c.value);
        double off = c.bound + unseen / (unseen + least) * reach;
        c.bound = off < reach ? off : reach;
        c.value += (part(t->box.min, axis) + part(t->box.max, axis)) / 2;
        out->centre[axis] = c;
    }
    out->volume.bound += unseen;
}

static bool is_exact(struct measured m, double accuracy)
{
    return m.bound <= accuracy * m.value;
}

void measure_model(struct measure *out, struct device *device, const struct model *model,
                   const struct render_settings *settings, double accuracy)
{
    const struct body *body = &model->bodies[0];
    struct normals normals;
    *out = (struct measure){.flat = body_is_flat(body)};
    struct lattice_target target = {.device = device,
                                    .body = body,
                                    .normals = &normals,
                                    .settings = *settings,
                                    .box = body_box(body)};
    if (box_is_empty(target.box))
        return;
    normals_init(&normals, model);
    target.seen = mem_zalloc(body->leaf_count * sizeof *target.seen);
    struct level level;
    double spent = 0;
    for (double rays = RAYS_FIRST;; rays *= 4) {
        sample(&level, &target, rays, out->flat);
        struct missed missed = find_missed(&target, &level);
        if (out->flat)
            evaluate_flat(out, &level, &missed);
        else
            evaluate_solid(out, &target, &level, &missed);
        spent += level.effort;
        if (is_exact(out->area, accuracy) && is_exact(out->volume, accuracy))
            break;
        if (spent + 4 * level.effort > EFFORT_MOST)
            break;
    }
    out->open_rays = level.open_rays;
    free(target.seen);
    normals_free(&normals);
}

struct measured measure_mass(const struct measure *m, double density)
{
    const double per_mm3 = density / 1000;
    return (struct measured){m->volume.value * per_mm3, m->volume.bound * per_mm3};
}
