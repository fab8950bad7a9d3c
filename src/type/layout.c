// layout.c - where a row of glyphs begins.
//
// OpenSCAD 2021.01 scales advances and heights by 1000/1024 of the outlines, so that letters stand
// closer than the font says and "top" leaves a piece of them above 0. Later versions do not. What
// they export says `halign = "default"` or `valign = "default"` where nothing was given.
#include "type/layout.h"

#include <string.h>

// Multiplied with, not divided by: OpenSCAD's grid shows the difference.
#define UNIT_2021  (0.01 / 1024)
#define UNIT_NEWER (1.0 / FONT_UNITS)

// What is added to the coordinates of an aligned row.
struct anchors {
    double left, centre, right;
    double top, middle, bottom;
};

static bool is_newer(const struct text_line *line)
{
    return (line->halign && strcmp(line->halign, "default") == 0) ||
           (line->valign && strcmp(line->valign, "default") == 0);
}

static struct anchors anchors_2021(const struct letters *row, double spacing)
{
    double width = 0, up = 0, down = 0;

    for (uint32_t i = 0; i < row->count; i++) {
        const struct letter *l = &row->items[i];
        if (row->vertical) {
            width = fmax(width, (l->high.x - l->low.x) * UNIT_2021);
            up += l->advance.y * UNIT_2021 * spacing;
        } else {
            width += l->advance.x * UNIT_2021 * spacing;
            up = fmax(up, l->high.y * UNIT_2021);
            down = fmax(down, -l->low.y * UNIT_2021);
        }
    }
    return (struct anchors){0, -width / 2, -width, -up, (down - up) / 2, down};
}

static struct anchors anchors_newer(const struct letters *row, double spacing)
{
    struct box ink = BOX_EMPTY; // x from the start of the row, y from the glyph's own origin
    struct vec2 at = {0};

    for (uint32_t i = 0; i < row->count; i++) {
        const struct letter *l = &row->items[i];
        if (l->high.x > l->low.x && l->high.y > l->low.y) {
            double x = at.x + l->offset.x * UNIT_NEWER;
            struct vec3 low = {x + l->low.x * UNIT_NEWER, l->low.y * UNIT_NEWER, 0};
            struct vec3 high = {x + l->high.x * UNIT_NEWER, l->high.y * UNIT_NEWER, 0};
            ink = box_of_point(box_of_point(ink, low), high);
        }
        at.x += l->advance.x * UNIT_NEWER * spacing;
        at.y += l->advance.y * UNIT_NEWER * spacing;
    }
    if (box_is_empty(ink))
        return (struct anchors){0};
    if (row->vertical)
        return (struct anchors){-ink.min.x, 0, -ink.max.x, 0, -at.y / 2, -at.y};
    return (struct anchors){0,         -at.x / 2, -at.x, -ink.max.y, -(ink.max.y + ink.min.y) / 2,
                            -ink.min.y};
}

// Which of the three words it is; -1 for `none` and for what is unknown.
static int find_word(const char *word, const char *what, const char *const words[3],
                     const char *none, struct place place, struct messages *messages)
{
    if (!word || !*word || strcmp(word, none) == 0 || strcmp(word, "default") == 0)
        return -1;
    for (int i = 0; i < 3; i++)
        if (strcmp(word, words[i]) == 0)
            return i;
    messages_add(messages, MESSAGE_WARNING, place,
                 "text: %s = \"%.40s\" is unknown: it may be \"%s\", \"%s\", \"%s\"%s", what, word,
                 words[0], words[1], words[2], *none ? " or \"baseline\"" : "");
    return -1;
}

struct layout layout_make(const struct letters *row, const struct text_line *line,
                          struct place place, struct messages *messages)
{
    static const char *const across[] = {"left", "center", "right"};
    static const char *const upward[] = {"top", "center", "bottom"};
    bool newer = is_newer(line);
    struct anchors a = newer ? anchors_newer(row, line->spacing) : anchors_2021(row, line->spacing);
    const double x[] = {a.left, a.centre, a.right}, y[] = {a.top, a.middle, a.bottom};
    int column = find_word(line->halign, "halign", across, "", place, messages);
    int level = find_word(line->valign, "valign", upward, "baseline", place, messages);

    return (struct layout){.unit = newer ? UNIT_NEWER : UNIT_2021,
                           .start = {column < 0 ? 0 : x[column], level < 0 ? 0 : y[level]}};
}
