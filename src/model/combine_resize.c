// combine_resize.c - resize.
#include "model/nodes.h"

#include <stdlib.h>

const struct parameters parameters_resize = {{"newsize", "auto", "convexity"}, 3};

// Which axes follow the others: one answer for all, or one each, as truth or as 0 and 1.
static void read_auto(const struct csg_value *v, bool out[3])
{
    struct csg_value hold;
    for (uint32_t i = 0; i < 3; i++) {
        const struct csg_value *one = v;
        double number = 0;
        if (value_is_vector(v))
            one = i < v->count ? value_item(v, i, &hold) : NULL;
        out[i] = value_true(one) || (value_number(one, &number) && number != 0);
    }
}

static void factors(const struct args *args, const double now[3], uint32_t axes, double out[3])
{
    double wanted[3] = {0};
    bool follows[3];
    uint32_t leader = 0;
    value_numbers(args->values[0], wanted, 1, 3);
    read_auto(args->values[1], follows);
    for (uint32_t i = 1; i < axes; i++)
        if (wanted[i] > wanted[leader])
            leader = i;
    for (uint32_t i = 0; i < 3; i++)
        out[i] = i < axes && wanted[i] > 0 && now[i] > 0 ? wanted[i] / now[i] : 1;
    for (uint32_t i = 0; i < axes; i++)
        if (follows[i] && !(wanted[i] > 0))
            out[i] = out[leader];
}

static void size_of(struct box box, double out[3])
{
    const double sizes[3] = {box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z};
    for (int i = 0; i < 3; i++)
        out[i] = box_is_empty(box) ? 0 : sizes[i];
}

static struct affine scaling(const double f[3])
{
    return (struct affine){{{f[0], 0, 0, 0}, {0, f[1], 0, 0}, {0, 0, f[2], 0}}};
}

void combine_resize(struct operands *o, struct value *out)
{
    double now[3], f[3];
    operands_fold(o, TERM_UNION, out);
    if (o->kind == GEOMETRY_FLAT) {
        size_of(outline_bounds(&out->outline), now);
        factors(o->args, now, 2, f);
        struct affine a = scaling(f);
        value_place(o->b, o->args->node, out, &a);
    }
    if (o->kind != GEOMETRY_SOLID)
        return;
    struct point_list points = {0};
    struct box box = BOX_EMPTY;
    if (operands_points(o, out->term, &points)) {
        for (uint32_t i = 0; i < points.count; i++)
            box = box_union(box, (struct box){points.items[i], points.items[i]});
        size_of(box, now);
        factors(o->args, now, 3, f);
        struct affine a = scaling(f);
        operands_move(o, &a);
    } else {
        operands_become(o, NULL, out);
    }
    free(points.items);
}
