// rays.h - the rays of a picture.
//
// Pixel (x, y), counted from the upper left, looks along origin + depth * direction with
//   perspective:   origin, direction forward + x * step_x + y * step_y
//   orthographic:  origin + x * step_x + y * step_y, direction forward
// where origin/forward are those of the centre of pixel (0, 0): half a pixel is already added.
// forward's component along the view axis is 1, so depth is the distance from the eye plane in mm,
// the same for all pixels: what OpenSCAD's z-buffer sorts by.
#pragma once
#include "base/vec.h"

#include <stdint.h>

struct rays {
    bool orthographic;
    struct vec3 origin, forward, step_x, step_y;
    int width, height;
    double near, far; // depths between which surfaces show; what is solid at near shows a cut face
    double reference; // depth of the centre of the scene; written depths are relative to it
};

static inline struct vec3 rays_origin(const struct rays *r, double x, double y)
{
    if (!r->orthographic)
        return r->origin;
    return vec3_add(r->origin, vec3_add(vec3_scale(r->step_x, x), vec3_scale(r->step_y, y)));
}
static inline struct vec3 rays_direction(const struct rays *r, double x, double y)
{
    if (r->orthographic)
        return r->forward;
    return vec3_add(r->forward, vec3_add(vec3_scale(r->step_x, x), vec3_scale(r->step_y, y)));
}

// Those of the rows from `first` on.
static inline struct rays rays_below(const struct rays *r, int first)
{
    struct rays below = *r;
    struct vec3 *start = r->orthographic ? &below.origin : &below.forward;
    *start = vec3_add(*start, vec3_scale(r->step_y, first));
    below.height -= first;
    return below;
}

// Where a point shows: x and y of the picture, and its depth. Behind the eye it has no place.
static inline struct vec3 rays_place(const struct rays *r, struct vec3 p)
{
    struct vec3 ahead = vec3_normalized(vec3_cross(r->step_y, r->step_x));
    p = vec3_sub(p, r->origin);
    double depth = vec3_dot(p, ahead) / vec3_dot(r->forward, ahead);
    if (!r->orthographic)
        p = vec3_sub(vec3_scale(p, 1 / depth), r->forward);
    return (struct vec3){vec3_dot(p, r->step_x) / vec3_dot(r->step_x, r->step_x),
                         vec3_dot(p, r->step_y) / vec3_dot(r->step_y, r->step_y), depth};
}
