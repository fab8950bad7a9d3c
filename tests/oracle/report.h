// report.h - what a person needs to find a bug: both answers at a pixel, and the fewest leaves that
// show it.
#pragma once
#include "compare.h"

#include <stdio.h>

// What a device says of a pixel.
void report_device(FILE *out, const struct rays *rays, const struct picture *p, int x, int y);

// What the ray of a pixel meets.
void report_crossings(FILE *out, const struct body *body, const struct rays *rays, int x, int y);

// Both answers at a pixel that was just compared, and the crossings of the ray.
void report_pixel(FILE *out, const struct comparison *c, const struct picture *p, int x, int y);

// Drops leaves while the pixel stays wrong, then prints leaves, expression and answers.
void report_smallest(FILE *out, struct device *device, struct random_scene *scene,
                     const struct render_settings *settings, int x, int y);
