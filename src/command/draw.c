// draw.c - a model drawn as a request wants it: in one view, or in several side by side.
#include "command/draw.h"

#include "base/mem.h"
#include "render/extent.h"
#include "render/fit.h"
#include "render/label.h"

#include <stdlib.h>
#include <string.h>

// What --viewall and --autocenter show: as in OpenSCAD the whole shapes of a preview, and of
// geometry what is there.
static struct box box_to_show(const struct drawn *d)
{
    bool solid = d->model->mode == MODEL_RENDER && !d->model->flat;
    return solid ? extent_find(d->device, d->model, &d->settings) : d->model->bounds;
}

static bool place_camera(struct drawn *d, const struct view *view, int width, int height,
                         struct error *err)
{
    const struct request *r = d->request;
    bool whole = view || r->style.fits;
    struct camera *c = &d->camera;
    *c = r->camera;
    if (view)
        c->rotation = view->rotation;
    if (r->autocenter || whole)
        camera_autocenter(c, d->box);
    if (r->viewall || whole)
        camera_viewall(c, d->box);
    if (!(c->distance > 0)) {
        error_set(err, "--camera: the distance must be above 0");
        return false;
    }
    if (r->style.fits) {
        int shorter = width < height ? width : height;
        double margin = fmin(style_margin(&r->style, width, height), (shorter - 1) / 2.0);
        camera_fit(c, width, height, margin, d->device, d->model, &d->settings);
    }
    return true;
}

// As the camera stands.
static void draw_shot(struct drawn *d, int width, int height)
{
    struct render_stats stats;
    const struct overlay overlay = {.scheme = d->request->scheme,
                                    .centre = d->camera.centre,
                                    .distance = d->camera.distance,
                                    .axes = d->request->view.axes,
                                    .scales = d->request->view.scales,
                                    .crosshairs = d->request->view.crosshairs};
    d->rays = camera_rays(&d->camera, width, height, d->model->bounds);
    d->shot.picture.overlay = &overlay;
    shot_draw(&d->shot, d->device, &d->shader, &d->rays, &d->settings, &d->request->style.shot,
              &stats);
    d->shot.picture.overlay = NULL;
    render_stats_add(&d->stats, &stats);
}

static bool draw_map(struct drawn *d, const struct view *view, struct error *err)
{
    const struct request *r = d->request;
    struct render_stats stats;
    if (!place_camera(d, view, r->width, r->height, err))
        return false;
    d->rays = camera_rays(&d->camera, r->width, r->height, d->model->bounds);
    d->map.model_only = true;
    map_draw(&d->map, d->device, d->model, &d->rays, &d->settings, &stats);
    render_stats_add(&d->stats, &stats);
    return true;
}

static bool draw_picture(struct drawn *d, const struct view *view, struct error *err)
{
    if (!place_camera(d, view, d->request->width, d->request->height, err))
        return false;
    draw_shot(d, d->request->width, d->request->height);
    d->pixels = d->shot.pixels;
    return true;
}

// What no view covers: the background, of a gradient its upper colour.
static void clear_sheet(struct drawn *d)
{
    struct rgb c = d->request->scheme->background;
    const uint8_t empty[4] = {0}, paper[4] = {c.r, c.g, c.b, 255};
    size_t n = (size_t)d->width * (size_t)d->height;
    d->sheet = mem_alloc(n * d->channels);
    for (size_t i = 0; i < n; i++)
        memcpy(d->sheet + d->channels * i, d->channels == 4 ? empty : paper, d->channels);
    d->pixels = d->sheet;
}

static bool draw_sheet(struct drawn *d, struct error *err)
{
    const struct view_list *views = &d->request->style.views;
    struct sheet_layout layout = sheet_layout(d->width, d->height, views->count);
    if (!layout.columns) {
        error_set(err, "--views: %u views need more than %d x %d pixels", views->count, d->width,
                  d->height);
        return false;
    }
    struct camera cameras[VIEWS_MOST];
    double farthest = 0; // one scale for all
    for (uint32_t i = 0; i < views->count; i++) {
        if (!place_camera(d, &views->items[i], layout.width, layout.height, err))
            return false;
        cameras[i] = d->camera;
        farthest = fmax(farthest, d->camera.distance);
    }
    clear_sheet(d);
    for (uint32_t i = 0; i < views->count; i++) {
        d->camera = cameras[i];
        d->camera.distance = farthest;
        draw_shot(d, layout.width, layout.height);
        int x = (int)i % layout.columns * layout.width, y = (int)i / layout.columns * layout.height;
        size_t row = (size_t)layout.width * d->channels;
        for (int k = 0; k < layout.height; k++)
            memcpy(d->sheet + d->channels * ((size_t)(y + k) * (size_t)d->width + (size_t)x),
                   d->shot.pixels + (size_t)k * row, row);
        const struct label_place place = {
            .pixels = d->sheet + d->channels * ((size_t)y * (size_t)d->width + (size_t)x),
            .stride = d->channels * (size_t)d->width,
            .width = layout.width,
            .height = layout.height,
            .channels = (int)d->channels,
        };
        label_draw(&place, views->items[i].name, d->request->scheme->axes);
    }
    return true;
}

// As OpenSCAD: of evaluated geometry the result of a boolean shows its edges, a lone shape none.
static void want_edges(struct drawn *d)
{
    const struct view_options *v = &d->request->view;
    if (d->model->mode == MODEL_THROWN_TOGETHER && v->edges)
        d->shot.picture.sides = d->facets = facets_new(d->model);
    if (d->model->mode == MODEL_PREVIEW && v->edges)
        d->shader.edges = d->facets = facets_new(d->model);
    if (d->model->mode != MODEL_RENDER || d->model->single || d->model->flat)
        return;
    if (v->edges || v->wireframe)
        d->shot.picture.wires = d->facets = facets_new(d->model);
    d->shot.picture.bare = v->wireframe;
}

bool drawn_make(struct drawn *out, struct device *device, const struct request *r,
                const struct model *m, const struct view *view, struct error *err)
{
    struct drawn d = {
        .request = r,
        .model = m,
        .device = device,
        .settings = {.epsilon = model_epsilon(m, r->epsilon),
                     .threads = r->threads,
                     .memory = r->memory},
        .width = r->width,
        .height = r->height,
        .channels = r->style.shot.transparent ? 4 : 3,
    };
    bool ok = true, draws = request_draws(r, view), maps = request_maps(r, view);
    if (draws || maps) {
        d.box = box_to_show(&d);
        shader_init(&d.shader, m, r->scheme);
        if (draws && !r->sorted)
            d.shader.layers = d.layers = layers_new(&d.shader);
    }
    if (draws)
        want_edges(&d);
    if (draws)
        ok = !view && r->style.views.count ? draw_sheet(&d, err) : draw_picture(&d, view, err);
    if (ok && maps)
        ok = draw_map(&d, view, err);
    *out = d;
    if (!ok)
        drawn_free(out);
    return ok;
}

void drawn_free(struct drawn *d)
{
    layers_delete(d->layers);
    facets_delete(d->facets);
    shader_free(&d->shader);
    shot_free(&d->shot);
    map_free(&d->map);
    free(d->sheet);
    *d = (struct drawn){0};
}
