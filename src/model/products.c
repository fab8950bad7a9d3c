// products.c - which shapes take part in the sum of products that OpenSCAD makes of a term.
//
// The sum is not stored: one product after the other is worked out. A state is a product so far and
// a list of the terms that it is still to be intersected with or to lose; where a term stands for a
// sum the state splits in two. hcsg/products lists the products of the normal form, which has lost
// the file's pairs of operands: each is pruned here by its own box, whatever the sum's length.
#include "model/products.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

#define NO_CELL UINT32_MAX
enum { STEPS_MOST = 1000000 };

// Lists of terms share their ends.
struct cell {
    uint32_t term, next;
    bool subtract, highlighted;
};

struct state {
    struct box box;   // of the product so far
    uint32_t agenda;  // cells still to be worked in
    uint32_t members; // cells of the product
};

struct expansion {
    const struct scene *s;
    struct box *boxes;  // per term
    struct part *parts; // per term
    struct cell *cells;
    uint32_t cell_count, cell_room;
    struct state *stack;
    uint32_t stack_count, stack_room;
};

static bool is_part(const struct term *t)
{
    return t->op == TERM_LEAF || t->rendered;
}

static bool meet(struct box a, struct box b)
{
    return !box_is_empty(box_intersection(a, b));
}

static uint32_t cons(struct expansion *e, struct cell c)
{
    array_reserve(&e->cells, &e->cell_room, (size_t)e->cell_count + 1);
    e->cells[e->cell_count] = c;
    return e->cell_count++;
}

static void push(struct expansion *e, struct state s)
{
    array_reserve(&e->stack, &e->stack_room, (size_t)e->stack_count + 1);
    e->stack[e->stack_count++] = s;
}

static void note_part(struct expansion *e, const struct cell *c)
{
    struct part *p = &e->parts[c->term];
    if (p->role == PART_ABSENT)
        *p = (struct part){c->term, c->subtract ? PART_SUBTRACTED : PART_INTERSECTED,
                           c->highlighted};
}

static void note_product(struct expansion *e, const struct state *s)
{
    for (uint32_t i = s->members; i != NO_CELL; i = e->cells[i].next) {
        struct cell c = e->cells[i];
        if (!c.subtract || meet(s->box, e->boxes[c.term]))
            note_part(e, &c);
    }
}

// Multiplying out makes other operations of one whose operands it takes apart, and of these. What
// it makes does not have their marks.
static bool takes_apart(const struct term *t, const struct term *operand, bool right)
{
    if (is_part(operand) || t->op == TERM_UNION)
        return false;
    return right || (operand->op != TERM_INTERSECTION && operand->op != t->op);
}

static bool is_marked(const struct scene *s, const struct term *t)
{
    if (is_part(t))
        return t->highlighted;
    return t->highlighted && !takes_apart(t, &s->terms[t->left], false) &&
           !takes_apart(t, &s->terms[t->right], true);
}

// The cell of an operand of the term in a cell.
static struct cell operand(const struct expansion *e, const struct cell *of, bool right)
{
    const struct term *t = &e->s->terms[of->term];
    struct cell c = {right ? t->right : t->left, NO_CELL, of->subtract, of->highlighted};
    c.subtract ^= right && t->op == TERM_DIFFERENCE;
    const struct term *own = &e->s->terms[c.term];
    c.highlighted |= is_marked(e->s, own) && !takes_apart(t, own, right);
    return c;
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
        now.next = s.members;
        s.members = cons(e, now);
        push(e, s);
        return;
    }
    // Subtracting turns sums and products over: x - (y + z) is one product, x - y * z are two.
    bool splits = (t->op == TERM_UNION) != now.subtract;
    struct cell left = operand(e, &now, false), right = operand(e, &now, true);
    struct state other = s;
    right.next = s.agenda;
    other.agenda = cons(e, right);
    left.next = splits ? s.agenda : other.agenda;
    s.agenda = cons(e, left);
    if (splits)
        push(e, other);
    push(e, s);
}

static struct cell root_cell(const struct expansion *e, uint32_t term)
{
    const struct term *t = &e->s->terms[term];
    return (struct cell){term, NO_CELL, false, is_marked(e->s, t)};
}

// False when there are too many steps.
static bool expand(struct expansion *e, uint32_t term)
{
    uint32_t steps = 0;
    push(e, (struct state){BOX_ALL, cons(e, root_cell(e, term)), NO_CELL});
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
    uint32_t done = e->cell_count;
    cons(e, root_cell(e, term));
    for (; done < e->cell_count; done++) {
        struct cell now = e->cells[done];
        if (is_part(&e->s->terms[now.term])) {
            note_part(e, &now);
            continue;
        }
        struct cell left = operand(e, &now, false), right = operand(e, &now, true);
        cons(e, left);
        cons(e, right);
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
        if (e->parts[i].role != PART_ABSENT)
            list[(*count)++] = (struct ordered){e->parts[i], first_leaf(s, i)};
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
    e.parts = mem_zalloc((s->term_count + 1) * sizeof *e.parts);
    for (uint32_t i = 0; i < s->term_count; i++) // operands come before what is made of them
        e.boxes[i] = term_box(s, i, e.boxes);
    if (term < TERM_EMPTY && !expand(&e, term))
        place_rest(&e, term);
    collect(&e, parts, count);
    free(e.boxes);
    free(e.parts);
    free(e.cells);
    free(e.stack);
}
