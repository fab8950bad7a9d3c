// svg_text.c - numbers and attributes of SVG elements.
#include "io/number.h"
#include "io/svg.h"

#include <string.h>

static const char *skip_blanks(const char *p)
{
    return p + strspn(p, " \t\r\n\f");
}

static const char *skip_separator(const char *p)
{
    p = skip_blanks(p);
    return *p == ',' ? skip_blanks(p + 1) : p;
}

bool svg_next_number(struct svg_text *t, double *out)
{
    const char *stop;
    if (!number_read(skip_separator(t->at), t->numbers, out, &stop))
        return false;
    t->at = stop;
    return true;
}

bool svg_next_flag(struct svg_text *t, bool *out)
{
    const char *p = skip_separator(t->at);
    if (*p < '0' || *p > '9')
        return false;
    *out = *p != '0';
    t->at = p + 1;
    return true;
}

double svg_whole_number(const char *text, locale_t numbers, double fallback)
{
    double value;
    const char *stop;
    return text && number_read(text, numbers, &value, &stop) && *stop == 0 ? value : fallback;
}

const char *svg_attribute(const char *const *attributes, const char *name)
{
    for (; *attributes; attributes += 2)
        if (strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

// Attribute `name`, else that of the style; at most `room` - 1 bytes of it.
static bool styled(const char *const *attributes, const char *name, char *out, size_t room)
{
    const char *value = svg_attribute(attributes, name);
    size_t length = value ? strlen(value) : 0, name_length = strlen(name);
    const char *p = value ? NULL : svg_attribute(attributes, "style");
    while (p && !value) {
        if (strncmp(p, name, name_length) == 0 && p[name_length] == ':') {
            value = p + name_length + 1;
            length = strcspn(value, ";");
        }
        p = strchr(p, ';');
        p = p ? p + 1 : NULL;
    }
    if (!value || length >= room)
        return false;
    memcpy(out, value, length);
    out[length] = 0;
    return true;
}

struct svg_stroke svg_stroke_of(const char *const *attributes, locale_t numbers)
{
    struct svg_stroke s = {1, CLIP_CAP_SQUARE, CLIP_MITRE};
    char text[64];
    if (styled(attributes, "stroke-width", text, sizeof text))
        s.width = svg_whole_number(text, numbers, 0);
    if (s.width < 0.01)
        s.width = 1;
    if (styled(attributes, "stroke-linecap", text, sizeof text)) {
        if (strcmp(text, "butt") == 0)
            s.cap = CLIP_CAP_BUTT;
        else if (strcmp(text, "round") == 0)
            s.cap = CLIP_CAP_ROUND;
    }
    if (styled(attributes, "stroke-linejoin", text, sizeof text)) {
        if (strcmp(text, "bevel") == 0)
            s.join = CLIP_CHAMFER;
        else if (strcmp(text, "round") == 0)
            s.join = CLIP_ROUND;
    }
    return s;
}
