// geometry.c - what a node is that OpenSCAD evaluates as one object.
#include "model/geometry.h"

#include "base/mem.h"

#include <stdlib.h>

void geometry_free(struct geometry *g)
{
    outline_free(&g->outline);
    scene_free(&g->scene);
    messages_free(&g->messages);
    for (uint32_t i = 0; i < g->import_count; i++)
        free(g->imports[i]);
    free(g->imports);
    *g = (struct geometry){0};
}
