// outlines.c - the borders of a model that is a flat shape.
#include "render/outlines.h"

enum { WIDTH = 2 };

void outlines_draw(const struct canvas *c, const struct shader *shader, const struct rays *rays)
{
    const struct outline *o = shader->model->flat;
    const struct line_style style = {.colour = shader->scheme->edge_flat, .width = WIDTH};
    struct canvas over = *c;
    over.depth = NULL;
    if (!o)
        return;
    for (uint32_t path = 0, first = 0; path < o->path_count; first = o->ends[path++])
        for (uint32_t i = first; i < o->ends[path]; i++) {
            struct vec2 a = o->points[i], b = o->points[i + 1 < o->ends[path] ? i + 1 : first];
            lines_draw(&over, rays, &style, (struct vec3){a.x, a.y, 0}, (struct vec3){b.x, b.y, 0});
        }
}
