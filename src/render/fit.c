// fit.c - the camera moved and its distance chosen so that what shows fills the picture.
//
// Each pixel that shows something stands for a small square in space, its footprint. In an
// orthographic view their extent gives centre and distance at once. In a perspective one every
// footprint has to lie within the four side planes of the view; the farthest footprint of each
// plane's direction places that plane, and two opposite planes meet where the eye may stand.
// Footprints are larger than what is in them, and another eye sees other surfaces: so that is
// repeated until nothing changes by a pixel.
#include "render/fit.h"

#include "render/map.h"

#include <float.h>
#include <stdlib.h>

enum { ROUNDS = 12, COARSE_ROUNDS = 5, COARSE_SIDE = 400 };

// Of a picture: what its camera must keep.
struct frame {
    int width, height;
    double margin;
    double slope_x, slope_y; // of the side planes, margin taken off
};

// What shows, along the axes of the view and relative to the eye.
struct extent {
    double left, right, down, up; // how far footprints reach beyond side planes through the eye
    double nearest, farthest;     // depths
    int x0, y0, x1, y1;           // pixels, x1 and y1 excluded
};

static struct frame frame_of(const struct camera *c, int width, int height, double margin)
{
    double slope = tan(c->fov / 2 * (M_PI / 180));
    return (struct frame){width, height, margin, slope * (width - 2 * margin) / height,
                          slope * (height - 2 * margin) / height};
}

static struct extent measure(const struct map *m, const struct rays *rays, const struct frame *f)
{
    struct extent e = {-INFINITY, -INFINITY, -INFINITY, -INFINITY, INFINITY,
                       -INFINITY, INT32_MAX, INT32_MAX, 0,         0};
    double pixel = vec3_length(rays->step_x); // at depth 1 of a perspective view
    double slope_x = rays->orthographic ? 0 : f->slope_x;
    double slope_y = rays->orthographic ? 0 : f->slope_y;
    size_t i = 0;
    for (int y = 0; y < f->height; y++) {
        for (int x = 0; x < f->width; x++, i++) {
            if (map_is_empty_at(m, i))
                continue;
            double depth = (double)m->surface.depth[i] + rays->reference;
            double size = pixel * (rays->orthographic ? 1 : depth);
            double to_left = f->width / 2.0 - x, to_top = f->height / 2.0 - y;
            e.left = fmax(e.left, to_left * size - slope_x * depth);
            e.right = fmax(e.right, (1 - to_left) * size - slope_x * depth);
            e.up = fmax(e.up, to_top * size - slope_y * depth);
            e.down = fmax(e.down, (1 - to_top) * size - slope_y * depth);
            e.nearest = fmin(e.nearest, depth);
            e.farthest = fmax(e.farthest, depth);
            e.x0 = x < e.x0 ? x : e.x0;
            e.x1 = x + 1 > e.x1 ? x + 1 : e.x1;
            e.y0 = y < e.y0 ? y : e.y0;
            e.y1 = y + 1;
        }
    }
    return e;
}

static bool holds(const struct extent *e, const struct frame *f)
{
    int sides[4] = {e->x0, f->width - e->x1, e->y0, f->height - e->y1};
    bool tight = false;
    for (int i = 0; i < 4; i++)
        if (sides[i] < f->margin)
            return false;
    for (int i = 0; i < 4; i += 2)
        tight = tight || (sides[i] < f->margin + 1 && sides[i + 1] < f->margin + 1);
    return tight;
}

static void move(struct camera *c, const struct rays *rays, const struct frame *f,
                 const struct extent *e)
{
    struct vec3 right = vec3_normalized(rays->step_x), down = vec3_normalized(rays->step_y);
    struct vec3 ahead = light_of(rays).view_axis, place = rays_origin(rays, 0, 0);
    if (rays->orthographic) // that was the corner
        place = rays_origin(rays, (f->width - 1) / 2.0, (f->height - 1) / 2.0);
    double across = (e->left + e->right) / 2, upwards = (e->up + e->down) / 2; // half of each
    double reach = fmax(across / f->slope_x, upwards / f->slope_y);
    double middle = (e->nearest + e->farthest) / 2, distance;
    if (rays->orthographic) {
        distance = fmax(reach, 0.01 * (e->farthest - e->nearest)); // far is 100 times that
    } else {
        place = vec3_sub(place, vec3_scale(ahead, reach)); // where the planes meet
        // Between the depths that show; near is a tenth of the distance.
        distance = middle = fmin(middle + reach, 5 * (e->nearest + reach));
    }
    place = vec3_add(place, vec3_scale(right, (e->right - e->left) / 2));
    place = vec3_add(place, vec3_scale(down, (e->down - e->up) / 2));
    c->centre = vec3_add(place, vec3_scale(ahead, middle));
    c->distance = distance;
}

void camera_fit(struct camera *c, int width, int height, double margin, struct cpu_device *device,
                const struct model *model, const struct render_settings *settings)
{
    int longer = width > height ? width : height;
    double share = longer > COARSE_SIDE ? (double)COARSE_SIDE / longer : 1;
    struct frame full = frame_of(c, width, height, margin);
    struct frame coarse =
        frame_of(c, (int)ceil(width * share), (int)ceil(height * share), margin * share);
    struct map map = {0};
    bool finest = share == 1;
    for (int round = 0; round < ROUNDS; round++) {
        const struct frame *f = finest ? &full : &coarse;
        struct rays rays = camera_rays(c, f->width, f->height, model->bounds);
        struct render_stats stats;
        map_draw(&map, device, model, &rays, settings, &stats);
        struct extent e = measure(&map, &rays, f);
        bool nothing = e.nearest > e.farthest, done = !nothing && holds(&e, f);
        if (finest && (nothing || done))
            break;
        if (!nothing)
            move(c, &rays, f, &e);
        finest = finest || nothing || done || round + 1 >= COARSE_ROUNDS;
    }
    map_free(&map);
}
