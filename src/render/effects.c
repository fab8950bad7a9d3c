// effects.c - what makes shapes readable: darkness in corners, and lines along edges.
//
// Both are worked out in the space of the viewer from the depths and normals of the pixels around,
// so they cost the same for every model.
//
// Occlusion: in some directions over the picture the steepest surface above the pixel's own plane
// is looked for within a radius. A horizon at elevation h takes sin(h)^2 of the light of its slice
// of an even sky; what is farther counts less and less, or a wall behind a thin rod would darken
// it. No noise: the directions are the same everywhere, and enough of them.
#include "render/effects.h"

#include "base/angle.h"
#include "base/mem.h"
#include "base/parallel.h"

#include <stdlib.h>

#define RADIUS         (1.0f / 8) // of the picture's shorter side, where the scene's centre is
#define NEAREST_RADIUS (1.0f / 4) // of it, however close the surface is
#define DARKEST        0.9f       // share of the light that occlusion takes at most
#define STEP           3.0f       // of depth that makes a line, in pixels
#define CREASE         0.80f      // cosine of the angle between faces that makes a line
#define LINE           0.15f      // light of lines where depth jumps
#define THIN_LINE      0.45f      // and where faces meet
enum { DIRECTIONS = 16, FEWEST_DIRECTIONS = 4, STEPS = 10 };

struct job {
    const struct effects *effects;
    const struct rays *rays;
    uint32_t which, directions;
    float across[DIRECTIONS], down[DIRECTIONS]; // of the directions over the picture
    float pixel;                                // size in mm at depth 1, or everywhere
    float centre_x, centre_y;                   // of the picture, in pixels
    float reference, radius;                    // depth of the scene's centre; in mm there
};

struct point {
    float x, y, z; // z is the depth
};

static float pixel_size(const struct job *j, float depth)
{
    return j->rays->orthographic ? j->pixel : j->pixel * depth;
}

// Where the surface of a pixel is, from the axis of the view.
static struct point point_at(const struct job *j, int x, int y)
{
    const struct surface_image *s = &j->effects->map.surface;
    float depth = s->depth[(size_t)y * (size_t)s->width + (size_t)x] + j->reference;
    float size = pixel_size(j, depth);
    return (struct point){((float)x - j->centre_x) * size, (j->centre_y - (float)y) * size, depth};
}

static const float *normal_at(const struct job *j, int x, int y)
{
    return j->effects->normals[(size_t)y * (size_t)j->effects->width + (size_t)x];
}

static bool is_inside(const struct job *j, int x, int y)
{
    return x >= 0 && y >= 0 && x < j->effects->width && y < j->effects->height;
}

static bool is_nothing(const struct job *j, int x, int y)
{
    return map_is_empty_at(&j->effects->map, (size_t)y * (size_t)j->effects->width + (size_t)x);
}

// Height of `to` above the plane through `from`. The depth of points runs away from the viewer.
static float height_above(const float normal[3], struct point from, struct point to)
{
    return normal[0] * (to.x - from.x) + normal[1] * (to.y - from.y) - normal[2] * (to.z - from.z);
}

static float square(float v)
{
    return v * v;
}

// The light that a direction over the picture takes away.
static float taken(const struct job *j, int x, int y, struct point here, uint32_t direction,
                   float reach)
{
    const float *normal = normal_at(j, x, y);
    float dx = j->across[direction], dy = j->down[direction], most = 0;
    for (int k = 1; k <= STEPS; k++) {
        float far = reach * square((float)k / STEPS); // closer together where they are near
        int to_x = x + (int)lrintf(dx * far), to_y = y + (int)lrintf(dy * far);
        if (!is_inside(j, to_x, to_y))
            break;
        if ((to_x == x && to_y == y) || is_nothing(j, to_x, to_y))
            continue;
        struct point there = point_at(j, to_x, to_y);
        float height = height_above(normal, here, there);
        float distance =
            square(there.x - here.x) + square(there.y - here.y) + square(there.z - here.z);
        // Of what stands higher only the top is seen; by one radius it may reach down.
        float away = distance - square(height) + square(fmaxf(height - j->radius, 0));
        float near = 1 - away / square(j->radius);
        if (height > 0 && near > 0 && distance > 0)
            most = fmaxf(most, near * square(height) / distance);
    }
    return most;
}

static float occlusion_at(const struct job *j, int x, int y)
{
    const struct effects *e = j->effects;
    struct point here = point_at(j, x, y);
    float shorter = (float)(e->width < e->height ? e->width : e->height);
    float reach = fminf(j->radius / pixel_size(j, here.z), shorter * NEAREST_RADIUS), sum = 0;
    for (uint32_t i = 0; i < j->directions; i++)
        sum += taken(j, x, y, here, i, reach);
    return 1 - DARKEST * sum / (float)j->directions;
}

// Whether (x, y) is in front of its neighbour with a gap between.
static bool stands_out(const struct job *j, int x, int y, int to_x, int to_y)
{
    if (is_nothing(j, to_x, to_y))
        return true;
    struct point here = point_at(j, x, y), there = point_at(j, to_x, to_y);
    if (here.z >= there.z)
        return false;
    float gap = fmaxf(fabsf(height_above(normal_at(j, x, y), here, there)),
                      fabsf(height_above(normal_at(j, to_x, to_y), there, here)));
    return gap > STEP * pixel_size(j, there.z);
}

static bool is_creased(const struct job *j, int x, int y, int to_x, int to_y)
{
    const float *a = normal_at(j, x, y), *b = normal_at(j, to_x, to_y);
    return !is_nothing(j, to_x, to_y) && a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < CREASE;
}

// Lines of two pixels: jumps of depth darken the two in front, creases one on either side.
static float line_at(const struct job *j, int x, int y)
{
    static const int8_t around[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {2, 0},  {-2, 0},
                                       {0, 2}, {0, -2}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    float light = 1;
    for (size_t i = 0; i < array_count(around); i++) {
        int to_x = x + around[i][0], to_y = y + around[i][1];
        if (!is_inside(j, to_x, to_y))
            continue;
        if (stands_out(j, x, y, to_x, to_y))
            return LINE;
        if (i < 4 && is_creased(j, x, y, to_x, to_y))
            light = THIN_LINE;
    }
    return light;
}

static void light_row(void *context, uint32_t item, uint32_t worker)
{
    (void)worker;
    const struct job *j = context;
    int y = (int)item;
    for (int x = 0; x < j->effects->width; x++) {
        float light = 1;
        if (!is_nothing(j, x, y)) {
            if (j->which & EFFECT_OCCLUSION)
                light = occlusion_at(j, x, y);
            if (j->which & EFFECT_OUTLINE)
                light = fminf(light, line_at(j, x, y));
        }
        j->effects->light[item * (size_t)j->effects->width + (size_t)x] = light;
    }
}

static void reserve(struct effects *e, int width, int height)
{
    if (e->light && e->width == width && e->height == height)
        return;
    size_t n = (size_t)width * (size_t)height;
    e->normals = mem_realloc(e->normals, n * sizeof *e->normals);
    e->light = mem_realloc(e->light, n * sizeof *e->light);
    e->width = width;
    e->height = height;
}

void effects_draw(struct effects *e, struct device *device, const struct shader *shader,
                  const struct rays *rays, const struct render_settings *settings, uint32_t which,
                  uint32_t sample, uint32_t samples)
{
    struct render_stats stats;
    reserve(e, rays->width, rays->height);
    map_draw(&e->map, device, shader->model, rays, settings, &stats);
    map_normals(&e->map, shader, rays, settings->threads, e->normals);
    int shorter = e->width < e->height ? e->width : e->height;
    double pixel = vec3_length(rays->step_x);
    double at_reference = pixel * (rays->orthographic ? 1 : fabs(rays->reference));
    struct job j = {
        .effects = e,
        .rays = rays,
        .which = which,
        .directions =
            DIRECTIONS / samples > FEWEST_DIRECTIONS ? DIRECTIONS / samples : FEWEST_DIRECTIONS,
        .pixel = (float)pixel,
        .centre_x = (float)(e->width - 1) / 2,
        .centre_y = (float)(e->height - 1) / 2,
        .reference = (float)rays->reference,
        .radius = RADIUS * (float)(shorter * at_reference),
    };
    for (uint32_t i = 0; i < j.directions; i++) {
        double turn = 360 * (i + (sample + 0.5) / samples) / j.directions;
        j.across[i] = (float)cos_degrees(turn);
        j.down[i] = (float)sin_degrees(turn);
    }
    parallel_for((uint32_t)e->height, settings->threads, light_row, &j);
}

void effects_free(struct effects *e)
{
    map_free(&e->map);
    free(e->normals);
    free(e->light);
    *e = (struct effects){0};
}
