// depth_key.h - the measure of depth in which devices sort crossings.
//
// A number that grows along a ray and that every plane gives as an affine function of the pixel:
//   orthographic: key = t - t0          perspective: key = t0 - t0 * t0 / t
// t is the depth of rays.h, t0 a depth inside the scene. Near t0 keys are millimetres in both
// cases. Devices agree to the pixel only if they measure alike, hence one place for it.
#pragma once
#include "render/rays.h"

// Into the picture; of length 1.
static inline struct vec3 depth_axis(const struct rays *r)
{
    struct vec3 axis = vec3_normalized(vec3_cross(r->step_x, r->step_y));
    return vec3_dot(axis, r->forward) < 0 ? vec3_scale(axis, -1) : axis;
}

static inline double depth_key_origin(const struct rays *r) // t0
{
    return r->orthographic ? r->reference : fmax(r->reference, 2 * r->near);
}

static inline double depth_key(const struct rays *r, double t0, double depth)
{
    return r->orthographic ? depth - t0 : t0 - t0 * t0 / depth;
}

// In perspective, the depth at which faces that reach behind the eye are cut off.
static inline double depth_clip(const struct rays *r, double t0)
{
    return fmax(r->near * 0.5, t0 * 1e-3);
}
