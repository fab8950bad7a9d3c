// products.c - which shapes take part in the sum of products that OpenSCAD makes of a term.
//
// The sum is not stored: one product after the other is worked out. A state is a product so far and
// a list of the terms that it is still to be intersected with or to lose; where a term stands for a
// sum the state splits in two.
#include "model/products.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

#define NO_CELL UINT32_MAX
enum { STEPS_MOST = 1000000 };

// Lists of terms share their ends.
struct cell {
    uint32_t term, next;
    bool subtract;
};

struct state {
    struct box box;   // of the product so far
    uint32_t agenda;  // cells still to be worked in
    uint32_t members; // cells of the product
};

struct expansion {
    const struct scene *s;
    struct box *boxes;    // per term
    unsigned char *roles; // per term, enum part_role
    struct cell *cells;
    uint32_t cell_count, cell_room;
    struct state *stack;
    uint32_t stack_count, stack_room;
};

static bool is_part(const struct term *t)
{
    return t->op == TERM_LEAF || t->rendered;
}

// As OpenSCAD has it: whole leaves, flat ones without thickness; of a difference that of the left.
static struct box box_of_term(const struct expansion *e, const struct term *t)
{
    if (t->op == TERM_LEAF) {
        const struct leaf *leaf = &e->s->leaves[t->left];
        struct box box = leaf->solid ? leaf->solid->bounds : BOX_EMPTY;
        if (leaf->flat)
            box.min.z = box.max.z = 0;
        return box_transformed(box, &leaf->to_world);
    }
    struct box left = e->boxes[t->left], right = e->boxes[t->right];
    return t->op == TERM_UNION          ? box_union(left, right)
           : t->op == TERM_INTERSECTION ? box_intersection(left, right)
                                        : left;
}

static bool meet(struct box a, struct box b)
{
    return !box_is_empty(box_intersection(a, b));
}

static uint32_t cons(struct expansion *e, uint32_t term, bool subtract, uint32_t next)
{
    array_reserve(&e->cells, &e->cell_room, (size_t)e->cell_count + 1);
    e->cells[e->cell_count] = (struct cell){term, next, subtract};
    return e->cell_count++;
}

static void push(struct expansion *e, struct state s)
{
    array_reserve(&e->stack, &e->stack_room, (size_t)e->stack_count + 1);
    e->stack[e->stack_count++] = s;
}

static void note_product(struct expansion *e, const struct state *s)
{
    for (uint32_t c = s->members; c != NO_CELL; c = e->cells[c].next) {
        struct cell cell = e->cells[c];
        if (e->roles[cell.term] != PART_ABSENT)
            continue;
        if (!cell.subtract)
            e->roles[cell.term] = PART_INTERSECTED;
        else if (meet(s->box, e->boxes[cell.term]))
            e->roles[cell.term] = PART_SUBTRACTED;
    }
}

// Works the first term of the agenda in.
static void step(struct expansion *e, struct state s)
{
    struct cell now = e->cells[s.agenda];
    const struct term *t = &e->s->terms[now.term];
    s.agenda = now.next;
    bool meets = meet(s.box, e->boxes[now.term]);
    if (!meets) {
        if (now.subtract)
            push(e, s);
        return;
    }
    if (is_part(t)) {
        if (!now.subtract)
            s.box = box_intersection(s.box, e->boxes[now.term]);
        s.members = cons(e, now.term, now.subtract, s.members);
        push(e, s);
        return;
    }
    // Subtracting turns sums and products over: x - (y + z) is one product, x - y * z are two.
    bool minus = t->op == TERM_DIFFERENCE;
    bool splits = (t->op == TERM_UNION) != now.subtract;
    struct state other = s;
    other.agenda = cons(e, t->right, now.subtract != minus, s.agenda);
    s.agenda = cons(e, t->left, now.subtract, splits ? s.agenda : other.agenda);
    if (splits)
        push(e, other);
    push(e, s);
}

// False when there are too many steps.
static bool expand(struct expansion *e, uint32_t term)
{
    uint32_t steps = 0;
    push(e, (struct state){BOX_ALL, cons(e, term, false, NO_CELL), NO_CELL});
    while (e->stack_count) {
        struct state s = e->stack[--e->stack_count];
        if (s.agenda == NO_CELL)
            note_product(e, &s);
        else if (steps++ < STEPS_MOST)
            step(e, s);
        else
            return false;
    }
    return true;
}

// Goes through all parts below a term, those that OpenSCAD's normal form would not reach included.
static void place_rest(struct expansion *e, uint32_t term)
{
    e->stack_count = 0;
    uint32_t from = e->cell_count, done = from;
    cons(e, term, false, NO_CELL);
    for (; done < e->cell_count; done++) {
        struct cell now = e->cells[done];
        const struct term *t = &e->s->terms[now.term];
        if (is_part(t)) {
            if (e->roles[now.term] == PART_ABSENT)
                e->roles[now.term] = now.subtract ? PART_SUBTRACTED : PART_INTERSECTED;
            continue;
        }
        cons(e, t->left, now.subtract, NO_CELL);
        cons(e, t->right, now.subtract != (t->op == TERM_DIFFERENCE), NO_CELL);
    }
}

// The leaf of a part that comes first in the file.
static uint32_t first_leaf(const struct scene *s, uint32_t term)
{
    while (s->terms[term].op != TERM_LEAF)
        term = s->terms[term].left;
    return s->terms[term].left;
}

struct ordered {
    struct part part;
    uint32_t leaf;
};

static int by_leaf(const void *a, const void *b)
{
    uint32_t p = ((const struct ordered *)a)->leaf, q = ((const struct ordered *)b)->leaf;
    return p < q ? -1 : p > q;
}

static void collect(const struct expansion *e, struct part **parts, uint32_t *count)
{
    const struct scene *s = e->s;
    struct ordered *list = mem_alloc((s->term_count + 1) * sizeof *list);
    *count = 0;
    for (uint32_t i = 0; i < s->term_count; i++)
        if (e->roles[i] != PART_ABSENT)
            list[(*count)++] = (struct ordered){{i, (enum part_role)e->roles[i]}, first_leaf(s, i)};
    qsort(list, *count, sizeof *list, by_leaf);
    *parts = mem_alloc((*count + 1) * sizeof **parts);
    for (uint32_t i = 0; i < *count; i++)
        (*parts)[i] = list[i].part;
    free(list);
}

void products_parts(const struct scene *s, uint32_t term, struct part **parts, uint32_t *count)
{
    struct expansion e = {.s = s};
    e.boxes = mem_alloc((s->term_count + 1) * sizeof *e.boxes);
    e.roles = mem_zalloc(s->term_count + 1);
    for (uint32_t i = 0; i < s->term_count; i++) // operands come before what is made of them
        e.boxes[i] = box_of_term(&e, &s->terms[i]);
    if (term < TERM_EMPTY && !expand(&e, term))
        place_rest(&e, term);
    collect(&e, parts, count);
    free(e.boxes);
    free(e.roles);
    free(e.cells);
    free(e.stack);
}
