// whole.c - the file evaluated as one object.
#include "model/evaluate.h"
#include "model/operands.h"

// The plate of a flat shape has no thickness of its own here; sheets are thickened as others.
static const struct affine pressed_flat = {{{1, 0, 0, 0}, {0, 1, 0, 0}}};

void builder_evaluate(struct builder *b)
{
    const struct csg_node *root = builder_root(b);
    struct csg_node only, all = {.name = "union", .child = b->tree->first};
    struct geometry g;
    if (root) {
        only = *root;
        only.modifiers = 0;
        only.next = NULL;
        all.child = &only;
    }
    bool done = evaluate_once(b, &all, &g);
    b->scene.root = TERM_EMPTY;
    if (done && g.kind == GEOMETRY_SOLID) {
        b->scene = g.scene;
        b->scene.root = g.root;
        if (b->options->united)
            b->scene.root = closed_term(b, b->scene.root);
        g.scene = (struct scene){0};
    }
    if (done && g.kind == GEOMETRY_FLAT && g.plate)
        b->scene.root = scene_leaf(&b->scene, &(struct leaf){.solid = g.plate,
                                                             .to_world = pressed_flat,
                                                             .colour = {-1, -1, -1, -1},
                                                             .flat = true,
                                                             .place = builder_place(b, all.child)});
    geometry_free(&g);
}
