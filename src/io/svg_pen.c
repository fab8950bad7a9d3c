// svg_pen.c - curves of SVG paths cut into lines, and lines with a width.
#include "io/svg.h"

enum { BEZIER_STEPS = 20 };

void svg_pen_free(struct svg_pen *p)
{
    outline_free(&p->line);
}

// How many steps a whole turn has by the rules of newer versions.
static double turn_steps(const struct svg_pen *p, double radius)
{
    return fmin(circle_fragments(radius, p->options->detail), CIRCLE_FRAGMENTS_MAX);
}

void svg_pen_point(struct svg_pen *p, struct vec2 to)
{
    if (!isfinite(to.x) || !isfinite(to.y) ||
        p->out->point_count + p->line.point_count >= SVG_POINTS_MAX)
        p->failed = true;
    p->at = to;
    if (!p->failed)
        outline_add(&p->line, to);
}

static uint32_t bezier_steps(const struct svg_pen *p)
{
    double fn = p->options->newer ? p->options->detail.fn : 0;
    return fn >= 1 ? (uint32_t)fmin(fn, CIRCLE_FRAGMENTS_MAX) : BEZIER_STEPS;
}

void svg_pen_quadratic(struct svg_pen *p, struct vec2 control, struct vec2 to)
{
    struct vec2 from = p->at;
    uint32_t steps = bezier_steps(p);
    for (uint32_t i = 1; i <= steps && !p->failed; i++) {
        double t = (double)i / steps, s = 1 - t;
        double a = s * s, b = 2 * s * t, c = t * t;
        svg_pen_point(p, (struct vec2){a * from.x + b * control.x + c * to.x,
                                       a * from.y + b * control.y + c * to.y});
    }
    p->at = to;
}

void svg_pen_cubic(struct svg_pen *p, struct vec2 c1, struct vec2 c2, struct vec2 to)
{
    struct vec2 from = p->at;
    uint32_t steps = bezier_steps(p);
    for (uint32_t i = 1; i <= steps && !p->failed; i++) {
        double t = (double)i / steps, s = 1 - t;
        double a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
        svg_pen_point(p, (struct vec2){a * from.x + b * c1.x + c * c2.x + d * to.x,
                                       a * from.y + b * c1.y + c * c2.y + d * to.y});
    }
    p->at = to;
}

static double angle(struct vec2 a, struct vec2 b)
{
    double size = sqrt(a.x * a.x + a.y * a.y) * sqrt(b.x * b.x + b.y * b.y);
    double turn = acos(fmax(-1, fmin(1, (a.x * b.x + a.y * b.y) / size)));
    return a.x * b.y - a.y * b.x < 0 ? -turn : turn;
}

// From end points to centre and angles as in the appendix of the SVG specification.
void svg_pen_arc(struct svg_pen *p, struct svg_arc arc, struct vec2 to)
{
    double rx = fabs(arc.rx), ry = fabs(arc.ry);
    struct vec2 from = p->at;
    if (from.x == to.x && from.y == to.y)
        return;
    if (rx == 0 || ry == 0) {
        svg_pen_point(p, to);
        return;
    }
    double turn = fmod(arc.rotation, 360) * (M_PI / 180), c = cos(turn), s = sin(turn);
    double dx = (from.x - to.x) / 2, dy = (from.y - to.y) / 2;
    double x = c * dx + s * dy, y = c * dy - s * dx;
    double d = x * x / (rx * rx) + y * y / (ry * ry);
    if (d > 1) { // too small to reach: grows until it does
        rx *= sqrt(d);
        ry *= sqrt(d);
    }
    double across = rx * rx * y * y + ry * ry * x * x;
    double q = sqrt(fmax(0, (rx * rx * ry * ry - across) / across));
    q = arc.large == arc.sweep ? -q : q;
    double ux = q * rx * y / ry, uy = -q * ry * x / rx; // the centre, from the middle of the chord
    double cx = c * ux - s * uy + (from.x + to.x) / 2, cy = s * ux + c * uy + (from.y + to.y) / 2;
    struct vec2 a = {(x - ux) / rx, (y - uy) / ry}, b = {(-x - ux) / rx, (-y - uy) / ry};
    double start = angle((struct vec2){1, 0}, a), sweep = angle(a, b);
    if (arc.sweep && sweep < 0)
        sweep += 2 * M_PI;
    if (!arc.sweep && sweep > 0)
        sweep -= 2 * M_PI;
    double share = fabs(sweep) / (2 * M_PI);
    double steps = p->options->newer ? ceil(turn_steps(p, fmax(rx, ry)) * share)
                                     : trunc(fabs(sweep) * (180 / M_PI) * 10 / 180) + 4;
    if (!(steps >= 1))
        steps = 1; // also when a number overflows
    for (double i = 1; i <= steps && !p->failed; i++) {
        double turned = start + sweep * i / steps;
        double ex = rx * cos(turned), ey = ry * sin(turned);
        svg_pen_point(p, (struct vec2){cx + c * ex - s * ey, cy + s * ex + c * ey});
    }
    p->at = to;
}

void svg_pen_fill(struct svg_pen *p)
{
    for (uint32_t i = 0; i < p->line.point_count; i++)
        outline_add(p->out, p->line.points[i]);
    outline_close(p->out);
    p->line.point_count = 0;
}

// How many points Clipper may make of each one of a line. It cuts round corners to a quarter of its
// unit, 1/10000, however wide the line is.
static double stroke_points(const struct svg_pen *p)
{
    double steps = 4;
    if (p->stroke.join == CLIP_ROUND || p->stroke.cap == CLIP_CAP_ROUND)
        steps += M_PI / acos(1 - 0.25 / fmax(p->stroke.width * 5000, 1));
    return steps;
}

void svg_pen_line(struct svg_pen *p)
{
    struct outline area = {0};
    uint32_t count = p->line.point_count;
    p->line.point_count = 0;
    if (p->failed || count == 0)
        return;
    if (p->out->point_count + count * stroke_points(p) > SVG_POINTS_MAX ||
        !clip_stroke(&area, p->line.points, count, p->stroke.width, p->stroke.cap, p->stroke.join))
        p->failed = true;
    else
        outline_append(p->out, &area);
    outline_free(&area);
}
