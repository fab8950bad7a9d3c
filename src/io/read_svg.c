// read_svg.c - flat shapes from SVG pictures.
#include "io/read_svg.h"

#include "base/mem.h"
#include "io/svg.h"

#include <expat.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_MAX = 1 << 20, PART = 1 << 26 };

struct frame { // of an element that the reader is in
    struct svg_map map;
    bool hidden, wanted;
};

struct reader {
    XML_Parser parser;
    const struct svg_options *options;
    struct place place;
    struct error *err;
    bool failed;
    locale_t numbers;

    struct frame *frames;
    uint32_t depth, frame_room;
    struct svg_map page;
    struct svg_pen pen;
    struct outline paths; // of all shapes, in user units
    uint32_t *ends;       // of each shape, where its paths end
    uint32_t shape_count, end_room;
    uint32_t left_out; // elements that could be seen but are not read
};

static void fail(struct reader *r, const char *what)
{
    struct place place = r->place;
    place.line = (uint32_t)XML_GetCurrentLineNumber(r->parser);
    error_at(r->err, place, "%s", what);
    r->failed = true;
    XML_StopParser(r->parser, XML_FALSE);
}

// Newer versions read a part of the picture when they are asked to.
static bool is_wanted(const struct svg_options *o, const char *const *attributes)
{
    const char *id = svg_attribute(attributes, "id");
    const char *mode = svg_attribute(attributes, "inkscape:groupmode");
    const char *label = svg_attribute(attributes, "inkscape:label");
    if (o->id && *o->id && id && strcmp(id, o->id) == 0)
        return true;
    return o->layer && *o->layer && mode && strcmp(mode, "layer") == 0 && label &&
           strcmp(label, o->layer) == 0;
}

static void draw(struct reader *r, const char *name, const char *const *attributes,
                 const struct frame *f)
{
    uint32_t first = r->paths.point_count;
    if (!svg_draw_shape(&r->pen, name, attributes, r->numbers)) {
        static const char *const seen[] = {"text", "image", "use"};
        for (size_t i = 0; i < array_count(seen); i++)
            r->left_out += strcmp(seen[i], name) == 0;
        return;
    }
    if (r->pen.failed) {
        fail(r, "a shape has too many points, or too large coordinates");
        return;
    }
    if (r->paths.point_count == first)
        return;
    struct svg_map m =
        svg_map_mul(f->map, svg_map_read(svg_attribute(attributes, "transform"), r->numbers));
    for (uint32_t i = first; i < r->paths.point_count; i++) {
        struct vec2 *p = &r->paths.points[i];
        *p = (struct vec2){m.a * p->x + m.c * p->y + m.e, m.b * p->x + m.d * p->y + m.f};
    }
    array_reserve(&r->ends, &r->end_room, (size_t)r->shape_count + 1);
    r->ends[r->shape_count++] = r->paths.path_count;
}

static void XMLCALL on_start(void *user, const char *name, const char **attributes)
{
    struct reader *r = user;
    const char *const *a = (const char *const *)attributes;
    if (r->failed)
        return; // expat ends only after the element at hand
    struct frame f = r->frames[r->depth - 1];
    f.wanted |= is_wanted(r->options, a);
    f.hidden |= strcmp(name, "defs") == 0;
    if (strcmp(name, "g") == 0)
        f.map = svg_map_mul(f.map, svg_map_read(svg_attribute(a, "transform"), r->numbers));
    else if (f.hidden)
        ;
    else if (strcmp(name, "svg") == 0)
        r->page = svg_page(a, r->options->dpi, r->numbers); // the last one counts, as in OpenSCAD
    else if (f.wanted)
        draw(r, name, a, &f);

    if (r->depth > DEPTH_MAX) {
        if (!r->failed)
            fail(r, "elements are nested too deeply");
        return;
    }
    array_reserve(&r->frames, &r->frame_room, (size_t)r->depth + 1);
    r->frames[r->depth++] = f;
}

static void XMLCALL on_end(void *user, const char *name)
{
    (void)name;
    struct reader *r = user;
    if (!r->failed)
        r->depth--;
}

// Entities are expanded, since drawing programs use them; expat itself refuses those that blow up.
static bool parse(struct reader *r, const char *data, size_t size)
{
    r->parser = XML_ParserCreate(NULL);
    if (!r->parser) {
        error_at(r->err, r->place, "XML: out of memory");
        return false;
    }
    XML_SetUserData(r->parser, r);
    XML_SetElementHandler(r->parser, on_start, on_end);
    for (bool last = false; !last && !r->failed;) {
        size_t part = size < PART ? size : PART;
        last = part == size;
        if (XML_Parse(r->parser, data, (int)part, last) == XML_STATUS_ERROR && !r->failed)
            fail(r, XML_ErrorString(XML_GetErrorCode(r->parser)));
        data += part;
        size -= part;
    }
    XML_ParserFree(r->parser);
    return !r->failed;
}

static void to_millimetres(struct reader *r)
{
    struct outline *o = &r->paths;
    struct svg_map m = r->page;
    if (r->options->center) {
        struct box b = outline_bounds(o);
        double cx = (b.min.x + b.max.x) / 2, cy = (b.min.y + b.max.y) / 2;
        for (uint32_t i = 0; i < o->point_count; i++) {
            o->points[i].x = m.a * (-cx + o->points[i].x);
            o->points[i].y = m.d * (-cy + o->points[i].y);
        }
        return;
    }
    for (uint32_t i = 0; i < o->point_count; i++) {
        struct vec2 *p = &o->points[i];
        *p = (struct vec2){m.a * p->x + m.c * p->y + m.e, m.b * p->x + m.d * p->y + m.f};
    }
}

// Within a shape paths cut holes into each other, shapes are put together.
static bool unite(const struct reader *r, struct outline *out)
{
    struct outline *shapes = mem_zalloc(r->shape_count * sizeof *shapes);
    const struct outline **list = mem_alloc(r->shape_count * sizeof *list);
    bool ok = true;
    for (uint32_t i = 0, path = 0, point = 0; i < r->shape_count && ok; i++) {
        struct outline shape = {0};
        for (; path < r->ends[i]; path++) {
            for (; point < r->paths.ends[path]; point++)
                outline_add(&shape, r->paths.points[point]);
            outline_close(&shape);
        }
        ok = clip_clean(&shapes[i], &shape);
        list[i] = &shapes[i];
        outline_free(&shape);
    }
    ok = ok && clip_union(out, list, r->shape_count);
    for (uint32_t i = 0; i < r->shape_count; i++)
        outline_free(&shapes[i]);
    free(shapes);
    free(list);
    return ok;
}

bool read_svg(const char *path, const char *data, size_t size, const struct svg_options *options,
              struct outline *out, struct messages *messages, struct error *err)
{
    struct svg_options sane = *options;
    if (!(sane.dpi > 0 && isfinite(sane.dpi)))
        sane.dpi = 72;
    bool some = sane.newer && ((sane.id && *sane.id) || (sane.layer && *sane.layer));
    struct reader r = {.options = &sane, .place = {path, 0, 0}, .err = err, .page.a = 1};
    r.page.d = -1;
    r.pen = (struct svg_pen){.out = &r.paths, .options = &sane};
    r.numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    array_reserve(&r.frames, &r.frame_room, 1);
    r.frames[r.depth++] = (struct frame){SVG_MAP_IDENTITY, false, !some};

    bool ok = parse(&r, data, size);
    if (ok) {
        struct outline shape = {0};
        to_millimetres(&r);
        if (!unite(&r, &shape)) {
            messages_add(messages, MESSAGE_WARNING, r.place,
                         "the drawing " CLIP_REFUSED ": left out");
            shape = (struct outline){.clean = true};
        }
        if (r.left_out)
            messages_add(messages, MESSAGE_WARNING, r.place,
                         "text, image and use elements are not read: %u left out", r.left_out);
        *out = shape;
    }
    if (r.numbers)
        freelocale(r.numbers);
    svg_pen_free(&r.pen);
    outline_free(&r.paths);
    free(r.ends);
    free(r.frames);
    return ok;
}
