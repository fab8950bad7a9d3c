// evaluate.c - sparse evaluation of an expression.
//
// Only nodes that hold pass anything on, so the walk goes from the members of the set towards the
// root and stops where a node does not hold. Nodes are in postorder and classes in the order of
// their nodes: the nodes that something was passed to and that are not decided yet are always
// ancestors of one another, hence a stack with the deepest on top, and never more of them than
// members.
#include "hcsg/evaluate.h"

#include "base/mem.h"

#include <stdlib.h>

enum { PENDING_LOCAL = 128 };

static int compare_members(const void *a, const void *b)
{
    uint32_t p = ((const struct member *)a)->class_id, q = ((const struct member *)b)->class_id;
    return p < q ? -1 : p > q;
}

uint32_t members_settle(struct member *members, uint32_t count)
{
    uint32_t kept = 0;
    qsort(members, count, sizeof *members, compare_members);
    for (uint32_t i = 0, next; i < count; i = next) {
        struct member sum = members[i];
        for (next = i + 1; next < count && members[next].class_id == sum.class_id; next++)
            sum.count += members[next].count;
        if (sum.count)
            members[kept++] = sum;
    }
    return kept;
}

struct pending { // a node below which something holds
    uint32_t node;
    uint32_t held; // children that hold
    bool minus;    // what it subtracts holds
};

struct walk {
    const struct expr *e;
    struct pending *stack;
    uint32_t depth;
};

static struct pending *walk_pending(struct walk *w, uint32_t node)
{
    if (w->depth == 0 || w->stack[w->depth - 1].node != node)
        w->stack[w->depth++] = (struct pending){.node = node};
    return &w->stack[w->depth - 1];
}

// Tells the parent of a node that the node holds; true when there is no parent.
static bool walk_hold(struct walk *w, uint32_t node)
{
    uint32_t parent = w->e->nodes[node].parent;
    if (parent == EXPR_NONE)
        return true;
    struct pending *p = walk_pending(w, parent);
    if (w->e->nodes[parent].minus == node)
        p->minus = true;
    else
        p->held++;
    return false;
}

// Decides all pending nodes in front of `limit`; true when the root was one of them and holds.
static bool walk_decide(struct walk *w, uint32_t limit)
{
    while (w->depth > 0 && w->stack[w->depth - 1].node < limit) {
        struct pending p = w->stack[--w->depth];
        const struct expr_node *n = &w->e->nodes[p.node];
        bool holds = n->op == EXPR_UNION ? p.held > 0 : p.held == n->count && !p.minus;
        if (holds && walk_hold(w, p.node))
            return true;
    }
    return false;
}

static bool walk_member(struct walk *w, const struct value_class *c, uint32_t count)
{
    if (c->rule == CLASS_ALL && count != c->members)
        return false;
    if (w->e->nodes[c->node].op == EXPR_LEAF)
        return walk_hold(w, c->node);
    walk_pending(w, c->node)->held += c->rule == CLASS_ALL ? c->members : 1;
    return false;
}

bool evaluate_set(const struct expr *e, const struct sharing *s, const struct member *set,
                  uint32_t count)
{
    struct pending local[PENDING_LOCAL];
    struct walk w = {.e = e, .stack = local};
    if (count > PENDING_LOCAL)
        w.stack = mem_alloc(count * sizeof *w.stack);
    bool solid = false;
    for (uint32_t i = 0; i < count && !solid; i++) {
        const struct value_class *c = &s->classes[set[i].class_id];
        solid = walk_decide(&w, c->node) || walk_member(&w, c, set[i].count);
    }
    solid = solid || walk_decide(&w, EXPR_NONE);
    if (w.stack != local)
        free(w.stack);
    return solid;
}
