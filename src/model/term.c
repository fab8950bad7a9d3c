// term.c - placed shapes and the operations between them, with the marks % and #.
#include "model/term.h"

#include "base/mem.h"
#include "csg/csg.h"

#include <stdlib.h>

static uint32_t add_term(struct scene *s, struct term t)
{
    array_reserve(&s->terms, &s->term_room, (size_t)s->term_count + 1);
    s->terms[s->term_count] = t;
    return s->term_count++;
}

static void list_add(struct term_list *l, uint32_t term)
{
    array_reserve(&l->items, &l->room, (size_t)l->count + 1);
    l->items[l->count++] = term;
}

uint32_t scene_leaf(struct scene *s, const struct leaf *leaf)
{
    array_reserve(&s->leaves, &s->leaf_room, (size_t)s->leaf_count + 1);
    s->leaves[s->leaf_count] = *leaf;
    return add_term(s, (struct term){.op = TERM_LEAF, .left = s->leaf_count++});
}

void scene_grid(struct scene *s, uint32_t leaf, const struct affine *grid)
{
    array_reserve(&s->grids, &s->grid_room, (size_t)s->grid_count + 1);
    s->grids[s->grid_count++] = *grid;
    s->leaves[leaf].grid = s->grid_count;
}

void scene_mark(struct scene *s, uint32_t term, uint8_t marks)
{
    if (term >= TERM_EMPTY)
        return;
    s->terms[term].marks |= marks;
    s->terms[term].highlighted |= marks & CSG_HIGHLIGHT;
}

uint32_t scene_marks(const struct scene *s, uint32_t term)
{
    return term < TERM_EMPTY ? s->terms[term].marks : 0;
}

void scene_rendered(struct scene *s, uint32_t term)
{
    if (term < TERM_EMPTY)
        s->terms[term].rendered = true;
}

void scene_show_apart(struct scene *s, uint32_t term)
{
    uint32_t marks = scene_marks(s, term);
    if (marks & CSG_BACKGROUND)
        list_add(&s->backgrounds, term);
    if (marks & CSG_HIGHLIGHT)
        list_add(&s->highlights, term);
    if (marks)
        s->terms[term].marks = 0;
}

// x + 0 = x, x - 0 = x, 0 - x = 0, x * 0 = 0.
static uint32_t combine(struct scene *s, enum term_op op, uint32_t left, uint32_t right)
{
    if (op == TERM_INTERSECTION && (left == TERM_EMPTY || right == TERM_EMPTY))
        return TERM_EMPTY;
    if (op == TERM_DIFFERENCE && left == TERM_EMPTY)
        return TERM_EMPTY;
    if (right == TERM_EMPTY)
        return left;
    if (left == TERM_EMPTY)
        return right;
    return add_term(s, (struct term){.op = (uint8_t)op, .left = left, .right = right});
}

static uint32_t fold_union(struct scene *s, uint32_t left, uint32_t right)
{
    bool left_marked = scene_marks(s, left) & CSG_HIGHLIGHT;
    bool right_marked = scene_marks(s, right) & CSG_HIGHLIGHT;
    if (left == TERM_EMPTY || right == TERM_EMPTY || left_marked == right_marked) {
        uint32_t t = combine(s, TERM_UNION, left, right);
        if (left_marked && right_marked)
            scene_mark(s, t, CSG_HIGHLIGHT);
        return t;
    }
    uint32_t marked = left_marked ? left : right;
    s->terms[marked].taken_out = true;
    scene_show_apart(s, marked);
    return left_marked ? right : left;
}

struct box term_box(const struct scene *s, uint32_t term, const struct box *boxes)
{
    const struct term *t = &s->terms[term];
    if (t->op == TERM_LEAF) {
        const struct leaf *leaf = &s->leaves[t->left];
        struct box box = leaf->solid ? leaf->solid->bounds : BOX_EMPTY;
        if (leaf->flat)
            box.min.z = box.max.z = 0;
        return box_transformed(box, &leaf->to_world);
    }
    struct box left = boxes[t->left], right = boxes[t->right];
    return t->op == TERM_UNION          ? box_union(left, right)
           : t->op == TERM_INTERSECTION ? box_intersection(left, right)
                                        : left;
}

static bool boxes_meet(struct scene *s, uint32_t left, uint32_t right)
{
    uint32_t last = left > right ? left : right;
    if (left >= TERM_EMPTY || right >= TERM_EMPTY)
        return false;
    array_reserve(&s->boxes, &s->box_room, (size_t)last + 1);
    for (; s->box_count <= last; s->box_count++) // operands come before what is made of them
        s->boxes[s->box_count] = term_box(s, s->box_count, s->boxes);
    return !box_is_empty(box_intersection(s->boxes[left], s->boxes[right]));
}

uint32_t scene_fold(struct scene *s, enum term_op op, uint32_t left, uint32_t right)
{
    if (left == TERM_NONE)
        return right;
    uint32_t left_marks = scene_marks(s, left), right_marks = scene_marks(s, right);
    if (right_marks & CSG_BACKGROUND) {
        scene_show_apart(s, right);
        return left;
    }
    if (left_marks & CSG_BACKGROUND) {
        scene_show_apart(s, left);
        return right;
    }
    if (op == TERM_UNION)
        return fold_union(s, left, right);
    uint32_t t = combine(s, op, left, right);
    bool all = op == TERM_DIFFERENCE ? left_marks : left_marks && right_marks;
    // As in OpenSCAD, what is empty by its boxes alone has no mark: its operands show theirs. And
    // what misses the other by its box is not subtracted from it.
    bool meet = !all || boxes_meet(s, left, right);
    if (all && !meet && op == TERM_DIFFERENCE)
        scene_show_apart(s, right);
    if (all && (meet || op == TERM_DIFFERENCE)) {
        scene_mark(s, t, CSG_HIGHLIGHT);
        return t;
    }
    scene_show_apart(s, left);
    scene_show_apart(s, right);
    return t;
}

void scene_finish(struct scene *s, uint32_t root)
{
    bool background = scene_marks(s, root) & CSG_BACKGROUND;
    scene_show_apart(s, root);
    s->root = background || root == TERM_NONE ? TERM_EMPTY : root;
}

// A term's copy comes after those of its operands, so the copies are made on the way back up.
uint32_t scene_add(struct scene *s, const struct scene *from, uint32_t term)
{
    struct step {
        uint32_t term;
        bool operands_done;
    } *steps = NULL;
    uint32_t *copies = NULL; // of the operands that are done
    uint32_t step_count = 0, step_room = 0, copy_count = 0, copy_room = 0;
    if (term >= TERM_EMPTY)
        return term;
    array_reserve(&steps, &step_room, 1);
    steps[step_count++] = (struct step){term, false};
    while (step_count) {
        struct step now = steps[--step_count];
        struct term t = from->terms[now.term];
        t.marks = 0;
        array_reserve(&copies, &copy_room, (size_t)copy_count + 1);
        if (t.op == TERM_LEAF) {
            const struct leaf *leaf = &from->leaves[t.left];
            copies[copy_count++] = scene_leaf(s, leaf);
            if (leaf->grid)
                scene_grid(s, s->leaf_count - 1, &from->grids[leaf->grid - 1]);
        } else if (now.operands_done) {
            t.right = copies[--copy_count];
            t.left = copies[--copy_count];
            copies[copy_count++] = add_term(s, t);
        } else {
            array_reserve(&steps, &step_room, (size_t)step_count + 3);
            steps[step_count++] = (struct step){now.term, true};
            steps[step_count++] = (struct step){t.right, false};
            steps[step_count++] = (struct step){t.left, false};
        }
    }
    uint32_t copy = copies[0];
    free(steps);
    free(copies);
    return copy;
}

void scene_free(struct scene *s)
{
    free(s->leaves);
    free(s->grids);
    free(s->terms);
    free(s->boxes);
    free(s->backgrounds.items);
    free(s->highlights.items);
    *s = (struct scene){0};
}
