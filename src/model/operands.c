// operands.c - the children of a node and what they are together.
#include "model/operands.h"
#include "geom/boolean.h"
#include "geom/clip.h"
#include "geom/placed.h"
#include "model/sheet.h"
#include "model/store.h"

#include <stdlib.h>

void value_free(struct value *v)
{
    outline_free(&v->outline);
    *v = (struct value){.term = TERM_EMPTY};
}

// ---------------------------------------------------------------- flat shapes

static void fold_flat(struct operands *o, enum term_op op, struct outline *out)
{
    const struct outline **shapes = mem_alloc((o->count + 1) * sizeof *shapes);
    uint32_t count = 0;
    for (uint32_t i = 0; i < o->count; i++) {
        bool empty = o->values[i].kind != GEOMETRY_FLAT;
        if (!empty || op == TERM_INTERSECTION || (op == TERM_DIFFERENCE && i == 0))
            shapes[count++] = empty ? NULL : &o->values[i].outline;
    }
    bool done = op == TERM_UNION          ? clip_union(out, shapes, count)
                : op == TERM_INTERSECTION ? clip_intersection(out, shapes, count)
                                          : clip_difference(out, shapes, count);
    if (!done)
        builder_warn(o->b, o->args->node, "%s(): a flat shape " CLIP_REFUSED "; left out",
                     o->args->node->name);
    free(shapes);
}

void value_place(struct builder *b, const struct csg_node *n, struct value *v,
                 const struct affine *a)
{
    double determinant = a->m[0][0] * a->m[1][1] - a->m[0][1] * a->m[1][0];
    if (!(fabs(determinant) > 0)) {
        builder_warn(b, n, "%s() presses a flat shape to a line; left out", n->name);
        outline_free(&v->outline);
        return;
    }
    outline_transform(&v->outline, a);
    if (determinant < 0) {
        struct outline mirrored = v->outline;
        clip_clean(&v->outline, &mirrored);
        outline_free(&mirrored);
    }
}

// ---------------------------------------------------------------- solids

uint32_t closed_term(struct builder *b, uint32_t term)
{
    const struct term *t = term < TERM_EMPTY ? &b->scene.terms[term] : NULL;
    if (!t || t->op != TERM_LEAF)
        return term;
    const struct leaf *leaf = &b->scene.leaves[t->left];
    if (!leaf->solid || store_is_closed(b->store, leaf->solid))
        return term;
    messages_add(b->messages, MESSAGE_WARNING, leaf->place,
                 "a mesh that is not closed or partly inside out cannot be combined with others; "
                 "left out");
    return TERM_EMPTY;
}

static uint32_t solid_term(const struct value *v)
{
    return v->kind == GEOMETRY_SOLID ? v->term : TERM_EMPTY;
}

// What is empty does not count in a union.
static bool are_combined(const struct operands *o, enum term_op op)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < o->count; i++)
        count += op != TERM_UNION || solid_term(&o->values[i]) < TERM_EMPTY;
    return count > 1;
}

static struct leaf *single_leaf(const struct scene *s, uint32_t term)
{
    bool is_leaf = term < TERM_EMPTY && s->terms[term].op == TERM_LEAF;
    return is_leaf ? &s->leaves[s->terms[term].left] : NULL;
}

struct value value_of_term(const struct scene *s, uint32_t term)
{
    const struct leaf *leaf = single_leaf(s, term);
    return (struct value){
        .kind = GEOMETRY_SOLID, .term = term, .placed = leaf ? leaf->to_world : AFFINE_IDENTITY};
}

// Leaves that meet for the first time get their grid; one that meets nothing keeps its place.
static void meet(struct operands *o, bool combined, struct value *out)
{
    for (uint32_t i = 0; i < o->count; i++) {
        const struct value *v = &o->values[i];
        const struct leaf *leaf = single_leaf(o->scene, solid_term(v));
        if (leaf && combined && !leaf->grid)
            scene_grid(o->scene, o->scene->terms[v->term].left, &v->placed);
        if (leaf && !combined)
            out->placed = v->placed;
    }
}

void operands_fold(struct operands *o, enum term_op op, struct value *out)
{
    out->kind = o->kind;
    out->term = TERM_EMPTY;
    if (o->kind == GEOMETRY_FLAT)
        fold_flat(o, op, &out->outline);
    if (o->kind != GEOMETRY_SOLID)
        return;
    uint32_t term = TERM_NONE;
    bool combined = are_combined(o, op);
    meet(o, combined, out);
    for (uint32_t i = 0; i < o->count; i++) {
        uint32_t one = solid_term(&o->values[i]);
        term = scene_fold(o->scene, op, term, combined ? closed_term(o->b, one) : one);
    }
    out->term = term == TERM_NONE ? TERM_EMPTY : term;
}

void operands_move(struct operands *o, const struct affine *a)
{
    for (uint32_t i = o->first_leaf; i < o->scene->leaf_count; i++) {
        struct leaf *leaf = &o->scene->leaves[i];
        leaf->to_world = affine_mul(a, &leaf->to_world);
    }
}

void operands_become(struct operands *o, const struct solid *solid, struct value *out)
{
    o->scene->leaf_count = o->first_leaf;
    o->scene->term_count = o->first_term;
    out->kind = GEOMETRY_SOLID;
    out->term = TERM_EMPTY;
    if (solid && solid->mesh.triangle_count)
        operands_add(o, solid, out);
}

void operands_add(struct operands *o, const struct solid *solid, struct value *out)
{
    uint32_t leaf = scene_leaf(
        o->scene,
        &(struct leaf){.solid = solid, .to_world = AFFINE_IDENTITY, .colour = {-1, -1, -1, -1}});
    out->term = scene_fold(o->scene, TERM_UNION, out->term, leaf);
}

// The mesh of a leaf where it stands; none of one that is pressed flat.
static void leaf_mesh(const struct leaf *leaf, struct mesh *out)
{
    *out = (struct mesh){0};
    if (!sheet_is_flat(&leaf->to_world))
        mesh_placed(out, &leaf->solid->mesh, &leaf->to_world);
}

bool operands_mesh(struct operands *o, uint32_t term, struct mesh *out)
{
    static const enum boolean_op op_of[] = {[TERM_UNION] = BOOLEAN_UNION,
                                            [TERM_INTERSECTION] = BOOLEAN_INTERSECTION,
                                            [TERM_DIFFERENCE] = BOOLEAN_DIFFERENCE};
    struct step {
        uint32_t term;
        bool operands_done;
    } *steps = NULL;
    struct mesh *meshes = NULL; // of the operands that are done
    uint32_t step_count = 0, step_room = 0, mesh_count = 0, mesh_room = 0;
    bool done = true;
    *out = (struct mesh){0};
    if (term >= TERM_EMPTY)
        return true;
    array_reserve(&steps, &step_room, 1);
    steps[step_count++] = (struct step){term, false};
    while (step_count && done && !builder_cancelled(o->b)) {
        struct step now = steps[--step_count];
        const struct term *t = &o->scene->terms[now.term];
        array_reserve(&meshes, &mesh_room, (size_t)mesh_count + 1);
        if (t->op == TERM_LEAF) {
            leaf_mesh(&o->scene->leaves[t->left], &meshes[mesh_count++]);
        } else if (now.operands_done) {
            struct error err;
            struct mesh b = meshes[--mesh_count], a = meshes[--mesh_count], both;
            done = boolean_mesh(&both, op_of[t->op], &a, &b, &err);
            if (done)
                meshes[mesh_count++] = both;
            else
                builder_warn(o->b, o->args->node, "%s(): %s; left out", o->args->node->name,
                             err.text);
            mesh_free(&a);
            mesh_free(&b);
        } else {
            array_reserve(&steps, &step_room, (size_t)step_count + 3);
            steps[step_count++] = (struct step){now.term, true};
            steps[step_count++] = (struct step){t->right, false};
            steps[step_count++] = (struct step){t->left, false};
        }
    }
    if (done && mesh_count && !step_count)
        *out = meshes[--mesh_count];
    while (mesh_count)
        mesh_free(&meshes[--mesh_count]);
    free(meshes);
    free(steps);
    return done;
}

void mesh_parts_add(struct mesh_parts *p, struct mesh *m, bool convex)
{
    array_reserve(&p->items, &p->room, (size_t)p->count + 1);
    solid_from_mesh(&p->items[p->count++], m, convex, 0);
}

// The operands of nested unions, each once, in their order. The caller frees them.
static uint32_t *operands_of_union(const struct scene *s, uint32_t term, uint32_t *count)
{
    uint32_t *todo = NULL, *found = NULL, todo_count = 0, todo_room = 0, room = 0;
    *count = 0;
    array_reserve(&todo, &todo_room, 1);
    if (term < TERM_EMPTY)
        todo[todo_count++] = term;
    while (todo_count) {
        uint32_t now = todo[--todo_count];
        const struct term *t = &s->terms[now];
        if (t->op != TERM_UNION) {
            array_reserve(&found, &room, (size_t)*count + 1);
            found[(*count)++] = now;
            continue;
        }
        array_reserve(&todo, &todo_room, (size_t)todo_count + 2);
        todo[todo_count++] = t->right;
        todo[todo_count++] = t->left;
    }
    free(todo);
    return found;
}

bool operands_parts(struct operands *o, uint32_t term, struct mesh_parts *out)
{
    uint32_t count;
    uint32_t *terms = operands_of_union(o->scene, term, &count);
    bool done = true;
    for (uint32_t i = 0; i < count && done; i++) {
        const struct term *t = &o->scene->terms[terms[i]];
        struct mesh m;
        done = operands_mesh(o, terms[i], &m);
        if (done && m.triangle_count)
            mesh_parts_add(out, &m, t->op == TERM_LEAF && o->scene->leaves[t->left].solid->convex);
        else
            mesh_free(&m);
    }
    free(terms);
    return done;
}

static void add_points(struct point_list *out, const struct mesh *m, const struct affine *a)
{
    array_reserve(&out->items, &out->room, (size_t)out->count + m->vertex_count);
    for (uint32_t i = 0; i < m->vertex_count; i++)
        out->items[out->count++] = affine_point(a, m->vertices[i]);
}

bool operands_points(struct operands *o, uint32_t term, struct point_list *out)
{
    uint32_t count;
    uint32_t *terms = operands_of_union(o->scene, term, &count);
    bool done = true;
    for (uint32_t i = 0; i < count && done; i++) {
        const struct term *t = &o->scene->terms[terms[i]];
        if (t->op == TERM_LEAF) {
            const struct leaf *leaf = &o->scene->leaves[t->left];
            add_points(out, &leaf->solid->mesh, &leaf->to_world);
            continue;
        }
        struct mesh m;
        done = operands_mesh(o, terms[i], &m);
        if (done)
            add_points(out, &m, &AFFINE_IDENTITY);
        mesh_free(&m);
    }
    free(terms);
    return done;
}

void mesh_parts_free(struct mesh_parts *p)
{
    for (uint32_t i = 0; i < p->count; i++)
        solid_free(&p->items[i]);
    free(p->items);
    *p = (struct mesh_parts){0};
}
