// sides.c - the sides of all faces as lines, as OpenSCAD draws edges of shapes thrown together.
//
// Those of the model it draws a second time with the back faces, which are culled where lines are
// not: so they have the colour of back faces. Those of marked objects are half transparent, twice
// where two faces meet.
#include "render/sides.h"

static const struct line_style styles[] = {
    [BODY_MAIN] = {.colour = {255, 0, 255}, .width = 2},
    [BODY_BACKGROUND] = {.colour = {150, 150, 150}, .width = 2, .half = true},
    [BODY_HIGHLIGHT] = {.colour = {255, 171, 86}, .width = 2, .half = true},
};

struct drawing {
    const struct canvas *canvas;
    const struct rays *rays;
    const struct line_style *style;
    const struct leaf *leaf;
};

// See-through ones always from the same end, so that a second one lies on the first.
static void draw_side(void *context, struct vec3 from, struct vec3 to)
{
    const struct drawing *d = context;
    bool turned = d->style->half && (from.x != to.x   ? from.x > to.x
                                     : from.y != to.y ? from.y > to.y
                                                      : from.z > to.z);
    lines_draw(d->canvas, d->rays, d->style, affine_point(&d->leaf->to_world, turned ? to : from),
               affine_point(&d->leaf->to_world, turned ? from : to));
}

void sides_draw(const struct canvas *c, const struct model *m, const struct facets *facets,
                const struct rays *rays)
{
    for (uint32_t b = 0; b < m->body_count; b++)
        for (uint32_t i = 0; i < m->bodies[b].leaf_count; i++) {
            struct drawing d = {c, rays, &styles[m->bodies[b].kind], &m->bodies[b].leaves[i]};
            facets_sides(facets, d.leaf->solid, &d, draw_side);
        }
}
