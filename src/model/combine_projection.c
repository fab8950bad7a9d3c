// combine_projection.c - projection: shadows and cuts of solids, without a mesh of their union.
#include "geom/clip.h"
#include "geom/placed.h"
#include "geom/section.h"
#include "model/nodes.h"

#include <stdlib.h>

const struct parameters parameters_projection = {{"cut", "convexity"}, 1};

// ---------------------------------------------------------------- shadows

// A union's shadow is that of its parts; other operations have to be evaluated.
static bool shadow(struct operands *o, struct outline *out)
{
    struct mesh_parts parts = {0};
    bool done = true;
    for (uint32_t i = 0; i < o->count && done; i++)
        if (o->values[i].kind == GEOMETRY_SOLID)
            done = operands_parts(o, o->values[i].term, &parts);
    struct outline *shadows = mem_zalloc((parts.count + 1) * sizeof *shadows);
    const struct outline **list = mem_alloc((parts.count + 1) * sizeof *list);
    for (uint32_t i = 0; i < parts.count && done; i++) {
        done = section_shadow(&shadows[i], &parts.items[i].mesh);
        list[i] = &shadows[i];
    }
    done = done && clip_union(out, list, parts.count);
    for (uint32_t i = 0; i < parts.count; i++)
        outline_free(&shadows[i]);
    free(shadows);
    free(list);
    mesh_parts_free(&parts);
    return done;
}

// ---------------------------------------------------------------- cuts

static bool cut_leaf(const struct leaf *leaf, struct outline *out)
{
    struct mesh m;
    mesh_placed(&m, &leaf->solid->mesh, &leaf->to_world);
    bool done = section_cut(out, &m);
    mesh_free(&m);
    return done;
}

struct step { // of a walk over terms: TERM_NONE says that `count` operands are done
    uint32_t term, count;
    uint8_t op;
};

struct steps {
    struct step *items;
    uint32_t count, room;
};

static void push(struct steps *s, struct step one)
{
    array_reserve(&s->items, &s->room, (size_t)s->count + 1);
    s->items[s->count++] = one;
}

// A chain of one operation down the left operands is one operation on many.
static void push_operands(struct steps *s, const struct scene *scene, const struct term *t)
{
    uint32_t close = s->count, count = 1;
    uint8_t op = t->op;
    push(s, (struct step){.term = TERM_NONE, .op = op});
    for (;; t = &scene->terms[t->left]) {
        push(s, (struct step){.term = t->right});
        count++;
        if (scene->terms[t->left].op != op)
            break;
    }
    push(s, (struct step){.term = t->left});
    s->items[close].count = count;
}

static bool combine(enum term_op op, const struct outline *operands, uint32_t count,
                    struct outline *out)
{
    const struct outline **list = mem_alloc((count + 1) * sizeof *list);
    for (uint32_t i = 0; i < count; i++)
        list[i] = &operands[i];
    bool done = op == TERM_UNION          ? clip_union(out, list, count)
                : op == TERM_INTERSECTION ? clip_intersection(out, list, count)
                                          : clip_difference(out, list, count);
    free(list);
    return done;
}

// The operations between solids are those between their cross sections.
static bool cut_term(const struct scene *scene, uint32_t term, struct outline *out)
{
    struct steps steps = {0};
    struct outline *done = NULL;
    uint32_t done_count = 0, done_room = 0;
    bool fine = true;
    if (term < TERM_EMPTY)
        push(&steps, (struct step){.term = term});
    while (steps.count && fine) {
        struct step now = steps.items[--steps.count];
        struct outline result = {0};
        const struct term *t = now.term == TERM_NONE ? NULL : &scene->terms[now.term];
        if (t && t->op != TERM_LEAF) {
            push_operands(&steps, scene, t);
            continue;
        }
        if (t) {
            fine = cut_leaf(&scene->leaves[t->left], &result);
        } else {
            uint32_t first = done_count - now.count;
            fine = combine(now.op, done + first, now.count, &result);
            while (done_count > first)
                outline_free(&done[--done_count]);
        }
        array_reserve(&done, &done_room, (size_t)done_count + 1);
        done[done_count++] = result;
    }
    if (fine && done_count)
        *out = done[--done_count];
    while (done_count)
        outline_free(&done[--done_count]);
    free(done);
    free(steps.items);
    return fine;
}

void combine_projection(struct operands *o, struct value *out)
{
    struct outline flat = {0};
    bool cut = value_true(o->args->values[0]), done = true;
    if (o->kind == GEOMETRY_FLAT)
        builder_warn(o->b, o->args->node, "projection() needs solids; the 2D ones are left out");
    if (o->kind == GEOMETRY_SOLID && cut) {
        operands_fold(o, TERM_UNION, out);
        done = cut_term(o->scene, closed_term(o->b, out->term), &flat);
    } else if (o->kind == GEOMETRY_SOLID) {
        done = shadow(o, &flat);
    }
    operands_become(o, NULL, out);
    if (!done)
        builder_warn(o->b, o->args->node, "projection(): the shape " CLIP_REFUSED "; left out");
    if (cut && !flat.path_count && o->kind == GEOMETRY_SOLID)
        builder_warn(o->b, o->args->node, "projection() cuts nothing at z = 0");
    flat.clean = true;
    *out = (struct value){.kind = GEOMETRY_FLAT, .outline = flat, .term = TERM_EMPTY};
}
