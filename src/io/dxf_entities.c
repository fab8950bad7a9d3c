// dxf_entities.c - what the entities of a DXF drawing draw.
#include "io/dxf_drawing.h"

#include "base/angle.h"

#include <string.h>

static bool within_reach(struct vec2 p) // false for NaN, too
{
    return fabs(p.x) < DXF_REACH && fabs(p.y) < DXF_REACH;
}

static void add_line(struct drawing *d, struct vec2 a, struct vec2 b)
{
    if (d->lines.line_count + d->block_line_count >= DXF_LINES_MAX) {
        d->full = true;
        return;
    }
    if (!within_reach(a) || !within_reach(b)) {
        d->too_far = true;
        return;
    }
    uint32_t from = dxf_lines_point(&d->lines, a), to = dxf_lines_point(&d->lines, b);
    if (d->section == SECTION_ENTITIES) {
        dxf_lines_add(&d->lines, from, to);
        return;
    }
    if (d->block == UINT32_MAX)
        return;
    uint32_t number = d->block_line_count++;
    array_reserve(&d->block_lines, &d->block_line_room, (size_t)number + 1);
    d->block_lines[number] = (struct block_line){{{from, to}}, 0};
    struct block *b2 = &d->blocks[d->block];
    if (b2->count++)
        d->block_lines[b2->last].next = number;
    else
        b2->first = number;
    b2->last = number;
}

static struct vec2 point(const struct entity *e, uint32_t i)
{
    return (struct vec2){e->x[i], e->y[i]};
}

static void draw_line(struct drawing *d)
{
    add_line(d, point(&d->entity, 0), point(&d->entity, 1));
}

static void draw_polyline(struct drawing *d)
{
    const struct entity *e = &d->entity;
    uint32_t count = e->x_count < e->y_count ? e->x_count : e->y_count;
    for (uint32_t i = 1; i < count; i++)
        add_line(d, point(e, i - 1), point(e, i));
    if (count > 1 && (e->flags & 1))
        add_line(d, point(e, count - 1), point(e, 0));
}

// Corners of a part of a full turn.
static uint32_t steps(const struct drawing *d, double radius, double turn)
{
    double n = fmin(circle_fragments(radius, d->options->detail), CIRCLE_FRAGMENTS_MAX);
    return (uint32_t)fmin(ceil(n * turn), CIRCLE_FRAGMENTS_MAX);
}

static void draw_turn(struct drawing *d, double start, double sweep, uint32_t n)
{
    const struct entity *e = &d->entity;
    struct vec2 from = {0}, centre = point(e, 0);
    for (uint32_t i = 0; i <= n && !d->full; i++) {
        double a = start + sweep * i / n;
        struct vec2 to = {centre.x + e->c40 * cos_degrees(a), centre.y + e->c40 * sin_degrees(a)};
        if (i)
            add_line(d, from, to);
        from = to;
    }
}

static void draw_circle(struct drawing *d)
{
    draw_turn(d, 0, 360, steps(d, d->entity.c40, 1));
}

static void draw_arc(struct drawing *d)
{
    const struct entity *e = &d->entity;
    double sweep = e->c51 - e->c50;
    if (sweep < 0)
        sweep += 360 * ceil(-sweep / 360);
    draw_turn(d, e->c50, sweep, steps(d, e->c40, sweep / 360));
}

// The second point is the end of the long axis, seen from the centre; code 40 is the ratio of the
// axes. OpenSCAD moves and scales them as if they were a place and a length: so do we.
static void draw_ellipse(struct drawing *d)
{
    const struct entity *e = &d->entity;
    struct vec2 centre = point(e, 0), axis = point(e, 1), from = {0};
    double sweep = e->c42 - e->c41;
    if (sweep < 0)
        sweep += 2 * M_PI * ceil(-sweep / (2 * M_PI));
    uint32_t n = steps(d, hypot(axis.x, axis.y), sweep / (2 * M_PI));
    for (uint32_t i = 0; i <= n && !d->full; i++) {
        double a = e->c41 + sweep * i / n, along = cos(a), across = sin(a) * e->c40;
        struct vec2 to = {centre.x + along * axis.x - across * axis.y,
                          centre.y + along * axis.y + across * axis.x};
        if (i)
            add_line(d, from, to);
        from = to;
    }
}

// A block inserted into itself gives what it had before.
static void draw_insert(struct drawing *d)
{
    const struct entity *e = &d->entity;
    uint32_t number = drawing_block(d, e->name);
    const struct block b = d->blocks[number];
    double scale = d->options->scale; // within a block too, as OpenSCAD does it
    double c = cos_degrees(e->c50), s = sin_degrees(e->c50);
    uint32_t at = b.first;
    for (uint32_t i = 0; i < b.count && !d->full; i++) {
        struct vec2 to[2];
        for (int k = 0; k < 2; k++) {
            struct vec2 p = d->lines.points[d->block_lines[at].line.end[k]];
            double x = p.x * e->c41 * scale, y = p.y * e->c42 * scale;
            to[k] = (struct vec2){c * x - s * y + e->x[0], s * x + c * y + e->y[0]};
        }
        at = d->block_lines[at].next;
        add_line(d, to[0], to[1]);
    }
}

static const struct kind {
    const char *name;
    uint32_t points; // needed
    void (*draw)(struct drawing *d);
} kinds[] = {
    {"LINE", 2, draw_line}, {"LWPOLYLINE", 0, draw_polyline}, {"CIRCLE", 1, draw_circle},
    {"ARC", 1, draw_arc},   {"ELLIPSE", 2, draw_ellipse},     {"INSERT", 1, draw_insert},
    {"DIMENSION", 0, NULL}, // for measuring only
};

bool entity_draw(struct drawing *d)
{
    const struct entity *e = &d->entity;
    for (size_t i = 0; i < array_count(kinds); i++) {
        if (!span_is(e->kind, kinds[i].name))
            continue;
        if (e->x_count < kinds[i].points || e->y_count < kinds[i].points)
            messages_add(d->messages, MESSAGE_WARNING, (struct place){d->place.file, e->line, 0},
                         "%s with too few coordinates: left out", kinds[i].name);
        else if (kinds[i].draw)
            kinds[i].draw(d);
        return true;
    }
    return false;
}
