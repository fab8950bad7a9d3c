// camera.c - OpenSCAD's camera: its numbers, its mouse, and the rays of a picture.
#include "render/camera.h"

#include "base/angle.h"
#include "base/mem.h"
#include "base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define RADIANS           (M_PI / 180)
#define DEGREES_PER_PIXEL 0.7
#define ZOOM_STEP         0.9

// Unit vectors of the view in the world: to the right, upwards, and away from the viewer.
struct view_axes {
    struct vec3 right, up, ahead;
};

// OpenSCAD turns the model by z, then y, then x and looks along +y with z up; the axes are that
// view's turned back into the model.
static struct vec3 into_world(const struct camera *c, struct vec3 v)
{
    double ax = fmod(c->rotation.x, 360) - 90, ay = fmod(c->rotation.y, 360);
    double az = fmod(c->rotation.z, 360);
    double s = sin_degrees(ax), k = cos_degrees(ax);
    v = (struct vec3){v.x, k * v.y - s * v.z, s * v.y + k * v.z};
    s = sin_degrees(ay);
    k = cos_degrees(ay);
    v = (struct vec3){k * v.x + s * v.z, v.y, k * v.z - s * v.x};
    s = sin_degrees(az);
    k = cos_degrees(az);
    return (struct vec3){k * v.x - s * v.y, s * v.x + k * v.y, v.z};
}

static struct view_axes axes_of(const struct camera *c)
{
    return (struct view_axes){into_world(c, (struct vec3){1, 0, 0}),
                              into_world(c, (struct vec3){0, 0, 1}),
                              into_world(c, (struct vec3){0, 1, 0})};
}

// Half the height of what shows at the centre's depth.
static double half_height(const struct camera *c)
{
    return c->distance * tan(c->fov / 2 * RADIANS);
}

static double turn_normalized(double degrees)
{
    double turn = fmod(degrees, 360);
    return turn < 0 ? turn + 360 : turn;
}

// Reads numbers between commas into n[0 .. most]; -1 when the text is anything else.
static int read_numbers(const char *text, double *n, int most)
{
    for (int count = 0; count < most;) {
        char *end;
        n[count] = strtod(text, &end);
        if (end == text || !isfinite(n[count]))
            return -1;
        count++;
        end += strspn(end, " ");
        if (!*end)
            return count;
        if (*end != ',')
            return -1;
        text = end + 1;
    }
    return -1;
}

bool camera_parse(struct camera *out, const char *text, struct error *err)
{
    double n[7];
    int count = read_numbers(text, n, 7);
    if (count != 6 && count != 7) {
        error_set(err, "--camera: expected 6 or 7 numbers between commas, got '%s'", text);
        return false;
    }
    struct vec3 first = {n[0], n[1], n[2]}, second = {n[3], n[4], n[5]};
    if (count == 7) {
        if (n[6] < 0) {
            error_set(err, "--camera: the distance must not be negative, got '%s'", text);
            return false;
        }
        out->centre = first;
        out->rotation = second;
        out->distance = n[6];
        return true;
    }
    struct vec3 d = vec3_sub(second, first);
    out->centre = second;
    out->distance = vec3_length(d);
    out->rotation.x = 90 + atan2(d.z, hypot(d.x, d.y)) / RADIANS;
    out->rotation.y = 0;
    if (d.x == 0 && d.y == 0)
        out->rotation.z = d.z < 0 ? 0 : 180;
    else
        out->rotation.z = turn_normalized(atan2(d.y, d.x) / RADIANS - 90);
    return true;
}

bool camera_parse_projection(struct camera *out, const char *text, struct error *err)
{
    static const char *const names[] = {"p", "perspective", "o", "ortho", "orthogonal"};
    for (size_t i = 0; i < array_count(names); i++)
        if (strcasecmp(text, names[i]) == 0) {
            out->orthographic = i >= 2;
            return true;
        }
    error_set(err, "--projection: expected o, ortho, p or perspective, got '%s'", text);
    return false;
}

void camera_print(const struct camera *c, char text[CAMERA_TEXT])
{
    double n[7] = {c->centre.x,   c->centre.y,   c->centre.z, c->rotation.x,
                   c->rotation.y, c->rotation.z, c->distance};
    char *out = text;
    for (int i = 0; i < 7; i++) {
        char one[NUMBER_TEXT];
        number_shortest(one, n[i] + 0.0, 6, 17);
        out += snprintf(out, (size_t)(text + CAMERA_TEXT - out), "%s%s", i ? "," : "", one);
    }
}

void camera_print_options(const struct camera *c, char *text, size_t size)
{
    char numbers[CAMERA_TEXT];
    camera_print(c, numbers);
    snprintf(text, size, "--camera=%s%s", numbers, c->orthographic ? " --projection=o" : "");
}

// The word behind `option`, or nothing.
static bool find_value(const char *text, const char *option, char *out, size_t size)
{
    const char *found = strstr(text, option);
    if (!found)
        return false;
    found += strlen(option);
    found += strspn(found, "= \t\"'");
    snprintf(out, size, "%.*s", (int)strcspn(found, " \t\r\n\"'"), found);
    return true;
}

bool camera_parse_options(struct camera *out, const char *text, struct error *err)
{
    char numbers[300], projection[20];
    struct camera c = *out;
    if (!find_value(text, "--camera", numbers, sizeof numbers))
        find_value(text, "", numbers, sizeof numbers);
    if (!camera_parse(&c, numbers, err))
        return false;
    c.orthographic = false;
    if (find_value(text, "--projection", projection, sizeof projection) &&
        !camera_parse_projection(&c, projection, err))
        return false;
    *out = c;
    return true;
}

static bool box_is_usable(struct box b)
{
    return !box_is_empty(b) && isfinite(vec3_length(vec3_sub(b.max, b.min))) &&
           isfinite(vec3_length(vec3_add(b.max, b.min)));
}

static struct vec3 box_centre(struct box b)
{
    return vec3_scale(vec3_add(b.min, b.max), 0.5);
}

void camera_autocenter(struct camera *c, struct box scene)
{
    c->centre = box_is_usable(scene) ? box_centre(scene) : (struct vec3){0, 0, 0};
}

void camera_viewall(struct camera *c, struct box scene)
{
    if (!box_is_usable(scene)) {
        c->centre = (struct vec3){0, 0, 0};
        c->distance = CAMERA_DEFAULTS.distance;
        return;
    }
    double radius = vec3_length(vec3_sub(box_centre(scene), c->centre)) +
                    vec3_length(vec3_sub(scene.max, scene.min)) / 2;
    // A single point has no extent to show; any distance does.
    c->distance = radius > 0 ? radius / sin(c->fov / 2 * RADIANS) : CAMERA_DEFAULTS.distance;
}

void camera_orbit(struct camera *c, double dx, double dy)
{
    c->rotation.x = turn_normalized(c->rotation.x - DEGREES_PER_PIXEL * dy);
    c->rotation.z = turn_normalized(c->rotation.z - DEGREES_PER_PIXEL * dx);
}

void camera_roll(struct camera *c, double dx, double dy)
{
    c->rotation.x = turn_normalized(c->rotation.x - DEGREES_PER_PIXEL * dy);
    c->rotation.y = turn_normalized(c->rotation.y - DEGREES_PER_PIXEL * dx);
}

void camera_pan(struct camera *c, double dx, double dy, int height)
{
    double pixel = 2 * half_height(c) / height;
    struct view_axes a = axes_of(c);
    c->centre = vec3_sub(c->centre, vec3_scale(a.right, dx * pixel));
    c->centre = vec3_add(c->centre, vec3_scale(a.up, dy * pixel));
}

void camera_dolly(struct camera *c, double dy, int height)
{
    double pixel = 2 * half_height(c) / height;
    c->centre = vec3_add(c->centre, vec3_scale(axes_of(c).ahead, dy * pixel));
}

void camera_zoom_at(struct camera *c, double steps, double x, double y, int width, int height)
{
    double before = half_height(c);
    c->distance *= pow(ZOOM_STEP, steps);
    double moved = 2 * (before - half_height(c)) / height; // per pixel away from the middle
    struct view_axes a = axes_of(c);
    c->centre = vec3_add(c->centre, vec3_scale(a.right, (x + 0.5 - width / 2.0) * moved));
    c->centre = vec3_sub(c->centre, vec3_scale(a.up, (y + 0.5 - height / 2.0) * moved));
}

struct rays camera_rays(const struct camera *c, int width, int height, struct box scene)
{
    struct view_axes a = axes_of(c);
    struct vec3 eye = vec3_sub(c->centre, vec3_scale(a.ahead, c->distance));
    // Of one pixel: in perspective at depth 1, otherwise at every depth.
    double half = c->orthographic ? half_height(c) : tan(c->fov / 2 * RADIANS);
    double pixel = 2 * half / height;
    struct rays r = {.orthographic = c->orthographic, .width = width, .height = height};
    r.step_x = vec3_scale(a.right, pixel);
    r.step_y = vec3_scale(a.up, -pixel);
    struct vec3 corner = vec3_add(vec3_scale(a.right, (0.5 - width / 2.0) * pixel),
                                  vec3_scale(a.up, (height / 2.0 - 0.5) * pixel));
    r.origin = c->orthographic ? vec3_add(eye, corner) : eye;
    r.forward = c->orthographic ? a.ahead : vec3_add(a.ahead, corner);
    r.near = (c->orthographic ? -100 : 0.1) * c->distance;
    r.far = 100 * c->distance;
    r.reference = c->distance;
    if (box_is_usable(scene))
        r.reference += vec3_dot(vec3_sub(box_centre(scene), c->centre), a.ahead);
    return r;
}
