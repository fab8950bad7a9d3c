// inherit.c - what a model keeps of the one that it takes the place of.
#include "model/builder.h"

#include <stdlib.h>
#include <string.h>

static bool is_same_leaf(const struct leaf *a, const struct leaf *b)
{
    return (a->place.line == b->place.line && a->place.column == b->place.column) ||
           (a->solid == b->solid && memcmp(&a->to_world, &b->to_world, sizeof a->to_world) == 0);
}

// The numbers that leaves had before. As many as before: the shape of the tree has not changed, or
// so it seems; else those at the beginning and at the end that stayed. A wrong guess costs
// combinations that have to be found again, never a wrong answer.
static uint32_t *find_counterparts(const struct body *body, const struct body *before)
{
    uint32_t *counterpart = mem_alloc((size_t)body->leaf_count * sizeof *counterpart);
    uint32_t now = body->leaf_count, then = before->leaf_count, front = 0, back = 0;
    uint32_t most = now < then ? now : then;
    while (front < most &&
           (now == then || is_same_leaf(&body->leaves[front], &before->leaves[front])))
        front++;
    while (front + back < most &&
           is_same_leaf(&body->leaves[now - 1 - back], &before->leaves[then - 1 - back]))
        back++;
    for (uint32_t i = 0; i < now; i++)
        counterpart[i] = i < front ? i : i >= now - back ? i - now + then : EXPR_NONE;
    return counterpart;
}

static void body_inherit(struct body *body, const struct body *before)
{
    struct sharing *s = &body->sharing;
    if (sharing_equal(s, &body->expr, &before->sharing, &before->expr)) {
        for (uint32_t i = 0; i < s->class_count; i++)
            s->classes[i].value = before->sharing.classes[i].value;
        discovery_inherit(body->table, before->table, NULL);
        return;
    }
    uint32_t *counterpart = find_counterparts(body, before);
    uint32_t *image = mem_alloc((size_t)before->sharing.class_count * sizeof *image);
    sharing_inherit(s, body->leaf_count, &before->sharing, counterpart, image);
    discovery_inherit(body->table, before->table, image);
    free(counterpart);
    free(image);
}

void model_inherit(struct model *m, const struct model *before)
{
    uint32_t most = m->body_count < before->body_count ? m->body_count : before->body_count;
    for (uint32_t i = 0; i < most; i++)
        if (m->bodies[i].kind == before->bodies[i].kind)
            body_inherit(&m->bodies[i], &before->bodies[i]);
}
