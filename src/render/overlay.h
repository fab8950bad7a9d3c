// overlay.h - OpenSCAD's axes, their scales, the crosshairs and the small tripod.
#pragma once
#include "render/lines.h"

struct overlay {
    const struct scheme *scheme; // borrowed
    struct vec3 centre;          // of the camera, as its distance
    double distance;
    bool axes;   // with the tripod
    bool scales; // on the axes: not without them
    bool crosshairs;
};

// What stands among the bodies, for a picture that has them or waits for them.
void overlay_draw_among(const struct overlay *o, const struct rays *rays, const struct canvas *c);
// What lies over the finished picture.
void overlay_draw_over(const struct overlay *o, const struct rays *rays, const struct canvas *c);
