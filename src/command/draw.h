// draw.h - a model drawn as a request wants it: in one view, or in several side by side.
#pragma once
#include "command/request.h"
#include "render/facets.h"
#include "render/map.h"
#include "render/shot.h"

struct drawn { // {0} is valid
    const struct request *request;
    const struct model *model;
    struct device *device; // borrowed
    struct shader shader;
    struct layers *layers;
    struct facets *facets; // when edges show
    struct render_settings settings;
    struct box box;       // to be shown
    struct camera camera; // the latest
    struct rays rays;
    struct render_stats stats;
    struct shot shot;
    struct map map; // of outputs that are no pictures
    uint8_t *sheet; // of several views
    // The picture: that of `shot`, or `sheet`.
    int width, height;
    uint32_t channels;
    const uint8_t *pixels;
};

// Draws one view alone, or with NULL what is not a file per view.
bool drawn_make(struct drawn *out, struct device *device, const struct request *r,
                const struct model *m, const struct view *view, struct error *err);
void drawn_free(struct drawn *d); // leaves {0}
