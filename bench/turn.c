// turn.c - the views that every program of the bench draws.
#include "turn.h"

#include "render/camera.h"

struct rays turn_view(struct box scene, uint32_t view, int size)
{
    struct camera c = CAMERA_DEFAULTS;
    c.rotation.z += 360.0 * (view % TURN_VIEWS) / TURN_VIEWS;
    camera_autocenter(&c, scene);
    camera_viewall(&c, scene);
    return camera_rays(&c, size, size, scene);
}

struct rays turn_side(struct box scene, uint32_t side, int size)
{
    static const struct vec3 rotations[] = {{90, 0, 0}, {90, 0, 90}, {0, 0, 0}};
    struct camera c = CAMERA_DEFAULTS;
    c.orthographic = true;
    c.rotation = rotations[side];
    camera_autocenter(&c, scene);
    camera_viewall(&c, scene);
    return camera_rays(&c, size, size, scene);
}
