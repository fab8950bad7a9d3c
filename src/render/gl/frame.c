// frame.c - the numbers of a picture that all passes share.
#include "render/gl/frame.h"

#include "render/depth_key.h"

static void put(double out[3], struct vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

void gl_frame_init(struct frame_data *f, const struct body *body, const struct rays *rays,
                   const struct render_settings *settings)
{
    struct vec3 axis = depth_axis(rays);
    struct vec3 x = vec3_scale(rays->step_x, 1 / vec3_dot(rays->step_x, rays->step_x));
    struct vec3 y = vec3_scale(rays->step_y, 1 / vec3_dot(rays->step_y, rays->step_y));
    *f = (struct frame_data){.orthographic = rays->orthographic,
                             .mirrored = vec3_dot(axis, vec3_cross(rays->step_x, rays->step_y)) < 0,
                             .width = rays->width,
                             .height = rays->height,
                             .rows = rays->height,
                             .columns = rays->width,
                             .t0 = depth_key_origin(rays),
                             .near = rays->near,
                             .far = rays->far,
                             .epsilon = settings->epsilon,
                             .margin = roi_margin(settings->epsilon),
                             .borders = body->borders,
                             .leaf_count = body->leaf_count,
                             .slab_first = 1,
                             .slab_last = 1};
    if (!rays->orthographic) { // forward itself is pixel (0, 0)
        x = vec3_sub(x, vec3_scale(axis, vec3_dot(rays->forward, x)));
        y = vec3_sub(y, vec3_scale(axis, vec3_dot(rays->forward, y)));
    }
    f->clip = depth_clip(rays, f->t0);
    put(f->origin, rays->origin);
    put(f->forward, rays->forward);
    put(f->step_x, rays->step_x);
    put(f->step_y, rays->step_y);
    put(f->axis, axis);
    put(f->dual_x, x);
    put(f->dual_y, y);
    f->start = (float)depth_key(rays, f->t0, rays->near);
    f->end = (float)depth_key(rays, f->t0, rays->far);
    f->to_depth = (float)(1 / f->t0);
    f->shift = (float)(f->t0 - rays->reference);
    f->slab_end = f->end;
}

bool gl_frame_range(const struct frame_data *f, const struct rays *rays, const struct body *body,
                    float *near, float *far)
{
    struct box all = BOX_EMPTY;
    struct vec3 axis = depth_axis(rays);
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < body->leaf_count; i++)
        all = box_union(all, body->leaves[i].box);
    if (box_is_empty(all))
        return false;
    for (int i = 0; i < 8; i++) {
        double t = vec3_dot(axis, vec3_sub(box_corner(all, i), rays->origin));
        low = fmin(low, t);
        high = fmax(high, t);
    }
    *near = low <= rays->near ? f->start : (float)depth_key(rays, f->t0, low);
    *far = high >= rays->far ? f->end : (float)depth_key(rays, f->t0, high);
    return high > rays->near && low < rays->far;
}
