// assignments.c - what is assigned at the top level of a .scad text, and what its comments say.
#include "customizer/assignments.h"

#include "base/hash.h"
#include "customizer/comments.h"
#include "customizer/scan.h"

#include <stdlib.h>
#include <string.h>

static void grow_names(struct scad_parser *p)
{
    uint32_t size = p->names ? 2 * (p->name_mask + 1) : 256;
    free(p->names);
    p->names = mem_zalloc(size * sizeof *p->names);
    p->name_mask = size - 1;
    for (uint32_t i = 0; i < p->out->count; i++) {
        const char *name = p->out->items[i].name;
        uint64_t slot = hash_bytes(0, name, strlen(name)) & p->name_mask;
        while (p->names[slot])
            slot = (slot + 1) & p->name_mask;
        p->names[slot] = i + 1;
    }
}

static struct assignment *find(struct scad_parser *p, struct slice name)
{
    struct assignments *out = p->out;
    if (!p->names || out->count >= p->name_mask / 2)
        grow_names(p);
    uint64_t slot = hash_bytes(0, name.text, name.size) & p->name_mask;
    for (; p->names[slot]; slot = (slot + 1) & p->name_mask) {
        struct assignment *old = &out->items[p->names[slot] - 1];
        if (strncmp(old->name, name.text, name.size) == 0 && !old->name[name.size])
            return old;
    }
    array_reserve(&out->items, &out->capacity, (size_t)out->count + 1);
    struct assignment *new = &out->items[out->count++];
    *new = (struct assignment){.name = arena_text(&out->arena, name.text, name.size)};
    p->names[slot] = out->count;
    return new;
}

// The last assignment decides, at the place of the first.
void scad_assigned(struct scad_parser *p, struct scad_name name, const struct literal *value)
{
    struct assignment *a = find(p, name.text);
    a->line = name.line;
    a->literal = value != NULL;
    a->value = value ? *value : (struct literal){0};
    p->value_count = 0;
}

void scad_push(struct scad_parser *p, struct literal value)
{
    array_reserve(&p->values, &p->value_capacity, (size_t)p->value_count + 1);
    p->values[p->value_count++] = value;
}

struct literal scad_pop(struct scad_parser *p, enum literal_kind kind, uint32_t count)
{
    if (count == 0)
        return (struct literal){.kind = kind};
    struct literal *items = arena_alloc(&p->out->arena, count * sizeof *items);
    p->value_count -= count;
    memcpy(items, p->values + p->value_count, count * sizeof *items);
    return (struct literal){kind, count, .items = items};
}

void scad_comment(struct scad_parser *p, const char *text, size_t size)
{
    if (memchr(text, '\n', size))
        return;
    array_reserve(&p->groups, &p->group_capacity, (size_t)p->group_count + 1);
    p->groups[p->group_count++] = (struct group_comment){p->line, {text + 2, size - 4}};
}

// The last one above the line, NULL when there is none.
static const struct group_comment *group_above(const struct scad_parser *p, uint32_t line)
{
    uint32_t below = 0, above = p->group_count;
    while (below < above) {
        uint32_t middle = below + (above - below) / 2;
        if (p->groups[middle].line < line)
            below = middle + 1;
        else
            above = middle;
    }
    return below ? &p->groups[below - 1] : NULL;
}

static void read_comments(struct scad_parser *p)
{
    struct arena *arena = &p->out->arena;
    const struct group_comment *last = NULL;
    const char *name = NULL;
    struct lines lines;
    lines_find(&lines, p->text, p->size);
    for (uint32_t i = 0; i < p->out->count; i++) {
        struct assignment *a = &p->out->items[i];
        a->annotation = (struct literal){LITERAL_STRING, .text = ""};
        if (!a->literal || a->line >= p->out->end_line)
            continue;
        const struct group_comment *group = group_above(p, a->line);
        if (group && group != last)
            name = comment_group(group->text, arena);
        last = group;
        a->group = group ? name : NULL;
        a->description = comment_description(&lines, a->line, arena);
        a->annotation = comment_annotation(&lines, a->line, arena);
    }
    lines_free(&lines);
}

static void parser_free(struct scad_parser *p)
{
    free(p->values);
    free(p->groups);
    free(p->names);
}

void assignments_read(struct assignments *out, const char *text, size_t size)
{
    *out = (struct assignments){.end_line = UINT32_MAX};
    if (size == 0 || size > SCAD_TEXT_MOST)
        return;
    struct scad_parser p = {.out = out, .text = text, .size = size, .line = 1};
    scad_parse(&p);
    read_comments(&p);
    parser_free(&p);
}

void assignments_free(struct assignments *a)
{
    free(a->items);
    arena_free(&a->arena);
    *a = (struct assignments){0};
}

bool literal_read(struct arena *arena, const char *text, size_t size, struct literal *out)
{
    if (size > SCAD_TEXT_MOST)
        return false;
    struct assignments none = {.arena = *arena};
    struct scad_parser p = {.out = &none, .text = text, .size = size, .line = 1, .single = true};
    bool ok = scad_parse(&p);
    parser_free(&p);
    *arena = none.arena;
    if (ok)
        *out = p.result;
    return ok;
}
