// line.c - nodes and their values in words, and what cuts what.
#include "csg/locate.h"
#include "edit/facts.h"

#include <stdlib.h>
#include <string.h>

// Text that ends in "..." where it does not fit.
struct line {
    char *text;
    size_t size, used;
    bool full;
};

static void put(struct line *l, const char *text)
{
    size_t length = strlen(text);
    if (l->full || !l->size)
        return;
    if (l->used + length < l->size) {
        memcpy(l->text + l->used, text, length + 1);
        l->used += length;
        return;
    }
    static const char dots[] = "...";
    size_t at = l->size > sizeof dots ? l->size - sizeof dots : 0;
    l->full = true;
    if (at < l->used) { // not in the middle of a character
        while (at && ((unsigned char)l->text[at] & 0xC0) == 0x80)
            at--;
    } else {
        at = l->used;
    }
    snprintf(l->text + at, l->size - at, "%s", dots);
}

static void put_scalar(struct line *l, const struct csg_value *v)
{
    char text[40];
    switch (v->kind) {
    case CSG_NUMBER:
        snprintf(text, sizeof text, "%g", v->number);
        put(l, text);
        break;
    case CSG_BOOL:
        put(l, v->boolean ? "true" : "false");
        break;
    case CSG_STRING:
        put(l, "\"");
        put(l, v->string);
        put(l, "\"");
        break;
    default:
        put(l, "undef");
    }
}

struct level {
    const struct csg_value *value;
    uint32_t done;
};

// A value with what was changed in it; ends where the line is full.
static void put_value(struct line *l, const struct edit *e, uint32_t node, uint32_t argument)
{
    struct level *levels = NULL;
    uint32_t depth = 0, room = 0, scalar = 0;
    struct csg_value now;
    const struct csg_value *v = &edit_source(e)->nodes[node]->arguments[argument].value;
    while (v && !l->full) {
        bool vector = v->kind == CSG_VECTOR || v->kind == CSG_NUMBERS;
        if (vector) {
            put(l, "[");
            array_reserve(&levels, &room, (size_t)depth + 1);
            levels[depth++] = (struct level){v, 0};
        } else if (v->kind == CSG_RANGE) {
            put(l, "[...:...]");
        } else {
            bool there = edit_scalar(e, node, argument, scalar++, &now);
            put_scalar(l, there ? &now : v);
        }
        v = NULL;
        while (depth && !v && !l->full) {
            struct level *top = &levels[depth - 1];
            if (top->done == top->value->count) {
                put(l, "]");
                depth--;
                continue;
            }
            if (top->done)
                put(l, ", ");
            if (top->value->kind == CSG_VECTOR) {
                v = &top->value->items[top->done++];
            } else {
                struct csg_value file = {.kind = CSG_NUMBER,
                                         .number = top->value->numbers[top->done++]};
                bool there = edit_scalar(e, node, argument, scalar++, &now);
                put_scalar(l, there ? &now : &file);
            }
        }
    }
    free(levels);
}

void facts_line(const struct edit *e, uint32_t node, char *out, size_t size)
{
    struct line l = {.text = out, .size = size};
    const struct csg_node *n = edit_source(e)->nodes[node];
    bool assignment = strcmp(n->name, CSG_ASSIGN) == 0;
    if (size)
        *out = 0;
    if (!assignment) {
        put(&l, edit_name(e, node));
        put(&l, "(");
    }
    for (uint32_t i = 0; i < n->argument_count && !l.full; i++) {
        if (i)
            put(&l, ", ");
        if (n->arguments[i].name) {
            put(&l, n->arguments[i].name);
            put(&l, " = ");
        }
        put_value(&l, e, node, i);
    }
    if (!assignment)
        put(&l, ")");
}

// The indices that lead to a scalar.
static void put_indices(struct line *l, const struct csg_value *v, uint32_t scalar)
{
    char text[16];
    while (v->kind == CSG_VECTOR) {
        uint32_t i = 0, count;
        for (; i < v->count && (count = csg_scalar_count(&v->items[i])) <= scalar; i++)
            scalar -= count;
        if (i == v->count)
            return;
        snprintf(text, sizeof text, "[%u]", i);
        put(l, text);
        v = &v->items[i];
    }
    if (v->kind != CSG_NUMBERS)
        return;
    snprintf(text, sizeof text, "[%u]", scalar);
    put(l, text);
}

void facts_label(const struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar, char *out,
                 size_t size)
{
    struct line l = {.text = out, .size = size};
    const struct csg_node *n = edit_source(e)->nodes[node];
    if (size)
        *out = 0;
    if (argument >= n->argument_count)
        return;
    if (n->arguments[argument].name)
        put(&l, n->arguments[argument].name);
    put_indices(&l, &n->arguments[argument].value, scalar);
}

// Does OpenSCAD count it among the operands?
static bool is_operand(const struct edit *e, uint32_t node)
{
    return strcmp(edit_source(e)->nodes[node]->name, CSG_ASSIGN) != 0 &&
           !(edit_marks(e, node) & (CSG_DISABLE | CSG_BACKGROUND));
}

static uint32_t first_operand(const struct edit *e, uint32_t node)
{
    const struct source *s = edit_source(e);
    for (uint32_t i = node + 1; i < node + s->span[node]; i += s->span[i])
        if (is_operand(e, i))
            return i;
    return SOURCE_NONE;
}

bool facts_cut(const struct edit *e, uint32_t node, struct cut *out)
{
    const struct source *s = edit_source(e);
    for (uint32_t child = node; s->parent[child] != SOURCE_NONE; child = s->parent[child]) {
        uint32_t parent = s->parent[child], first;
        if (strcmp(edit_name(e, parent), "difference") != 0)
            continue;
        first = first_operand(e, parent);
        if (first == child)
            continue;
        *out = (struct cut){parent, child, first};
        return true;
    }
    return false;
}
