// sides.c - views of bodies.
#include "sides.h"

#include "csg/csg.h"

enum { SIDES = 4 };

static struct rays look_at(struct box box, int width, int height, int side)
{
    static const struct vec3 from[SIDES] = {
        {0.5, -0.7, 0.5}, {0, 0, 1}, {-0.3, 0.9, -0.2}, {1, 0, 0}};
    struct vec3 centre = vec3_scale(vec3_add(box.min, box.max), 0.5);
    double size = vec3_length(vec3_sub(box.max, box.min)), distance = 2 * size;
    struct vec3 forward = vec3_scale(vec3_normalized(from[side]), -1);
    struct vec3 up = fabs(forward.z) > 0.9 ? (struct vec3){0, 1, 0} : (struct vec3){0, 0, 1};
    struct vec3 right = vec3_normalized(vec3_cross(forward, up));
    struct vec3 down = vec3_cross(forward, right);
    struct rays r = {.orthographic = side % 2, .width = width, .height = height};
    double step = (r.orthographic ? size : 0.5) / (height < width ? height : width);
    r.step_x = vec3_scale(right, step);
    r.step_y = vec3_scale(down, step);
    struct vec3 corner = vec3_add(vec3_scale(r.step_x, -0.5 * (width - 1) + 0.0123),
                                  vec3_scale(r.step_y, -0.5 * (height - 1) + 0.0321));
    r.origin = vec3_sub(centre, vec3_scale(forward, distance));
    r.forward = forward;
    if (r.orthographic)
        r.origin = vec3_add(r.origin, corner);
    else
        r.forward = vec3_add(r.forward, corner);
    r.near = 1e-3 * size;
    r.far = 10 * size;
    r.reference = distance;
    return r;
}

void side_of_scene(struct side *out, const struct random_scene *scene, const struct body *body)
{
    *out = (struct side){.body = body,
                         .rays = scene->rays,
                         .settings = {.epsilon = scene->epsilon, .threads = 1},
                         .tolerance = 2e-3,
                         .aligned = scene->aligned};
}

static void see_bodies(const struct model *model, int width, int height, double epsilon,
                       void (*see)(void *context, const struct side *side), void *context)
{
    double size = vec3_length(vec3_sub(model->bounds.max, model->bounds.min));
    for (uint32_t b = 0; b < model->body_count; b++)
        for (int i = 0; i < SIDES; i++) {
            struct side side = {.body = &model->bodies[b],
                                .rays = look_at(model->bounds, width, height, i),
                                .settings = {.epsilon = model_epsilon(model, epsilon)},
                                .tolerance = fmax(2e-3, 2e-6 * size),
                                .aligned = i % 2};
            snprintf(side.name, sizeof side.name, "body %u view %d", b, i);
            see(context, &side);
        }
}

bool sides_of_file(const char *path, int width, int height,
                   void (*see)(void *context, const struct side *side), void *context)
{
    struct messages messages = {0};
    struct csg_tree tree;
    if (!csg_parse_file(&tree, path, &messages)) {
        messages_print(&messages, stderr);
        messages_free(&messages);
        return false;
    }
    struct model_options options = MODEL_DEFAULTS;
    struct solid_store *store = solid_store_new();
    struct model model;
    model_build(&model, &tree, store, &options, &messages);
    see_bodies(&model, width, height, options.epsilon, see, context);
    messages_free(&messages);
    model_free(&model);
    solid_store_delete(store);
    csg_free(&tree);
    return true;
}
