// combine_extrude.c - linear_extrude and rotate_extrude.
#include "geom/extrude.h"
#include "model/nodes.h"

const struct parameters parameters_linear_extrude = {{"file", "layer", "height", "origin", "scale",
                                                      "center", "twist", "slices", "v", "segments",
                                                      "convexity", "h", "timestamp"},
                                                     8};
const struct parameters parameters_rotate_extrude = {
    {"file", "layer", "origin", "scale", "convexity", "angle", "start", "a", "timestamp"}, 4};

// The flat shape to be extruded: of the file that old versions name, else of all children.
static void profile_of(struct operands *o, const struct csg_value *origin,
                       const struct csg_value *scale, struct value *out)
{
    const struct csg_value *file = o->args->values[0];
    if (file && file->kind == CSG_STRING && file->count) {
        struct args args = {.node = o->args->node, .detail = o->args->detail};
        args.values[IMPORT_FILE] = file;
        args.values[IMPORT_LAYER] = o->args->values[1];
        args.values[IMPORT_ORIGIN] = origin;
        args.values[IMPORT_SCALE] = scale;
        out->kind = GEOMETRY_FLAT;
        flat_import(o->b, &args, &out->outline);
        return;
    }
    if (o->kind == GEOMETRY_SOLID)
        builder_warn(o->b, o->args->node, "%s() needs flat shapes; the 3D ones are left out",
                     o->args->node->name);
    else
        operands_fold(o, TERM_UNION, out);
}

static struct detail detail_of(const struct args *args)
{
    struct detail d = args->detail;
    return (struct detail){d.fn, fmax(d.fa, 0.01), fmax(d.fs, 0.01)};
}

static void become(struct operands *o, struct mesh *m, bool convex, struct value *out)
{
    value_free(out);
    operands_become(o, store_mesh(o->b->store, m, convex), out);
}

void combine_linear_extrude(struct operands *o, struct value *out)
{
    enum { FILE_, LAYER, HEIGHT, ORIGIN, SCALE, CENTER, TWIST, SLICES, V, SEGMENTS, CONVEXITY, H };
    const struct csg_value *const *v = o->args->values;
    struct linear_extrusion how = {.height = 100,
                                   .center = value_true(v[CENTER]),
                                   .newer = !v[CONVEXITY] && !(v[CENTER] && !how.center),
                                   .detail = detail_of(o->args)};
    double scale[2] = {1, 1}, slices = 0, segments = 0, direction[3];
    if (value_numbers(v[V], direction, 3, 3)) {
        how.has_direction = true;
        how.direction = (struct vec3){direction[0], direction[1], direction[2]};
        how.height = vec3_length(how.direction);
    }
    if (!value_number(v[HEIGHT], &how.height) && !value_number(v[H], &how.height))
        value_number(v[FILE_], &how.height);
    if (how.has_direction)
        how.direction = vec3_scale(vec3_normalized(how.direction), how.height);
    if (value_number(v[SCALE], &scale[0]))
        scale[1] = scale[0];
    else
        value_numbers(v[SCALE], scale, 2, 2);
    how.scale_x = fmax(scale[0], 0);
    how.scale_y = fmax(scale[1], 0);
    value_number(v[TWIST], &how.twist);
    value_number(v[SLICES], &slices);
    how.slices = slices >= 1 ? (uint32_t)fmin(slices, UINT32_MAX) : 0;
    how.segments_given = value_number(v[SEGMENTS], &segments);
    how.segments = segments >= 1 ? (uint32_t)fmin(segments, UINT32_MAX) : 0;

    struct mesh m = {0};
    struct error err;
    bool convex = false;
    profile_of(o, v[ORIGIN], NULL, out);
    if (!isfinite(how.height) || !isfinite(how.twist) || !isfinite(scale[0] + scale[1]))
        builder_warn(o->b, o->args->node, "%s() has a size that is not finite; left out",
                     o->args->node->name);
    else if (!extrude_linear(&m, &out->outline, &how, &convex, &err))
        builder_warn(o->b, o->args->node, "%s(): %s; left out", o->args->node->name, err.text);
    become(o, &m, convex, out);
}

void combine_rotate_extrude(struct operands *o, struct value *out)
{
    enum { FILE_, LAYER, ORIGIN, SCALE, CONVEXITY, ANGLE, START, A };
    const struct csg_value *const *v = o->args->values;
    struct rotation_extrusion how = {.angle = 360, .detail = detail_of(o->args)};
    bool angle_given = value_number(v[ANGLE], &how.angle) || value_number(v[A], &how.angle) ||
                       value_number(v[FILE_], &how.angle);
    if (!(how.angle > -360 && how.angle <= 360))
        how.angle = 360;
    how.newer = value_number(v[START], &how.start);
    if (!how.newer && !angle_given)
        how.start = 180;

    struct mesh m = {0};
    struct error err;
    profile_of(o, v[ORIGIN], v[SCALE], out);
    if (!extrude_rotate(&m, &out->outline, &how, &err))
        messages_add(o->b->messages, MESSAGE_ERROR, builder_place(o->b, o->args->node),
                     "%s(): %s; left out", o->args->node->name, err.text);
    become(o, &m, false, out);
}
