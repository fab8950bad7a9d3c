// output.c - what was drawn, written to files.
#include "command/output.h"

#include "base/mem.h"
#include "io/write_pfm.h"
#include "io/write_png.h"
#include "render/map_image.h"

#include <stdlib.h>
#include <string.h>

static bool write_pixels(const char *path, const struct drawn *d, enum png_kind kind,
                         const void *pixels, const struct png_note *notes, uint32_t note_count,
                         struct error *err)
{
    return write_png_picture(path,
                             &(struct png_picture){.width = d->width,
                                                   .height = d->height,
                                                   .kind = kind,
                                                   .pixels = pixels,
                                                   .notes = notes,
                                                   .note_count = note_count},
                             err);
}

static bool write_depthmap(const char *path, const struct drawn *d, struct error *err)
{
    struct depth_range range = map_depth_range(&d->map, &d->rays);
    char nearest[32], farthest[32];
    snprintf(nearest, sizeof nearest, "%.9g", range.nearest);
    snprintf(farthest, sizeof farthest, "%.9g", range.farthest);
    const struct png_note notes[] = {
        {"Depth nearest", nearest},
        {"Depth farthest", farthest},
        {"Depth unit", "mm from the eye plane: 65535 nearest, 1 farthest, 0 nothing"},
    };
    uint16_t *greys = mem_alloc(map_pixels(&d->map) * sizeof *greys);
    map_greys(&d->map, &d->rays, range, greys);
    bool ok = write_pixels(path, d, PNG_KIND_GREY16, greys, notes,
                           depth_range_is_known(range) ? (uint32_t)array_count(notes) : 0, err);
    free(greys);
    return ok;
}

static bool write_depths(const char *path, const struct drawn *d, struct error *err)
{
    float *depths = mem_alloc(map_pixels(&d->map) * sizeof *depths);
    map_depths(&d->map, &d->rays, depths);
    bool ok = write_pfm(path, depths, d->width, d->height, err);
    free(depths);
    return ok;
}

static bool write_normals(const char *path, const struct drawn *d, struct error *err)
{
    size_t n = map_pixels(&d->map);
    float(*normals)[3] = mem_alloc(n * sizeof *normals);
    uint8_t *rgb = mem_alloc(3 * n);
    map_normals(&d->map, &d->shader, &d->rays, d->settings.threads, normals);
    map_normal_colours((const float(*)[3])normals, n, rgb);
    bool ok = write_pixels(path, d, PNG_KIND_RGB, rgb, NULL, 0, err);
    free(normals);
    free(rgb);
    return ok;
}

static bool write_ids(const char *path, const struct drawn *d, struct error *err)
{
    uint8_t *rgb = mem_alloc(3 * map_pixels(&d->map));
    char *legend = map_legend(&d->map, d->model);
    map_ids(&d->map, d->model, rgb);
    bool ok =
        write_pixels(path, d, PNG_KIND_RGB, rgb, &(struct png_note){"Legend", legend}, 1, err);
    free(legend);
    free(rgb);
    return ok;
}

static bool write_as(enum output_kind kind, enum export_format geometry, const char *path,
                     const struct drawn *d, struct error *err)
{
    switch (kind) {
    case OUTPUT_PICTURE:
        return write_pixels(path, d, d->channels == 4 ? PNG_KIND_RGBA : PNG_KIND_RGB, d->pixels,
                            NULL, 0, err);
    case OUTPUT_DEPTHMAP:
        return write_depthmap(path, d, err);
    case OUTPUT_DEPTHS:
        return write_depths(path, d, err);
    case OUTPUT_NORMALS:
        return write_normals(path, d, err);
    case OUTPUT_IDS:
        return write_ids(path, d, err);
    case OUTPUT_PARAMETERS: // written before anything was drawn
        return true;
    case OUTPUT_GEOMETRY:
        break;
    }
    return model_export(d->model, geometry, path, err);
}

char *output_path(const struct output *o, const struct view *view)
{
    const char *mark = strstr(o->path, VIEW_MARK);
    size_t size = strlen(o->path) + strlen(view->name) + 1;
    char *name = mem_alloc(size);
    snprintf(name, size, "%.*s%s%s", (int)(mark - o->path), o->path, view->name,
             mark + strlen(VIEW_MARK));
    return name;
}

bool output_write(const struct output *o, const struct drawn *d, const struct view *view,
                  struct error *err)
{
    if (!view)
        return write_as(o->format->kind, o->format->geometry, o->path, d, err);
    char *path = output_path(o, view);
    bool ok = write_as(o->format->kind, o->format->geometry, path, d, err);
    free(path);
    return ok;
}
