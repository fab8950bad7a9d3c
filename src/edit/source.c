// source.c - a file as it was read: its text and its tree, shared by those who look at them.
#include "edit/source.h"

#include <stdlib.h>

// Numbers the nodes without recursion: those that are open are the chain of parents.
static void number_nodes(struct source *s)
{
    uint32_t count = 0, parent = SOURCE_NONE, most = s->tree.node_count;
    const struct csg_node *n = s->tree.first;
    s->nodes = mem_alloc(((size_t)most + 1) * sizeof *s->nodes);
    s->parent = mem_alloc(((size_t)most + 1) * sizeof *s->parent);
    s->span = mem_alloc(((size_t)most + 1) * sizeof *s->span);
    while (n) {
        s->nodes[count] = n;
        s->parent[count] = parent;
        s->span[count] = 1;
        uint32_t last = count++;
        if (n->child) {
            parent = last;
            n = n->child;
            continue;
        }
        while (!(n = s->nodes[last]->next) && parent != SOURCE_NONE) {
            last = parent;
            s->span[last] = count - last;
            parent = s->parent[last];
        }
    }
    s->node_count = count;
}

struct source *source_new(const char *file, char *text, size_t size, struct messages *messages)
{
    struct source *s = mem_zalloc(sizeof *s);
    if (!csg_parse(&s->tree, file, text, size, messages)) {
        free(text);
        free(s);
        return NULL;
    }
    s->text = text;
    s->size = size;
    atomic_init(&s->references, 1);
    number_nodes(s);
    return s;
}

struct source *source_hold(struct source *s)
{
    atomic_fetch_add(&s->references, 1);
    return s;
}

void source_release(struct source *s)
{
    if (!s || atomic_fetch_sub(&s->references, 1) != 1)
        return;
    csg_free(&s->tree);
    free(s->text);
    free(s->nodes);
    free(s->parent);
    free(s->span);
    free(s);
}

static uint32_t first_from(const struct source *s, uint32_t line, uint32_t column)
{
    uint32_t low = 0, high = s->node_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        const struct csg_node *n = s->nodes[middle];
        if (n->line < line || (n->line == line && n->column < column))
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->node_count ? low : SOURCE_NONE;
}

uint32_t source_node_at(const struct source *s, uint32_t line, uint32_t column)
{
    uint32_t i = first_from(s, line, column);
    bool there = i != SOURCE_NONE && s->nodes[i]->line == line && s->nodes[i]->column == column;
    return there ? i : SOURCE_NONE;
}

uint32_t source_node_from(const struct source *s, uint32_t line)
{
    return first_from(s, line, 0);
}
