// iterate.c - the nodes of a tree in the order of the file, without recursion.
#include "csg/csg.h"

#include <stdlib.h>

void csg_enter(struct csg_iterator *it, const struct csg_node *first)
{
    if (!first)
        return;
    array_reserve(&it->stack, &it->room, (size_t)it->count + 1);
    it->stack[it->count++] = first;
}

const struct csg_node *csg_next(struct csg_iterator *it)
{
    if (!it->count)
        return NULL;
    const struct csg_node *n = it->stack[--it->count];
    csg_enter(it, n->next);
    return n;
}

void csg_iterator_free(struct csg_iterator *it)
{
    free(it->stack);
    *it = (struct csg_iterator){0};
}
