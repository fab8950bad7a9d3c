// build.c - nodes, values and names of the tree, as the grammar finds them.
#include "csg/parser.h"

#include "base/hash.h"

#include <stdlib.h>
#include <string.h>

static void grow_names(struct csg_parser *p)
{
    uint32_t old_mask = p->name_mask, old_count = p->name_count;
    struct csg_interned *old = p->names;

    p->name_mask = old ? old_mask * 2 + 1 : 63;
    p->names = mem_zalloc(((size_t)p->name_mask + 1) * sizeof *p->names);
    for (uint32_t i = 0; old_count && i <= old_mask; i++) {
        if (!old[i].text)
            continue;
        uint32_t slot = (uint32_t)old[i].hash & p->name_mask;
        while (p->names[slot].text)
            slot = (slot + 1) & p->name_mask;
        p->names[slot] = old[i];
    }
    free(old);
}

const char *csg_intern(struct csg_parser *p, const char *text, size_t length)
{
    uint64_t hash = hash_bytes(0, text, length);

    if (!p->names || p->name_count > p->name_mask / 2)
        grow_names(p);
    uint32_t slot = (uint32_t)hash & p->name_mask;
    for (; p->names[slot].text; slot = (slot + 1) & p->name_mask)
        if (p->names[slot].hash == hash && strncmp(p->names[slot].text, text, length) == 0 &&
            !p->names[slot].text[length])
            return p->names[slot].text;
    p->names[slot] = (struct csg_interned){hash, arena_text(&p->tree.arena, text, length)};
    p->name_count++;
    return p->names[slot].text;
}

void csg_push_value(struct csg_parser *p, struct csg_value value)
{
    if (p->value_count == p->value_capacity)
        array_reserve(&p->values, &p->value_capacity, (size_t)p->value_count + 1);
    p->values[p->value_count++] = value;
}

void csg_push_argument(struct csg_parser *p, const char *name, struct csg_value value)
{
    if (p->argument_count == p->argument_capacity)
        array_reserve(&p->arguments, &p->argument_capacity, (size_t)p->argument_count + 1);
    p->arguments[p->argument_count++] = (struct csg_argument){name, value};
}

struct csg_value csg_vector(struct csg_parser *p, uint32_t count)
{
    struct csg_value vector = {.kind = CSG_NUMBERS, .count = count};

    if (!count)
        return vector;
    p->value_count -= count;
    const struct csg_value *items = p->values + p->value_count;
    for (uint32_t i = 0; i < count; i++)
        if (items[i].kind != CSG_NUMBER)
            vector.kind = CSG_VECTOR;
    if (vector.kind == CSG_VECTOR) {
        size_t size = count * sizeof *items;
        vector.items = memcpy(arena_alloc(&p->tree.arena, size), items, size);
    } else {
        double *numbers = arena_alloc(&p->tree.arena, count * sizeof *numbers);
        for (uint32_t i = 0; i < count; i++)
            numbers[i] = items[i].number;
        vector.numbers = numbers;
    }
    return vector;
}

bool csg_range(struct csg_parser *p, struct csg_value begin, struct csg_value step,
               struct csg_value end, struct csg_value *out)
{
    if (begin.kind != CSG_NUMBER || step.kind != CSG_NUMBER || end.kind != CSG_NUMBER) {
        csg_error(p, p->token, "a range [begin : step : end] holds numbers only");
        return false;
    }
    double *numbers = arena_alloc(&p->tree.arena, 3 * sizeof *numbers);
    numbers[0] = begin.number;
    numbers[1] = step.number;
    numbers[2] = end.number;
    *out = (struct csg_value){CSG_RANGE, 3, .numbers = numbers};
    return true;
}

struct csg_node *csg_node_new(struct csg_parser *p, struct csg_name name, uint8_t modifiers)
{
    struct csg_node *node = arena_alloc(&p->tree.arena, sizeof *node);
    size_t size = p->argument_count * sizeof *p->arguments;

    *node = (struct csg_node){
        .name = name.text,
        .argument_count = p->argument_count,
        .line = name.line,
        .column = name.column,
        .modifiers = modifiers,
    };
    if (size)
        node->arguments = memcpy(arena_alloc(&p->tree.arena, size), p->arguments, size);
    p->argument_count = 0;
    p->tree.node_count++;
    return node;
}

struct csg_list csg_append(struct csg_list list, struct csg_list more)
{
    if (!list.first)
        return more;
    if (more.first) {
        list.last->next = more.first;
        list.last = more.last;
    }
    return list;
}

void csg_open_brace(struct csg_parser *p)
{
    if (p->brace_count == p->brace_capacity)
        array_reserve(&p->braces, &p->brace_capacity, (size_t)p->brace_count + 1);
    p->braces[p->brace_count++] = p->token;
}

void csg_close_brace(struct csg_parser *p)
{
    p->brace_count--;
}

void csg_recovered(struct csg_parser *p)
{
    p->value_count = 0;
    p->argument_count = 0;
}
