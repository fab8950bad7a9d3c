// read_dxf.c - flat shapes from DXF drawings.
#include "io/read_dxf.h"

#include "base/hash.h"
#include "geom/clip.h"
#include "io/dxf_drawing.h"
#include "io/scan.h"

#include <stdlib.h>
#include <string.h>

enum { STRANGERS_KEPT = 16 }; // kinds of entities that are named in warnings

struct reader {
    struct drawing drawing;
    struct scan scan;
    struct {
        struct span kind;
        uint32_t count;
    } strangers[STRANGERS_KEPT];
    uint32_t stranger_count, others;
};

bool span_is(struct span s, const char *text)
{
    return scan_is(s.text, s.length, text);
}

static bool span_equal(struct span a, struct span b)
{
    return a.length == b.length && (a.length == 0 || memcmp(a.text, b.text, a.length) == 0);
}

void drawing_free(struct drawing *d)
{
    dxf_lines_free(&d->lines);
    free(d->entity.x);
    free(d->entity.y);
    free(d->blocks);
    free(d->slots);
    free(d->block_lines);
}

static uint32_t *find_slot(const struct drawing *d, struct span name)
{
    uint32_t mask = d->slot_count - 1;
    uint32_t at = (uint32_t)hash_bytes(0, name.text, name.length) & mask;
    while (d->slots[at] && !span_equal(d->blocks[d->slots[at] - 1].name, name))
        at = (at + 1) & mask;
    return &d->slots[at];
}

uint32_t drawing_block(struct drawing *d, struct span name)
{
    if (!d->slot_count || d->block_count >= d->slot_count / 2) {
        free(d->slots);
        d->slot_count = d->slot_count ? d->slot_count * 2 : 64;
        d->slots = mem_zalloc(d->slot_count * sizeof *d->slots);
        for (uint32_t i = 0; i < d->block_count; i++)
            *find_slot(d, d->blocks[i].name) = i + 1;
    }
    uint32_t *slot = find_slot(d, name);
    if (!*slot) {
        array_reserve(&d->blocks, &d->block_room, (size_t)d->block_count + 1);
        d->blocks[d->block_count++] = (struct block){.name = name};
        *slot = d->block_count;
    }
    return *slot - 1;
}

static struct span read_line(struct scan *s)
{
    scan_in_line(s);
    struct span line = {s->at, 0};
    scan_skip_line(s);
    line.length = (size_t)(s->at - line.text);
    while (line.length && strchr(" \t\r\n\f\v", line.text[line.length - 1]))
        line.length--; // also zero bytes, which strchr finds
    return line;
}

static bool read_number(const struct scan *s, struct span value, double *out)
{
    char *stop;
    double number = value.length ? strtod_l(value.text, &stop, s->numbers) : NAN;
    if (!isfinite(number) || stop != value.text + value.length)
        return false;
    *out = number;
    return true;
}

static void note_stranger(struct reader *r, struct span kind)
{
    uint32_t i = 0;
    while (i < r->stranger_count && !span_equal(r->strangers[i].kind, kind))
        i++;
    if (i == STRANGERS_KEPT) {
        r->others++;
        return;
    }
    if (i == r->stranger_count)
        r->strangers[r->stranger_count++].kind = kind;
    r->strangers[i].count++;
}

static void report_strangers(const struct reader *r)
{
    const struct drawing *d = &r->drawing;
    for (uint32_t i = 0; i < r->stranger_count; i++)
        messages_add(d->messages, MESSAGE_WARNING, d->place,
                     "DXF entity %.*s is not supported: %u left out",
                     (int)(r->strangers[i].kind.length < 40 ? r->strangers[i].kind.length : 40),
                     r->strangers[i].kind.text, r->strangers[i].count);
    if (r->others)
        messages_add(d->messages, MESSAGE_WARNING, d->place,
                     "more kinds of DXF entities that are not supported: %u left out", r->others);
}

static void finish_section(struct drawing *d)
{
    struct span name = d->entity.name;
    d->section = span_is(name, "ENTITIES") ? SECTION_ENTITIES
                 : span_is(name, "BLOCKS") ? SECTION_BLOCKS
                                           : SECTION_OTHER;
}

// Acts on everything known of an entity, when the next one begins.
static void finish_entity(struct reader *r)
{
    struct drawing *d = &r->drawing;
    const struct entity *e = &d->entity;
    const char *layer = d->options->layer;
    if (span_is(e->kind, "SECTION")) {
        finish_section(d);
    } else if (span_is(e->kind, "ENDSEC")) {
        d->section = SECTION_OTHER;
    } else if (span_is(e->kind, "BLOCK")) {
        d->block = drawing_block(d, e->name);
    } else if (span_is(e->kind, "ENDBLK")) {
        d->block = UINT32_MAX;
    } else if (d->section == SECTION_BLOCKS) {
        entity_draw(d);
    } else if (d->section == SECTION_ENTITIES) {
        if (layer && *layer && !span_is(e->layer, layer))
            return;
        if (!entity_draw(d))
            note_stranger(r, e->kind);
    }
}

static void begin_entity(struct reader *r, struct span kind)
{
    struct entity *e = &r->drawing.entity;
    e->kind = kind;
    e->line = r->scan.line - 1;
    e->name = e->layer = (struct span){"", 0};
    e->x_count = e->y_count = e->flags = 0;
    e->c40 = e->c50 = e->c51 = 0;
    e->c41 = e->c42 = span_is(kind, "INSERT") ? 1 : 0; // factors of the size of a block
}

// Places and lengths outside of blocks are on the scale of the result at once.
static void take_number(struct drawing *d, int code, double v)
{
    struct entity *e = &d->entity;
    bool scaled = d->section != SECTION_BLOCKS;
    if (code >= 10 && code <= 13) {
        array_reserve(&e->x, &e->x_room, (size_t)e->x_count + 1);
        e->x[e->x_count++] = scaled ? (v - d->options->origin_x) * d->options->scale : v;
    } else if (code >= 20 && code <= 23) {
        array_reserve(&e->y, &e->y_room, (size_t)e->y_count + 1);
        e->y[e->y_count++] = scaled ? (v - d->options->origin_y) * d->options->scale : v;
    } else {
        switch (code) {
        case 40:
            e->c40 = scaled ? v * d->options->scale : v;
            break;
        case 41:
            e->c41 = v;
            break;
        case 42:
            e->c42 = v;
            break;
        case 50:
            e->c50 = v;
            break;
        case 51:
            e->c51 = v;
            break;
        case 70:
            e->flags = v >= 0 && v <= UINT32_MAX ? (uint32_t)v : 0;
            break;
        default:
            break;
        }
    }
}

static bool is_number(int code)
{
    return (code >= 10 && code <= 13) || (code >= 20 && code <= 23) || (code >= 40 && code <= 42) ||
           code == 50 || code == 51 || code == 70;
}

static void take_group(struct reader *r, int code, struct span value)
{
    struct drawing *d = &r->drawing;
    double number;
    if (code == 0) {
        finish_entity(r);
        begin_entity(r, value);
    } else if (code == 2) {
        d->entity.name = value;
    } else if (code == 8) {
        d->entity.layer = value;
    } else if (is_number(code) && (d->section != SECTION_OTHER)) {
        if (read_number(&r->scan, value, &number))
            take_number(d, code, number);
        else
            messages_add(d->messages, MESSAGE_WARNING,
                         (struct place){d->place.file, r->scan.line - 1, 0},
                         "no finite number: '%.*s'", (int)(value.length < 40 ? value.length : 40),
                         value.text);
    }
}

static bool read_groups(struct reader *r, struct error *err)
{
    struct drawing *d = &r->drawing;
    while (r->scan.at < r->scan.end && !d->full) {
        double code;
        struct span line = read_line(&r->scan);
        if (line.length == 0 && r->scan.at >= r->scan.end)
            break;
        if (!read_number(&r->scan, line, &code) || fabs(code) > 9999) {
            messages_add(d->messages, MESSAGE_WARNING,
                         (struct place){d->place.file, r->scan.line - 1, 0},
                         "no DXF group code: the rest of the file is left out");
            break;
        }
        take_group(r, (int)code, read_line(&r->scan));
    }
    if (d->full)
        error_at(err, d->place, "more than %d lines", DXF_LINES_MAX);
    return !d->full;
}

static void make_outline(struct drawing *d, struct outline *out)
{
    struct outline paths = {0};
    dxf_lines_join(&d->lines, &paths);
    *out = (struct outline){0};
    if (d->too_far || !clip_clean(out, &paths)) {
        messages_add(d->messages, MESSAGE_WARNING, d->place,
                     "the drawing " CLIP_REFUSED ": left out");
        outline_free(out);
        out->clean = true;
    }
    outline_free(&paths);
}

bool read_dxf(const char *path, const char *data, size_t size, const struct dxf_options *options,
              struct outline *out, struct messages *messages, struct error *err)
{
    if (size >= 18 && memcmp(data, "AutoCAD Binary DXF", 18) == 0) {
        error_at(err, (struct place){path, 0, 0}, "binary DXF files cannot be read");
        return false;
    }
    struct dxf_options sane = *options;
    if (!(sane.scale > 0 && isfinite(sane.scale)))
        sane.scale = 1;
    struct reader r = {
        .drawing = {
            .options = &sane, .place = {path, 0, 0}, .messages = messages, .block = UINT32_MAX}};
    begin_entity(&r, (struct span){"", 0});
    scan_open(&r.scan, path, data, size);
    bool ok = read_groups(&r, err);
    scan_close(&r.scan);
    if (ok) {
        report_strangers(&r);
        make_outline(&r.drawing, out);
    }
    drawing_free(&r.drawing);
    return ok;
}
