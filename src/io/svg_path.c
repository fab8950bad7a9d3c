// svg_path.c - the d attribute of SVG paths.
#include "io/svg.h"

#include <string.h>

struct path {
    struct svg_pen *pen;
    struct svg_text text;
    char command, last; // last: the command before, which decides on mirrored control points
    struct vec2 control;
    bool closed; // a z came before
};

// Ends the subpath. OpenSCAD fills it when a z came anywhere before, or when its ends meet.
static void finish(struct path *s)
{
    struct svg_pen *p = s->pen;
    if (p->line.point_count == 0)
        return;
    struct vec2 a = p->line.points[0], b = p->line.points[p->line.point_count - 1];
    if (s->closed || hypot(a.x - b.x, a.y - b.y) <= 0.1)
        svg_pen_fill(p);
    else
        svg_pen_line(p);
}

static bool is_relative(char command)
{
    return command >= 'a';
}

// Pairs of coordinates, relative ones to where the pen is.
static bool read_points(struct path *s, struct vec2 *out, int count)
{
    struct vec2 base = is_relative(s->command) ? s->pen->at : (struct vec2){0, 0};
    for (int i = 0; i < count; i++) {
        if (!svg_next_number(&s->text, &out[i].x) || !svg_next_number(&s->text, &out[i].y))
            return false;
        out[i].x += base.x;
        out[i].y += base.y;
    }
    return true;
}

static struct vec2 mirrored(const struct path *s, const char *kinds)
{
    struct vec2 at = s->pen->at;
    if (!s->last || !strchr(kinds, s->last))
        return at;
    return (struct vec2){2 * at.x - s->control.x, 2 * at.y - s->control.y};
}

static bool move(struct path *s)
{
    struct vec2 to;
    if (!read_points(s, &to, 1))
        return false;
    finish(s);
    svg_pen_point(s->pen, to);
    s->pen->start = to;
    return true;
}

static bool straight(struct path *s)
{
    struct vec2 to = s->pen->at;
    bool relative = is_relative(s->command);
    double v;
    switch (s->command | 32) {
    case 'l':
        if (!read_points(s, &to, 1))
            return false;
        break;
    case 'h':
        if (!svg_next_number(&s->text, &v))
            return false;
        to.x = relative ? to.x + v : v;
        break;
    default:
        if (!svg_next_number(&s->text, &v))
            return false;
        to.y = relative ? to.y + v : v;
        break;
    }
    svg_pen_point(s->pen, to);
    return true;
}

static bool cubic(struct path *s)
{
    struct vec2 c[3] = {mirrored(s, "cCsS")};
    bool smooth = (s->command | 32) == 's';
    if (!read_points(s, c + smooth, 3 - smooth))
        return false;
    s->control = c[1];
    svg_pen_cubic(s->pen, c[0], c[1], c[2]);
    return true;
}

static bool quadratic(struct path *s)
{
    struct vec2 c[2] = {mirrored(s, "qQtT")};
    bool smooth = (s->command | 32) == 't';
    if (!read_points(s, c + smooth, 2 - smooth))
        return false;
    s->control = c[0];
    svg_pen_quadratic(s->pen, c[0], c[1]);
    return true;
}

static bool arc(struct path *s)
{
    struct svg_arc a;
    struct vec2 to;
    if (!svg_next_number(&s->text, &a.rx) || !svg_next_number(&s->text, &a.ry) ||
        !svg_next_number(&s->text, &a.rotation) || !svg_next_flag(&s->text, &a.large) ||
        !svg_next_flag(&s->text, &a.sweep) || !read_points(s, &to, 1))
        return false;
    svg_pen_arc(s->pen, a, to);
    return true;
}

static bool draw(struct path *s)
{
    switch (s->command | 32) {
    case 'm':
        return move(s);
    case 'l':
    case 'h':
    case 'v':
        return straight(s);
    case 'c':
    case 's':
        return cubic(s);
    case 'q':
    case 't':
        return quadratic(s);
    case 'a':
        return arc(s);
    default:
        return false; // numbers before any command, or after a z
    }
}

// The next command letter, or the same command once more for further numbers. False at the end and
// where the text makes no sense: what was drawn until then stays.
static bool next_command(struct path *s)
{
    const char *p = s->text.at + strspn(s->text.at, " \t\r\n\f,");
    if (*p == 0)
        return false;
    if (strchr("MmLlHhVvCcSsQqTtAaZz", *p)) {
        s->command = *p;
        s->text.at = p + 1;
    } else if ((s->command | 32) == 'm') {
        s->command = is_relative(s->command) ? 'l' : 'L';
    }
    return true;
}

void svg_draw_path(struct svg_pen *p, struct svg_text d)
{
    struct path s = {.pen = p, .text = d};
    while (!p->failed && next_command(&s)) {
        if ((s.command | 32) == 'z') {
            s.closed = true;
            finish(&s);
            p->at = p->start;
        } else if (!draw(&s)) {
            break;
        }
        s.last = s.command;
        if (s.closed && (s.command | 32) == 'z')
            s.command = ' ';
    }
    finish(&s);
}
