// version.c - the tree and the text of a file with its changes.
#include "base/number.h"
#include "csg/locate.h"
#include "edit/change.h"

#include <stdlib.h>
#include <string.h>

// ---------------------------------------------------------------- the tree

// Makes the vectors around a scalar the tree's own, and returns where it stands in the innermost.
// With `own` the outermost is that already.
static void put_scalar(struct arena *arena, struct csg_value *value, uint32_t scalar, bool own,
                       const struct csg_value *now)
{
    for (;; own = false) {
        if (value->kind == CSG_NUMBERS) {
            double *numbers = (double *)value->numbers;
            size_t size = value->count * sizeof *numbers;
            if (!own)
                numbers = memcpy(arena_alloc(arena, size), value->numbers, size);
            numbers[scalar] = now->number;
            value->numbers = numbers;
            return;
        }
        if (value->kind != CSG_VECTOR) {
            *value = *now;
            return;
        }
        struct csg_value *items = (struct csg_value *)value->items;
        size_t size = value->count * sizeof *items;
        if (!own)
            items = memcpy(arena_alloc(arena, size), value->items, size);
        value->items = items;
        uint32_t count;
        for (; (count = csg_scalar_count(items)) <= scalar; items++)
            scalar -= count;
        value = items;
    }
}

static void put_change(struct arena *arena, struct csg_node *n, const struct change *c,
                       const struct change *before)
{
    bool same_node =
        before && before->place.node == c->place.node && before->place.argument != CHANGE_NAME;
    if (c->place.argument == CHANGE_NAME) {
        n->name = c->value.string;
        return;
    }
    struct csg_argument *arguments = (struct csg_argument *)n->arguments;
    if (!same_node) {
        size_t size = n->argument_count * sizeof *arguments;
        n->arguments = arguments = memcpy(arena_alloc(arena, size), n->arguments, size);
    }
    put_scalar(arena, &arguments[c->place.argument].value, c->place.scalar,
               same_node && before->place.argument == c->place.argument, &c->value);
}

// A name that stands elsewhere in the tree is the same pointer there: names are interned.
static void intern_names(const struct edit *e, struct csg_node *nodes)
{
    const char *const *names = edit_operations();
    const char *found[16] = {0};
    uint32_t changed = 0;
    for (uint32_t i = 0; i < e->change_count; i++)
        changed += e->changes[i].place.argument == CHANGE_NAME;
    for (uint32_t i = 0; changed && i < e->source->node_count; i++)
        for (uint32_t k = 0; names[k]; k++)
            if (!found[k] && strcmp(names[k], e->source->nodes[i]->name) == 0)
                found[k] = e->source->nodes[i]->name;
    for (uint32_t i = 0; changed && i < e->change_count; i++)
        for (uint32_t k = 0; e->changes[i].place.argument == CHANGE_NAME && names[k]; k++)
            if (found[k] && strcmp(names[k], e->changes[i].value.string) == 0)
                nodes[e->changes[i].place.node].name = found[k];
}

void edit_tree(const struct edit *e, struct csg_tree *out)
{
    const struct source *s = e->source;
    *out = (struct csg_tree){.file = s->tree.file ? mem_strdup(s->tree.file) : NULL,
                             .node_count = s->node_count};
    if (!s->node_count)
        return;
    struct csg_node *nodes = arena_alloc(&out->arena, s->node_count * sizeof *nodes);
    for (uint32_t i = 0; i < s->node_count; i++) {
        nodes[i] = *s->nodes[i];
        nodes[i].child = nodes[i].child ? &nodes[i + 1] : NULL;
        nodes[i].next = nodes[i].next ? &nodes[i + s->span[i]] : NULL;
    }
    out->first = nodes;
    for (uint32_t i = 0; i < e->change_count; i++) {
        const struct change *c = &e->changes[i];
        put_change(&out->arena, &nodes[c->place.node], c, i ? c - 1 : NULL);
    }
    intern_names(e, nodes);
    bool alone = false;
    for (uint32_t i = 0; i < e->mark_count; i++)
        alone |= e->marks[i].modifiers & CSG_ROOT;
    for (uint32_t i = 0; alone && i < s->node_count; i++)
        nodes[i].modifiers &= (uint8_t)~CSG_ROOT;
    for (uint32_t i = 0; i < e->mark_count; i++)
        nodes[e->marks[i].node].modifiers = e->marks[i].modifiers;
}

// ---------------------------------------------------------------- the text

struct patch {
    struct csg_span span;
    char text[NUMBER_TEXT];
};

static bool make_patch(const struct edit *e, const struct change *c, struct patch *out,
                       struct error *err)
{
    struct csg_text text = {e->source->text, e->source->size};
    const struct csg_node *n = e->source->nodes[c->place.node];
    bool found;
    if (c->place.argument == CHANGE_NAME) {
        found = csg_locate_name(&text, n, &out->span);
        snprintf(out->text, sizeof out->text, "%s", c->value.string);
    } else {
        found = csg_locate_scalar(&text, n, c->place.argument, c->place.scalar, &out->span);
        if (c->value.kind == CSG_BOOL)
            snprintf(out->text, sizeof out->text, "%s", c->value.boolean ? "true" : "false");
        else if (found)
            number_shortest(out->text, out->span.negative ? -c->value.number : c->value.number, 6,
                            17);
    }
    if (!found)
        error_at(err, (struct place){e->source->tree.file, n->line, n->column},
                 "the place of a change in %s() was not found", n->name);
    return found;
}

static int by_place(const void *a, const void *b)
{
    size_t p = ((const struct patch *)a)->span.begin, q = ((const struct patch *)b)->span.begin;
    return p < q ? -1 : p > q;
}

static char *patched(const struct source *s, const struct patch *patches, uint32_t count,
                     size_t *size)
{
    char *out = mem_alloc(s->size + (size_t)count * NUMBER_TEXT + 2), *at = out;
    size_t from = 0;
    for (uint32_t i = 0; i < count; i++) {
        size_t length = patches[i].span.begin - from;
        at = (char *)memcpy(at, s->text + from, length) + length;
        at = stpcpy(at, patches[i].text);
        from = patches[i].span.end;
    }
    at = (char *)memcpy(at, s->text + from, s->size - from) + (s->size - from);
    at[0] = at[1] = 0;
    *size = (size_t)(at - out);
    return out;
}

// Does the text read as the tree that the changes make?
static bool reads_back(const struct edit *e, char *text, size_t size)
{
    struct messages none = {0};
    struct edit unmarked = *e;
    struct csg_tree wanted, read;
    unmarked.mark_count = 0;
    bool same = csg_parse(&read, e->source->tree.file, text, size, &none);
    messages_free(&none);
    if (!same)
        return false;
    edit_tree(&unmarked, &wanted);
    same = csg_equal(&wanted, &read);
    csg_free(&wanted);
    csg_free(&read);
    return same;
}

bool edit_text(const struct edit *e, char **text, size_t *size, struct error *err)
{
    struct patch *patches = mem_alloc((e->change_count + 1) * sizeof *patches);
    bool ok = true;
    for (uint32_t i = 0; ok && i < e->change_count; i++)
        ok = make_patch(e, &e->changes[i], &patches[i], err);
    if (ok) {
        qsort(patches, e->change_count, sizeof *patches, by_place);
        *text = patched(e->source, patches, e->change_count, size);
    }
    free(patches);
    if (!ok || reads_back(e, *text, *size))
        return ok;
    free(*text);
    error_set(err, "%s: the changed text does not read as what is shown",
              e->source->tree.file ? e->source->tree.file : "-");
    return false;
}
