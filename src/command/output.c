// output.c - what is asked for, drawn and written.
#include "command/output.h"

#include "io/write_png.h"
#include "render/extent.h"

bool request_draws(const struct request *r)
{
    bool draws = r->summary;
    for (uint32_t i = 0; i < r->output_count; i++)
        draws |= r->outputs[i].format->kind == OUTPUT_PICTURE;
    return draws;
}

// What --viewall and --autocenter show: as in OpenSCAD the whole shapes of a preview, and of
// geometry what is there.
static struct box box_to_show(const struct model *m, struct cpu_device *device,
                              const struct render_settings *settings)
{
    return m->mode == MODEL_RENDER && !m->flat ? extent_find(device, m, settings) : m->bounds;
}

static bool place_camera(struct camera *c, const struct request *r, struct box box,
                         struct error *err)
{
    *c = r->camera;
    if (r->autocenter)
        camera_autocenter(c, box);
    if (r->viewall)
        camera_viewall(c, box);
    if (c->distance > 0)
        return true;
    error_set(err, "--camera: the distance must be above 0");
    return false;
}

static void draw(struct drawn *out, const struct request *r, const struct model *m,
                 struct cpu_device *device, const struct render_settings *settings)
{
    struct rays rays = camera_rays(&out->camera, r->width, r->height, m->bounds);
    const struct overlay overlay = {.scheme = r->scheme,
                                    .centre = out->camera.centre,
                                    .distance = out->camera.distance,
                                    .axes = r->view.axes,
                                    .scales = r->view.scales,
                                    .crosshairs = r->view.crosshairs};
    struct shader shader;
    shader_init(&shader, m, r->scheme);
    out->picture.overlay = &overlay;
    picture_draw(&out->picture, device, &shader, &rays, settings, &out->stats);
    out->picture.overlay = NULL;
    shader_free(&shader);
}

bool drawn_make(struct drawn *out, const struct request *r, const struct model *m,
                struct error *err)
{
    const struct render_settings settings = {
        .epsilon = model_epsilon(m, r->epsilon), .threads = r->threads, .memory = r->memory};
    struct cpu_device *device = cpu_device_new();
    *out = (struct drawn){0};
    bool placed = place_camera(&out->camera, r, box_to_show(m, device, &settings), err);
    if (placed)
        draw(out, r, m, device, &settings);
    cpu_device_delete(device);
    return placed;
}

void drawn_free(struct drawn *d)
{
    picture_free(&d->picture);
    *d = (struct drawn){0};
}

bool output_write(const struct output *o, const struct drawn *d, const struct model *m,
                  struct error *err)
{
    switch (o->format->kind) {
    case OUTPUT_PICTURE:
        return write_png(o->path, d->picture.rgb, d->picture.width, d->picture.height, err);
    case OUTPUT_GEOMETRY:
        break;
    }
    return model_export(m, o->format->geometry, o->path, err);
}
