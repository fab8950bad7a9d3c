// equal.c - do two trees say the same? Without recursion: trees and vectors nest as deep as files
// like.
#include "csg/csg.h"

#include <stdlib.h>
#include <string.h>

struct pair {
    const struct csg_value *a, *b;
    uint32_t count;
};

static bool one_equal(const struct csg_value *a, const struct csg_value *b)
{
    if (a->kind != b->kind || a->count != b->count)
        return false;
    switch (a->kind) {
    case CSG_BOOL:
        return a->boolean == b->boolean;
    case CSG_NUMBER: // by bits: -0 is another number than 0, nan the same as nan
        return memcmp(&a->number, &b->number, sizeof a->number) == 0;
    case CSG_STRING:
        return memcmp(a->string, b->string, a->count) == 0;
    case CSG_NUMBERS:
    case CSG_RANGE:
        return a->count == 0 || memcmp(a->numbers, b->numbers, a->count * sizeof(double)) == 0;
    case CSG_UNDEF:
    case CSG_VECTOR:
        break;
    }
    return true;
}

static bool values_equal(const struct csg_value *a, const struct csg_value *b)
{
    struct pair *stack = NULL;
    uint32_t depth = 0, room = 0;
    bool same = true;
    array_reserve(&stack, &room, 1);
    stack[depth++] = (struct pair){a, b, 1};
    while (depth && same) {
        struct pair *top = &stack[depth - 1];
        if (!top->count) {
            depth--;
            continue;
        }
        const struct csg_value *p = top->a++, *q = top->b++;
        top->count--;
        same = one_equal(p, q);
        if (same && p->kind == CSG_VECTOR) {
            array_reserve(&stack, &room, (size_t)depth + 1);
            stack[depth++] = (struct pair){p->items, q->items, p->count};
        }
    }
    free(stack);
    return same;
}

static bool nodes_equal(const struct csg_node *a, const struct csg_node *b)
{
    if (!a || !b || strcmp(a->name, b->name) != 0 || a->modifiers != b->modifiers ||
        a->argument_count != b->argument_count || !a->child != !b->child || !a->next != !b->next)
        return false;
    for (uint32_t i = 0; i < a->argument_count; i++) {
        const struct csg_argument *p = &a->arguments[i], *q = &b->arguments[i];
        if (!p->name != !q->name || (p->name && strcmp(p->name, q->name) != 0) ||
            !values_equal(&p->value, &q->value))
            return false;
    }
    return true;
}

bool csg_equal(const struct csg_tree *a, const struct csg_tree *b)
{
    struct csg_iterator i = {0}, k = {0};
    const struct csg_node *p, *q;
    bool same = !a->first == !b->first;
    csg_enter(&i, a->first);
    csg_enter(&k, b->first);
    while (same && (p = csg_next(&i))) {
        q = csg_next(&k);
        same = nodes_equal(p, q);
        if (same) {
            csg_enter(&i, p->child);
            csg_enter(&k, q->child);
        }
    }
    csg_iterator_free(&i);
    csg_iterator_free(&k);
    return same;
}
