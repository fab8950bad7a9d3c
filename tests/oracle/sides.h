// sides.h - views of bodies: of random trees, and of files from several sides.
#pragma once
#include "random_tree.h"
#include "render/device.h"

struct side {
    char name[64];
    const struct body *body;
    struct rays rays;
    struct render_settings settings;
    double tolerance; // of depth
    bool aligned;     // with the axes: faces seen edge-on are on pixel centres
};

void side_of_scene(struct side *out, const struct random_scene *scene, const struct body *body);

// Calls `see` for each side of each body; false, with messages on stderr, when there is no model.
bool sides_of_file(const char *path, int width, int height,
                   void (*see)(void *context, const struct side *side), void *context);
