// combine_flat.c - offset and fill.
#include "geom/clip.h"
#include "model/nodes.h"

const struct parameters parameters_offset = {{"r", "delta", "chamfer"}, 1};
const struct parameters parameters_fill = {{0}, 0};

static bool flat_only(const struct operands *o)
{
    if (o->kind == GEOMETRY_SOLID)
        builder_warn(o->b, o->args->node, "%s() needs flat shapes; the 3D ones are left out",
                     o->args->node->name);
    return o->kind == GEOMETRY_FLAT;
}

static void take(struct operands *o, struct outline *result, bool done, struct value *out)
{
    if (!done)
        builder_warn(o->b, o->args->node, "%s(): the shape " CLIP_REFUSED "; left out",
                     o->args->node->name);
    outline_free(&out->outline);
    out->outline = *result;
}

void combine_offset(struct operands *o, struct value *out)
{
    double distance = 1;
    struct detail d = o->args->detail;
    struct outline grown = {0};
    bool round = value_number(o->args->values[0], &distance);
    if (!round)
        value_number(o->args->values[1], &distance);
    enum clip_join join = round                            ? CLIP_ROUND
                          : value_true(o->args->values[2]) ? CLIP_CHAMFER
                                                           : CLIP_MITRE;
    d.fa = fmax(d.fa, 0.01);
    d.fs = fmax(d.fs, 0.01);
    out->kind = GEOMETRY_FLAT;
    if (!flat_only(o))
        return;
    operands_fold(o, TERM_UNION, out);
    bool done = isfinite(distance) && clip_offset(&grown, &out->outline, distance, join, d);
    take(o, &grown, done, out);
}

void combine_fill(struct operands *o, struct value *out)
{
    struct outline filled = {0};
    out->kind = GEOMETRY_FLAT;
    if (!flat_only(o))
        return;
    operands_fold(o, TERM_UNION, out);
    bool done = clip_fill(&filled, &out->outline);
    take(o, &filled, done, out);
}
