// extrude_slices.c - how many slices a linear extrusion has when the file does not say it.
#include "geom/extrude_parts.h"

#define SMALLEST_RADIUS 0x1p-20 // OpenSCAD's fine grid

static double radians(double degrees)
{
    return degrees * M_PI / 180;
}

// The number of slices that `fragments` per turn and a curve of this length ask for.
static double twisted(double twist, double radius, double length, struct detail d)
{
    double least = fmax(ceil(twist / 120), 1);
    if (radius < SMALLEST_RADIUS || !isfinite(d.fn))
        return least;
    if (d.fn > 0)
        return fmax(ceil(twist / 360 * d.fn), least);
    return fmax(fmin(ceil(twist / d.fa), ceil(length / d.fs)), least);
}

static double helix(double twist, double radius, double height, struct detail d)
{
    double turn = radians(twist);
    return twisted(twist, radius, turn * sqrt(radius * radius + height / turn * (height / turn)),
                   d);
}

// Along the spiral of Archimedes r = a x the length grows as this.
static double spiral(double a, double x)
{
    return a / 2 * (x * sqrt(1 + x * x) + asinh(x));
}

static double conical_helix(double twist, double radius, double height, double scale,
                            struct detail d)
{
    double turn = radians(twist);
    double end = scale > 1 ? turn * scale / (scale - 1) : turn / (1 - scale);
    double a = radius / end;
    return twisted(twist, radius, hypot(spiral(a, end) - spiral(a, end - turn), height), d);
}

static double diagonal(double way, double height, struct detail d)
{
    if (way < SMALLEST_RADIUS || !isfinite(d.fn))
        return 1;
    if (d.fn > 0)
        return fmax(trunc(d.fn), 1);
    return fmax(ceil(hypot(way, height) / d.fs), 1);
}

double linear_slices(const struct outline *o, const struct linear_extrusion *how)
{
    double x = how->scale_x, y = how->scale_y, twist = fabs(how->twist);
    double height = how->has_direction ? how->direction.z : how->height;
    double radius = 0, way = 0; // from the axis, and by the scaling
    for (uint32_t i = 0; i < o->point_count; i++) {
        struct vec2 p = o->points[i];
        radius = fmax(radius, p.x * p.x + p.y * p.y);
        double dx = p.x - x * p.x, dy = p.y - y * p.y;
        way = fmax(way, dx * dx + dy * dy);
    }
    radius = sqrt(radius);
    way = sqrt(way);
    if (twist == 0)
        return x == y ? 1 : diagonal(way, height, how->detail);
    if (x == y && x != 1)
        return conical_helix(twist, radius, height, x, how->detail);
    double slices = helix(twist, radius, height, how->detail);
    return how->newer && x != y ? fmax(slices, diagonal(way, height, how->detail)) : slices;
}
