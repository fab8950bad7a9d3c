// combine_hull.c - hull and minkowski.
#include "geom/border.h"
#include "geom/clip.h"
#include "geom/extrude.h"
#include "geom/hull.h"
#include "geom/minkowski.h"
#include "model/nodes.h"

#include <stdlib.h>

const struct parameters parameters_hull = {{0}, 0};
const struct parameters parameters_minkowski = {{"convexity"}, 1};

enum { SUM_PARTS_MOST = 50000 };

// ---------------------------------------------------------------- hull

static void hull_flat(struct operands *o, struct value *out)
{
    struct outline all = {0};
    for (uint32_t i = 0; i < o->count; i++)
        outline_append(&all, &o->values[i].outline);
    hull_outline(&out->outline, all.points, all.point_count);
    outline_free(&all);
}

// Points in one plane: a plate that is pressed flat into it, as a flat matrix would do.
static void add_sheet(struct operands *o, const struct mesh *sheet, struct value *out)
{
    struct affine flat, back;
    struct outline all = {0}, hull = {0};
    struct mesh plate;
    bool convex;
    mesh_largest_plane(sheet, &flat);
    if (!affine_inverse(&flat, &back))
        return;
    for (uint32_t i = 0; i < sheet->vertex_count; i++) {
        struct vec3 p = affine_point(&back, sheet->vertices[i]);
        outline_add(&all, (struct vec2){p.x, p.y});
    }
    outline_close(&all);
    hull_outline(&hull, all.points, all.point_count);
    extrude_slab(&plate, &hull, -0.5, 0.5, &convex);
    operands_add(o, store_mesh(o->b->store, &plate, convex), out);
    for (int i = 0; i < 3; i++)
        flat.m[i][2] = 0;
    operands_move(o, &flat);
    outline_free(&all);
    outline_free(&hull);
}

// Points that a file meant to lie in one plane are off by the rounding of its numbers.
static bool is_sheet(const struct mesh *m)
{
    struct box box = mesh_bounds(m);
    double extent = vec3_length(vec3_sub(box.max, box.min));
    return 2 * mesh_volume(m) < 4e-6 * extent * mesh_area(m) / 2;
}

static void hull_solids(struct operands *o, struct value *out)
{
    struct point_list points = {0};
    struct mesh m = {0};
    bool done = true;
    for (uint32_t i = 0; i < o->count && done; i++)
        if (o->values[i].kind == GEOMETRY_SOLID)
            done = operands_points(o, o->values[i].term, &points);
    operands_become(o, NULL, out);
    if (done && hull_solid(&m, points.items, points.count) && !is_sheet(&m))
        operands_add(o, store_mesh(o->b->store, &m, true), out);
    else if (done && (m.triangle_count || hull_sheet(&m, points.items, points.count)))
        add_sheet(o, &m, out);
    mesh_free(&m);
    free(points.items);
}

void combine_hull(struct operands *o, struct value *out)
{
    out->kind = o->kind;
    if (o->kind == GEOMETRY_FLAT)
        hull_flat(o, out);
    if (o->kind == GEOMETRY_SOLID)
        hull_solids(o, out);
}

// ---------------------------------------------------------------- minkowski

// Unlike solids, an empty flat shape makes the sum empty.
static void sum_flat(struct operands *o, struct value *out)
{
    bool done = true, first = true;
    for (uint32_t i = 0; i < o->count && done; i++) {
        struct outline sum = {0};
        if (o->values[i].kind != GEOMETRY_FLAT)
            continue;
        if (first)
            outline_copy(&sum, &o->values[i].outline);
        else if (out->outline.path_count && o->values[i].outline.path_count)
            done = clip_minkowski(&sum, &out->outline, &o->values[i].outline);
        first = false;
        outline_free(&out->outline);
        out->outline = sum;
    }
    if (!done)
        builder_warn(o->b, o->args->node, "minkowski(): a flat shape " CLIP_REFUSED "; left out");
}

// All parts of one with all parts of the other.
static bool sum_parts(struct operands *o, struct mesh_parts *a, const struct mesh_parts *b)
{
    struct mesh_parts all = {0};
    bool done = true;
    for (uint32_t i = 0; i < a->count && done; i++)
        for (uint32_t k = 0; k < b->count && done; k++) {
            struct minkowski_sum sum = {0};
            uint32_t most = SUM_PARTS_MOST - all.count;
            done = minkowski_parts(&sum, &a->items[i], &b->items[k], most, 0);
            for (uint32_t p = 0; p < sum.count; p++)
                mesh_parts_add(&all, &sum.parts[p].mesh, sum.parts[p].convex);
            minkowski_free(&sum);
        }
    if (!done)
        builder_warn(o->b, o->args->node, "minkowski() would have more than %d parts; left out",
                     SUM_PARTS_MOST);
    mesh_parts_free(a);
    *a = all;
    return done;
}

// As in OpenSCAD, where a mesh with holes leaves nothing of the sum.
static bool parts_are_closed(struct operands *o, const struct mesh_parts *parts)
{
    for (uint32_t i = 0; i < parts->count; i++)
        if (!parts->items[i].convex && mesh_has_border(&parts->items[i].mesh)) {
            builder_warn(o->b, o->args->node, "minkowski(): a mesh is not closed; left out");
            return false;
        }
    return true;
}

static void sum_solids(struct operands *o, struct value *out)
{
    struct mesh_parts sum = {0};
    uint32_t taken = 0;
    bool done = true;
    for (uint32_t i = 0; i < o->count && done; i++) {
        struct mesh_parts next = {0};
        if (o->values[i].kind == GEOMETRY_SOLID)
            done = operands_parts(o, o->values[i].term, &next);
        if (!next.count)
            continue; // what is empty does not count
        if (++taken == 1) {
            out->term = o->values[i].term; // alone it stays what it is
            sum = next;
        } else {
            done = done && (taken > 2 || parts_are_closed(o, &sum)) && parts_are_closed(o, &next) &&
                   sum_parts(o, &sum, &next);
            mesh_parts_free(&next);
        }
    }
    if (taken > 1)
        operands_become(o, NULL, out);
    for (uint32_t i = 0; i < sum.count && done && taken > 1; i++) {
        struct solid *part = &sum.items[i];
        operands_add(o, store_mesh(o->b->store, &part->mesh, part->convex), out);
    }
    mesh_parts_free(&sum);
}

void combine_minkowski(struct operands *o, struct value *out)
{
    out->kind = o->kind;
    if (o->kind == GEOMETRY_FLAT)
        sum_flat(o, out);
    if (o->kind == GEOMETRY_SOLID)
        sum_solids(o, out);
}
