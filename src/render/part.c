// part.c - a part of a body as a body of its own, whose solids are borrowed.
#include "render/part.h"

#include "base/mem.h"

#include <stdlib.h>

void part_finish(struct body *body)
{
    struct box *boxes = mem_alloc((body->leaf_count + 1) * sizeof *boxes);
    bool *convex = mem_alloc(body->leaf_count + 1);
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        boxes[i] = body->leaves[i].box;
        convex[i] = body->leaves[i].solid->convex;
    }
    roi_build(boxes, &body->expr, boxes);
    body->roi = boxes;
    sharing_build(&body->sharing, &body->expr, convex, true);
    body->table = discovery_new(&body->expr, &body->sharing);
    free(convex);
}

void part_init(struct body *out, const struct body *whole, uint32_t node)
{
    uint32_t first = expr_first(&whole->expr, node), most = node - first + 1;
    struct expr_token *tokens = mem_alloc(2 * (size_t)most * sizeof *tokens);
    *out = (struct body){.kind = whole->kind};
    out->leaves = mem_alloc(most * sizeof *out->leaves);
    size_t count = expr_postfix(tokens, &whole->expr, node, NULL);
    for (size_t i = 0; i < count; i++)
        if (tokens[i].op == EXPR_LEAF) {
            out->leaves[out->leaf_count] = whole->leaves[tokens[i].arg];
            tokens[i].arg = out->leaf_count++;
        }
    expr_build(&out->expr, tokens, count, out->leaf_count);
    free(tokens);
    part_finish(out);
}

void part_free(struct body *part)
{
    discovery_delete(part->table);
    sharing_free(&part->sharing);
    expr_free(&part->expr);
    free(part->roi);
    free(part->leaves);
    *part = (struct body){0};
}
