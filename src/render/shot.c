// shot.c - a finished picture: several drawings averaged, effects applied, background left out.
//
// What is transparent is drawn twice, before black and before white: the difference is what the
// background would have given, hence alpha, and the first is the colour times alpha. That holds
// however the picture was made, as long as it was mixed from its background.
#include "render/shot.h"

#include "base/mem.h"
#include "base/parallel.h"

#include <stdlib.h>

// Hammersley's points around the middle of the pixel: even in both directions for every number.
static void offset_of(uint32_t sample, uint32_t samples, double *x, double *y)
{
    double sum = 0, own = 0;
    for (uint32_t i = 0; i < samples; i++) {
        double place = 0, digit = 0.5;
        for (uint32_t bits = i; bits; bits >>= 1, digit /= 2)
            place += (bits & 1) * digit;
        sum += place;
        own = i == sample ? place : own;
    }
    *x = (sample + 0.5) / samples - 0.5;
    *y = own - sum / samples;
}

static struct rays shifted(const struct rays *rays, double x, double y)
{
    struct rays r = *rays;
    r.origin = rays_origin(rays, x, y);
    r.forward = rays_direction(rays, x, y);
    return r;
}

// Buffers for what is not a single drawing, empty ones.
static void reserve(struct shot *s, size_t pixels)
{
    free(s->finished);
    free(s->sums);
    free(s->bright);
    s->finished = mem_alloc(pixels * s->channels);
    s->sums = mem_zalloc(pixels * 3 * sizeof *s->sums);
    s->bright = mem_zalloc(pixels * sizeof *s->bright);
}

// What is done to each row.
struct row_job {
    struct shot *shot;
    const struct shot_style *style;
};

// Darkens the drawing.
static void light_row(void *context, uint32_t y, uint32_t worker)
{
    (void)worker;
    const struct row_job *j = context;
    size_t width = (size_t)j->shot->width, row = y * width;
    for (size_t i = row; i < row + width; i++)
        for (size_t k = 3 * i; k < 3 * i + 3; k++) {
            float lit = (float)j->shot->picture.rgb[k] * j->shot->effects.light[i];
            j->shot->picture.rgb[k] = (uint8_t)(lit + 0.5f);
        }
}

static void add_row(void *context, uint32_t y, uint32_t worker)
{
    (void)worker;
    const struct row_job *j = context;
    size_t width = 3 * (size_t)j->shot->width, row = y * width;
    for (size_t i = row; i < row + width; i++)
        j->shot->sums[i] = (uint16_t)(j->shot->sums[i] + j->shot->picture.rgb[i]);
}

static void add_bright_row(void *context, uint32_t y, uint32_t worker)
{
    (void)worker;
    const struct row_job *j = context;
    size_t width = (size_t)j->shot->width, row = y * width;
    for (size_t i = row; i < row + width; i++)
        j->shot->bright[i] = (uint16_t)(j->shot->bright[i] + j->shot->picture.rgb[3 * i + 1]);
}

static void finish_row(void *context, uint32_t y, uint32_t worker)
{
    (void)worker;
    const struct row_job *j = context;
    const struct shot *s = j->shot;
    uint32_t samples = j->style->samples, full = 255 * samples;
    size_t width = (size_t)s->width, row = y * width;
    for (size_t i = row; i < row + width; i++) {
        const uint16_t *sum = s->sums + 3 * i;
        uint8_t *out = s->finished + s->channels * i;
        uint32_t cover = full; // alpha times the number of samples
        if (s->channels == 4) {
            int behind = s->bright[i] - sum[1];
            cover = behind > 0 ? full - (uint32_t)behind : full;
            out[3] = (uint8_t)((cover + samples / 2) / samples);
        }
        for (int k = 0; k < 3; k++) {
            uint32_t colour = cover ? (sum[k] * 255u + cover / 2) / cover : 0;
            out[k] = (uint8_t)(colour < 255 ? colour : 255);
        }
    }
}

// One drawing into s->picture.
static void draw(struct shot *s, struct device *device, const struct shader *shader,
                 const struct rays *rays, const struct render_settings *settings,
                 const struct shot_style *style, struct render_stats *stats)
{
    struct render_stats one;
    picture_draw(&s->picture, device, shader, rays, settings, &one);
    render_stats_add(stats, &one);
    if (style->effects)
        parallel_for((uint32_t)s->height, settings->threads, light_row,
                     &(struct row_job){s, style});
}

static struct scheme plain(const struct scheme *from, uint8_t grey)
{
    struct scheme scheme = *from;
    scheme.background = scheme.background_bottom = (struct rgb){grey, grey, grey};
    return scheme;
}

// All drawings of a picture that is averaged or transparent.
static void draw_samples(struct shot *s, struct device *device, const struct shader *shader,
                         const struct rays *rays, const struct render_settings *settings,
                         const struct shot_style *style, struct render_stats *stats)
{
    uint32_t rows = (uint32_t)s->height;
    struct row_job job = {s, style};
    struct scheme black = plain(shader->scheme, 0), white = plain(shader->scheme, 255);
    struct shader before_black = *shader, before_white = *shader;
    before_black.scheme = &black;
    before_white.scheme = &white;
    for (uint32_t i = 0; i < style->samples; i++) {
        double x, y;
        offset_of(i, style->samples, &x, &y);
        struct rays r = shifted(rays, x, y);
        if (style->effects)
            effects_draw(&s->effects, device, shader, &r, settings, style->effects, i,
                         style->samples);
        draw(s, device, style->transparent ? &before_black : shader, &r, settings, style, stats);
        parallel_for(rows, settings->threads, add_row, &job);
        if (!style->transparent)
            continue;
        draw(s, device, &before_white, &r, settings, style, stats);
        parallel_for(rows, settings->threads, add_bright_row, &job);
    }
    parallel_for(rows, settings->threads, finish_row, &job);
    s->pixels = s->finished;
}

void shot_draw(struct shot *s, struct device *device, const struct shader *shader,
               const struct rays *rays, const struct render_settings *settings,
               const struct shot_style *style, struct render_stats *stats)
{
    *stats = (struct render_stats){0};
    s->width = rays->width;
    s->height = rays->height;
    s->channels = style->transparent ? 4 : 3;
    if (style->samples > 1 || style->transparent) {
        reserve(s, (size_t)s->width * (size_t)s->height);
        draw_samples(s, device, shader, rays, settings, style, stats);
        return;
    }
    if (style->effects)
        effects_draw(&s->effects, device, shader, rays, settings, style->effects, 0, 1);
    draw(s, device, shader, rays, settings, style, stats);
    s->pixels = s->picture.rgb;
}

void shot_free(struct shot *s)
{
    picture_free(&s->picture);
    effects_free(&s->effects);
    free(s->finished);
    free(s->sums);
    free(s->bright);
    *s = (struct shot){0};
}
