// camera.h - OpenSCAD's camera: its numbers, its mouse, and the rays of a picture.
#pragma once
#include "base/error.h"
#include "render/rays.h"

#include <stddef.h>

// The terms of --camera and of $vpt, $vpr, $vpd, $vpf. Rotation 0,0,0 looks straight down, x to the
// right; the eye is `distance` away from `centre`.
struct camera {
    struct vec3 centre;
    struct vec3 rotation; // degrees
    double distance;
    double fov; // degrees, vertical
    bool orthographic;
};
#define CAMERA_DEFAULTS ((struct camera){.rotation = {55, 0, 25}, .distance = 140, .fov = 22.5})

// "tx,ty,tz,rx,ry,rz,distance" or "ex,ey,ez,cx,cy,cz" (eye and centre). Keeps fov and projection.
bool camera_parse(struct camera *out, const char *text, struct error *err);
// "o", "ortho", "orthogonal", "p" or "perspective".
bool camera_parse_projection(struct camera *out, const char *text, struct error *err);
// Writes the form of seven numbers, as short as reads back the same, into `text`.
enum { CAMERA_TEXT = 7 * 26 };
void camera_print(const struct camera *c, char text[CAMERA_TEXT]);

// "--camera=... --projection=o", as hcsg-render takes them.
void camera_print_options(const struct camera *c, char *text, size_t size);
// Reads that, or the numbers alone, with anything around it.
bool camera_parse_options(struct camera *out, const char *text, struct error *err);

// Turns the view towards the centre of the box.
void camera_autocenter(struct camera *c, struct box scene);
// Sets the distance from which the whole box shows.
void camera_viewall(struct camera *c, struct box scene);

// Mouse, in pixels: dx to the right, dy down.
void camera_orbit(struct camera *c, double dx, double dy); // left button
void camera_roll(struct camera *c, double dx, double dy);  // left button with shift
// What lies at the centre's depth follows the pointer.
void camera_pan(struct camera *c, double dx, double dy, int height); // right button
void camera_dolly(struct camera *c, double dy, int height); // middle button: along the view axis
// One step is a notch of the wheel, positive towards the model; what lies at the centre's depth
// under pixel (x, y) stays there.
void camera_zoom_at(struct camera *c, double steps, double x, double y, int width, int height);

struct rays camera_rays(const struct camera *c, int width, int height, struct box scene);
