// shot.h - a finished picture: several drawings averaged, effects applied, background left out.
#pragma once
#include "render/effects.h"
#include "render/picture.h"

enum { SAMPLES_MOST = 64 };

struct shot_style {
    uint32_t samples; // drawings that are averaged, their rays spread over each pixel; from 1
    bool transparent; // leaves the background out: pixels get alpha
    uint32_t effects; // EFFECT_*
};

struct shot { // {0} is valid; buffers are kept from shot to shot
    int width, height;
    uint32_t channels;     // 3 or 4: with alpha, colours not multiplied by it
    const uint8_t *pixels; // rows from the top without padding: of `picture` or `finished`
    struct picture picture;
    struct effects effects;
    // Of what is averaged or transparent:
    uint8_t *finished;
    uint16_t *sums;   // over the samples, three per pixel
    uint16_t *bright; // of green before white, one per pixel
};

// Averages 8-bit values as they are stored, without gamma: what OpenSCAD, its frame buffers and
// viewers that scale pictures do, so that one drawn large and made smaller looks the same.
void shot_draw(struct shot *s, struct device *device, const struct shader *shader,
               const struct rays *rays, const struct render_settings *settings,
               const struct shot_style *style, struct render_stats *stats);
void shot_free(struct shot *s); // leaves {0}
