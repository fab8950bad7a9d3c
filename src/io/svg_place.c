// svg_place.c - where SVG elements stand: transforms, and the page.
#include "base/angle.h"
#include "base/mem.h"
#include "io/number.h"
#include "io/svg.h"

#include <string.h>

struct svg_map svg_map_mul(struct svg_map m, struct svg_map n)
{
    return (struct svg_map){m.a * n.a + m.c * n.b,       m.b * n.a + m.d * n.b,
                            m.a * n.c + m.c * n.d,       m.b * n.c + m.d * n.d,
                            m.a * n.e + m.c * n.f + m.e, m.b * n.e + m.d * n.f + m.f};
}

static double tangent(double degrees)
{
    return sin_degrees(degrees) / cos_degrees(degrees);
}

// One function of a transform with `n` numbers; false when there are too many or too few.
static bool function_map(const char *name, size_t length, const double *v, int n,
                         struct svg_map *out)
{
    static const struct {
        const char *name;
        int least, most, bad;
    } functions[] = {
        {"matrix", 6, 6, 0}, {"translate", 1, 2, 0}, {"scale", 1, 2, 0},
        {"rotate", 1, 3, 2}, {"skewX", 1, 1, 0},     {"skewY", 1, 1, 0},
    };
    size_t i = 0;
    while (i < array_count(functions) &&
           (strlen(functions[i].name) != length || memcmp(functions[i].name, name, length) != 0))
        i++;
    if (i == array_count(functions) || n < functions[i].least || n > functions[i].most ||
        n == functions[i].bad)
        return false;
    struct svg_map m = SVG_MAP_IDENTITY;
    switch (i) {
    case 0:
        m = (struct svg_map){v[0], v[1], v[2], v[3], v[4], v[5]};
        break;
    case 1:
        m.e = v[0];
        m.f = n == 2 ? v[1] : 0;
        break;
    case 2:
        m.a = v[0];
        m.d = n == 2 ? v[1] : v[0];
        break;
    case 3:
        m.a = m.d = cos_degrees(v[0]);
        m.b = sin_degrees(v[0]);
        m.c = -m.b;
        if (n == 3) {
            m.e = v[1] - m.a * v[1] - m.c * v[2];
            m.f = v[2] - m.b * v[1] - m.d * v[2];
        }
        break;
    case 4:
        m.c = tangent(v[0]);
        break;
    default:
        m.b = tangent(v[0]);
        break;
    }
    *out = m;
    return true;
}

// As OpenSCAD does it, a function that makes no sense is passed over; a text that is not a list of
// functions is no transform at all.
struct svg_map svg_map_read(const char *transform, locale_t numbers)
{
    struct svg_map all = SVG_MAP_IDENTITY, one;
    const char *p = transform ? transform : "";
    for (p += strspn(p, " \t\r\n\f,"); *p; p += strspn(p, " \t\r\n\f,")) {
        const char *name = p;
        size_t length = strcspn(p, " \t\r\n\f(");
        p += length;
        p += strspn(p, " \t\r\n\f");
        if (*p != '(')
            return SVG_MAP_IDENTITY;
        struct svg_text t = {p + 1, numbers};
        double v[7]; // one more than any function takes
        int n = 0;
        while (n < 7 && svg_next_number(&t, &v[n]))
            n++;
        t.at += strspn(t.at, " \t\r\n\f");
        bool whole = *t.at == ')';
        p = strchr(t.at, ')');
        if (!p)
            return SVG_MAP_IDENTITY;
        p++;
        if (whole && function_map(name, length, v, n, &one))
            all = svg_map_mul(all, one);
    }
    return all;
}

// A width or height of the page. `box` is that of the view box, 0 without one.
static double page_size(const char *text, double box, double dpi, locale_t numbers)
{
    static const struct {
        const char *unit;
        double size;
    } units[] = {{"px", 25.4 / 96}, {"pt", 25.4 / 72}, {"pc", 25.4 / 6},
                 {"in", 25.4},      {"cm", 10},        {"mm", 1}};
    double value;
    const char *unit;
    if (text && number_read(text, numbers, &value, &unit)) {
        unit += strspn(unit, " ");
        if (*unit == 0)
            return value * 25.4 / dpi;
        for (size_t i = 0; i < array_count(units); i++)
            if (strcmp(unit, units[i].unit) == 0)
                return value * units[i].size;
        if (strcmp(unit, "%") == 0 || strcmp(unit, "em") == 0 || strcmp(unit, "ex") == 0)
            return box; // of nothing that is known: user units are millimetres
    }
    return box * 25.4 / dpi;
}

// How the view box lies in the page: share of the room left over in x and y, and which of the two
// factors counts.
struct aspect {
    double x, y;
    enum { ASPECT_MEET, ASPECT_SLICE, ASPECT_NONE } rule;
};

static struct aspect read_aspect(const char *text)
{
    static const char *const names[3] = {"Min", "Mid", "Max"};
    struct aspect a = {0.5, 0.5, ASPECT_MEET};
    while (text && *text) {
        text += strspn(text, " \t\r\n");
        size_t length = strcspn(text, " \t\r\n");
        if (length == 4 && memcmp(text, "none", 4) == 0)
            return (struct aspect){0, 0, ASPECT_NONE};
        if (length == 5 && memcmp(text, "slice", 5) == 0)
            a.rule = ASPECT_SLICE;
        for (int x = 0; x < 3 && length == 8; x++)
            for (int y = 0; y < 3; y++)
                if (text[0] == 'x' && memcmp(text + 1, names[x], 3) == 0 && text[4] == 'Y' &&
                    memcmp(text + 5, names[y], 3) == 0) {
                    a.x = x / 2.0;
                    a.y = y / 2.0;
                }
        text += length;
    }
    return a;
}

struct svg_map svg_page(const char *const *attributes, double dpi, locale_t numbers)
{
    const char *view = svg_attribute(attributes, "viewBox");
    struct svg_text t = {view ? view : "", numbers};
    double box[4] = {0};
    int n = 0;
    while (n < 4 && svg_next_number(&t, &box[n]))
        n++;
    bool boxed = n == 4 && box[2] >= 0 && box[3] >= 0;
    double width = page_size(svg_attribute(attributes, "width"), boxed ? box[2] : 0, dpi, numbers);
    double height =
        page_size(svg_attribute(attributes, "height"), boxed ? box[3] : 0, dpi, numbers);
    if (!boxed)
        return (struct svg_map){1, 0, 0, -1, 0, height};

    double sx = width / box[2], sy = height / box[3];
    struct aspect a = read_aspect(svg_attribute(attributes, "preserveAspectRatio"));
    if (a.rule != ASPECT_NONE)
        sx = sy = a.rule == ASPECT_MEET ? fmin(sx, sy) : fmax(sx, sy);
    if (!isfinite(sx) || !isfinite(sy))
        return (struct svg_map){0}; // nothing is seen through a view box without a size
    double x = (width - sx * box[2]) * a.x, y = (height - sy * box[3]) * a.y;
    // The sign of box[1] is OpenSCAD's.
    return (struct svg_map){sx, 0, 0, -sy, x - sx * box[0], height - y - sy * box[1]};
}
