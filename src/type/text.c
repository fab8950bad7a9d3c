// text.c - lines of text as flat shapes: fontconfig chooses, HarfBuzz shapes, FreeType draws.
#include "type/text.h"

#include "base/mem.h"
#include "geom/clip.h"
#include "type/glyph.h"
#include "type/layout.h"
#include "type/utf8.h"

#include <stdlib.h>
#include <string.h>

#define DEFAULT_FONT "Liberation Sans:style=Regular"

// More pieces change a curve by less than the grid of flat shapes, unless the text is metres high.
enum { PIECES_MAX = 1000, TEXT_BYTES_MAX = 1 << 20, TEXT_POINTS_MAX = 1 << 22 };

// OpenSCAD 2021.01: letters are smaller than full circles of the text's size.
static uint32_t pieces_of(const struct text_line *line)
{
    uint32_t pieces = circle_fragments(line->size, line->detail) / 8 + 1;
    return pieces < 2 ? 2 : pieces > PIECES_MAX ? PIECES_MAX : pieces;
}

// The font's name without the blanks around it. The caller frees it.
static char *font_name(const char *name)
{
    static const char blanks[] = " \t\n\v\f\r";

    name = name ? name + strspn(name, blanks) : "";
    if (!*name)
        return mem_strdup(DEFAULT_FONT);
    char *copy = mem_strdup(name), *end = copy + strlen(copy);
    while (strchr(blanks, end[-1]))
        end--;
    *end = 0;
    return copy;
}

static bool shape(struct letters *row, const struct text_line *line, struct place place,
                  struct messages *messages)
{
    char *name = font_name(line->font);

    font_lock();
    struct font *font = font_open(name);
    if (font)
        shape_line(row, font, line);
    font_unlock();
    if (!font)
        messages_add(messages, MESSAGE_WARNING, place, "text: there is no font for '%s'", name);
    else if (row->missing)
        messages_add(messages, MESSAGE_WARNING, place,
                     "text: %u glyphs cannot be drawn with the font '%s'", row->missing, name);
    free(name);
    return font;
}

// One glyph of the row in its place. `from` and `to` are its reach along the line.
struct piece {
    struct outline outline;
    double from, to;
};

static int compare_pieces(const void *a, const void *b)
{
    const struct piece *p = a, *q = b;
    return (p->from > q->from) - (p->from < q->from);
}

static struct piece *make_pieces(const struct letters *row, const struct text_line *line,
                                 const struct layout *layout)
{
    struct piece *pieces = mem_zalloc((row->count + (size_t)1) * sizeof *pieces);
    struct glyph_place place = {.size = line->size, .pieces = pieces_of(line)};

    for (uint32_t i = 0; i < row->count; i++) {
        const struct letter *l = &row->items[i];
        struct piece *piece = &pieces[i];
        place.offset = (struct vec2){layout->start.x + l->offset.x * layout->unit,
                                     layout->start.y + l->offset.y * layout->unit};
        glyph_append(&piece->outline, l->outline, &place);
        struct box box = outline_bounds(&piece->outline);
        piece->from = row->vertical ? box.min.y : box.min.x;
        piece->to = row->vertical ? box.max.y : box.max.x;
        place.advance.x += l->advance.x * layout->unit * line->spacing;
        place.advance.y += l->advance.y * layout->unit * line->spacing;
    }
    return pieces;
}

// The union of all glyphs. Those that do not reach over each other are worked off apart: Clipper's
// time grows with the square of what stands side by side.
static bool unite(struct outline *out, struct piece *pieces, uint32_t count)
{
    const double apart = 1e-3; // much more than the grid of flat shapes
    const struct outline **group = mem_alloc((count + (size_t)1) * sizeof *group);
    bool ok = true;

    *out = (struct outline){.clean = true};
    qsort(pieces, count, sizeof *pieces, compare_pieces);
    for (uint32_t i = 0, next; i < count && ok; i = next) {
        double reach = pieces[i].to;
        for (next = i; next < count && (next == i || !(pieces[next].from > reach + apart));
             next++) {
            group[next - i] = &pieces[next].outline;
            reach = fmax(reach, pieces[next].to);
        }
        struct outline united;
        ok = clip_nonzero(&united, group, next - i);
        outline_append(out, &united);
        outline_free(&united);
    }
    free(group);
    if (!ok) {
        outline_free(out);
        out->clean = true;
    }
    return ok;
}

static bool draw(struct outline *out, const struct letters *row, const struct text_line *line,
                 const struct layout *layout)
{
    struct piece *pieces = make_pieces(row, line, layout);
    bool ok = unite(out, pieces, row->count);

    for (uint32_t i = 0; i < row->count; i++)
        outline_free(&pieces[i].outline);
    free(pieces);
    return ok;
}

static bool too_many_points(const struct letters *row, const struct text_line *line)
{
    uint64_t points = 0;

    for (uint32_t i = 0; i < row->count; i++)
        points += glyph_points(row->items[i].outline, pieces_of(line));
    return points > TEXT_POINTS_MAX;
}

// What is wrong with the arguments, or NULL.
static const char *refusal(const struct text_line *line)
{
    return !utf8_is_valid(line->text)            ? "its letters are not UTF-8"
           : strlen(line->text) > TEXT_BYTES_MAX ? "it is longer than a mebibyte"
           : !isfinite(line->size)               ? "its size is no number"
           : !isfinite(line->spacing)            ? "its spacing is no number"
                                                 : NULL;
}

bool text_outline(struct outline *out, const struct text_line *line, struct place place,
                  struct messages *messages)
{
    struct letters row = {0};

    *out = (struct outline){.clean = true};
    if (!line->text || !*line->text)
        return true;
    const char *wrong = refusal(line);
    if (!wrong && !shape(&row, line, place, messages))
        return false;
    if (!wrong && too_many_points(&row, line))
        wrong = "it would have more than 4 million points";
    if (!wrong) {
        struct layout layout = layout_make(&row, line, place, messages);
        if (!draw(out, &row, line, &layout))
            wrong = "it " CLIP_REFUSED;
    }
    letters_free(&row);
    if (wrong)
        messages_add(messages, MESSAGE_WARNING, place, "text: not drawn: %s", wrong);
    return !wrong;
}
