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

#define EXTENT_NONE                                                                                \
    ((struct extent){-INFINITY, -INFINITY, -INFINITY, -INFINITY, INFINITY, -INFINITY, INT32_MAX,   \
                     INT32_MAX, 0, 0})

// Grows it by a footprint: a square of this size, or a point.
static void add_footprint(struct extent *e, const struct rays *rays, const struct frame *f,
                          double across, double down, double depth, double size)
{
    double aside_x = rays->orthographic ? 0 : f->slope_x * depth;
    double aside_y = rays->orthographic ? 0 : f->slope_y * depth;
    e->left = fmax(e->left, size / 2 - across - aside_x);
    e->right = fmax(e->right, size / 2 + across - aside_x);
    e->up = fmax(e->up, size / 2 - down - aside_y);
    e->down = fmax(e->down, size / 2 + down - aside_y);
    e->nearest = fmin(e->nearest, depth);
    e->farthest = fmax(e->farthest, depth);
}

static struct extent measure(const struct map *m, const struct rays *rays, const struct frame *f)
{
    struct extent e = EXTENT_NONE;
    double pixel = vec3_length(rays->step_x); // at depth 1 of a perspective view
    size_t i = 0;
    for (int y = 0; y < f->height; y++) {
        for (int x = 0; x < f->width; x++, i++) {
            if (map_is_empty_at(m, i))
                continue;
            double depth = (double)m->surface.depth[i] + rays->reference;
            double size = pixel * (rays->orthographic ? 1 : depth);
            add_footprint(&e, rays, f, (x + 0.5 - f->width / 2.0) * size,
                          (y + 0.5 - f->height / 2.0) * size, depth, size);
            e.x0 = x < e.x0 ? x : e.x0;
            e.x1 = x + 1 > e.x1 ? x + 1 : e.x1;
            e.y0 = y < e.y0 ? y : e.y0;
            e.y1 = y + 1;
        }
    }
    return e;
}

// Axes of a view, and the place that depths count from.
struct eye {
    struct vec3 right, down, ahead, place;
};

static struct eye eye_of(const struct rays *rays, const struct frame *f)
{
    double x = (f->width - 1) / 2.0, y = (f->height - 1) / 2.0; // the middle
    return (struct eye){vec3_normalized(rays->step_x), vec3_normalized(rays->step_y),
                        light_of(rays).view_axis, rays_origin(rays, x, y)};
}

// Where something can show: in the regions of the leaves.
static struct box regions(const struct model *m)
{
    struct box all = BOX_EMPTY;
    for (uint32_t b = 0; b < m->body_count; b++) {
        const struct body *body = &m->bodies[b];
        for (uint32_t i = 0; i < body->leaf_count; i++) {
            struct box one = box_intersection(body->leaves[i].box, body->roi[i]);
            if (body->expr.leaf_node[i] != EXPR_NONE && !box_is_empty(one))
                all = box_union(all, one);
        }
    }
    return all;
}

static struct extent measure_box(struct box b, const struct rays *rays, const struct frame *f)
{
    struct extent e = EXTENT_NONE;
    struct eye eye = eye_of(rays, f);
    for (int i = 0; i < 8 && !box_is_empty(b); i++) {
        struct vec3 p = vec3_sub(box_corner(b, i), eye.place);
        add_footprint(&e, rays, f, vec3_dot(p, eye.right), vec3_dot(p, eye.down),
                      vec3_dot(p, eye.ahead), 0);
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
    struct eye eye = eye_of(rays, f);
    double across = (e->left + e->right) / 2, upwards = (e->up + e->down) / 2; // half of each
    double reach = fmax(across / f->slope_x, upwards / f->slope_y);
    double middle = (e->nearest + e->farthest) / 2;
    // The centre lies in the middle of the depths that show, but no nearest surface before the near
    // plane: that stands at a tenth of the distance, or 100 times it in front of the eye.
    if (rays->orthographic) {
        c->distance = reach;
        middle = fmin(middle, e->nearest + 90 * reach);
    } else {
        eye.place = vec3_sub(eye.place, vec3_scale(eye.ahead, reach)); // where the planes meet
        c->distance = middle = fmin(middle + reach, 9 * (e->nearest + reach));
    }
    eye.place = vec3_add(eye.place, vec3_scale(eye.right, (e->right - e->left) / 2));
    eye.place = vec3_add(eye.place, vec3_scale(eye.down, (e->down - e->up) / 2));
    c->centre = vec3_add(eye.place, vec3_scale(eye.ahead, middle));
}

void camera_fit(struct camera *c, int width, int height, double margin, struct device *device,
                const struct model *model, const struct render_settings *settings)
{
    int longer = width > height ? width : height;
    double share = longer > COARSE_SIDE ? (double)COARSE_SIDE / longer : 1;
    struct frame full = frame_of(c, width, height, margin);
    struct frame coarse =
        frame_of(c, (int)ceil(width * share), (int)ceil(height * share), margin * share);
    struct camera now = *c;
    struct rays rays = camera_rays(c, width, height, model->bounds);
    struct extent e = measure_box(regions(model), &rays, &full);
    struct map map = {0};
    bool finest = share == 1, shows = false;
    if (e.nearest > e.farthest)
        return;
    move(&now, &rays, &full, &e);
    for (int round = 0; round < ROUNDS && now.distance > 0; round++) {
        const struct frame *f = finest ? &full : &coarse;
        struct render_stats stats;
        rays = camera_rays(&now, f->width, f->height, model->bounds);
        map_draw(&map, device, model, &rays, settings, &stats);
        e = measure(&map, &rays, f);
        bool nothing = e.nearest > e.farthest, done = !nothing && holds(&e, f);
        shows |= !nothing;
        if (finest && (nothing || done))
            break;
        if (!nothing)
            move(&now, &rays, f, &e);
        finest |= nothing || done || round + 1 >= COARSE_ROUNDS;
    }
    if (shows)
        *c = now;
    map_free(&map);
}
