// products.c - an expression as a sum of products, in the order in which OpenSCAD draws them.
//
// A node that stands under an even number of subtractions gives a list of alternatives: products
// whose sum it is. One under an odd number gives those of its complement: x - node is the sum of x
// times each of them. A union's alternatives are those of its children, an intersection's all
// choices of one from each; in complements it is the other way round.
#include "hcsg/products.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

struct factor {
    uint32_t leaf;
    bool cut;
};

struct alternative {
    uint32_t first, count; // in the pool of factors
    struct box box;        // overlap of what is intersected
};

struct range { // of alternatives
    uint32_t first, count;
};

struct operand {
    uint32_t node;
    uint32_t leaf; // its first one
};

struct builder {
    const struct expr *e;
    uint32_t node; // whose products are wanted
    const struct box *leaf_box;
    uint32_t most;
    uint32_t from;      // the first node of the subtree
    struct range *done; // per node of the subtree
    bool *cut;          // per node of the subtree: under an odd number of subtractions
    struct factor *factors;
    uint32_t factor_count, factor_room;
    struct alternative *alternatives;
    uint32_t alternative_count, alternative_room;
    struct operand *operands; // of the node in work
    uint32_t operand_count, operand_room;
};

static bool add_alternative(struct builder *b, struct alternative a)
{
    if (b->alternative_count >= b->most || b->factor_count > b->most)
        return false;
    array_reserve(&b->alternatives, &b->alternative_room, (size_t)b->alternative_count + 1);
    b->alternatives[b->alternative_count++] = a;
    return true;
}

// Appends the factors of an alternative that matter in a box to those of the newest product.
static void append(struct builder *b, struct alternative a, struct box box)
{
    array_reserve(&b->factors, &b->factor_room, (size_t)b->factor_count + a.count);
    for (uint32_t i = 0; i < a.count; i++) {
        struct factor f = b->factors[a.first + i];
        if (!f.cut || !box_is_empty(box_intersection(box, b->leaf_box[f.leaf])))
            b->factors[b->factor_count++] = f;
    }
}

// All products of one of `left` and one of `right`.
static bool multiply(struct builder *b, struct range left, struct range right, struct range *out)
{
    *out = (struct range){b->alternative_count, 0};
    for (uint32_t r = 0; r < right.count; r++)
        for (uint32_t l = 0; l < left.count; l++) {
            struct alternative x = b->alternatives[left.first + l];
            struct alternative y = b->alternatives[right.first + r];
            struct alternative a = {.first = b->factor_count,
                                    .box = box_intersection(x.box, y.box)};
            if (box_is_empty(a.box))
                continue;
            append(b, x, a.box);
            append(b, y, a.box);
            a.count = b->factor_count - a.first;
            if (!add_alternative(b, a))
                return false;
        }
    out->count = b->alternative_count - out->first;
    return true;
}

static bool add(struct builder *b, struct range operand)
{
    for (uint32_t i = 0; i < operand.count; i++)
        if (!add_alternative(b, b->alternatives[operand.first + i]))
            return false;
    return true;
}

static bool leaf_alternatives(struct builder *b, uint32_t n)
{
    struct factor f = {b->e->nodes[n].leaf, b->cut[n - b->from]};
    b->done[n - b->from] = (struct range){b->alternative_count, 1};
    array_reserve(&b->factors, &b->factor_room, (size_t)b->factor_count + 1);
    b->factors[b->factor_count++] = f;
    return add_alternative(b, (struct alternative){.first = b->factor_count - 1,
                                                   .count = 1,
                                                   .box = f.cut ? BOX_ALL : b->leaf_box[f.leaf]});
}

static int by_place(const void *a, const void *b)
{
    const struct operand *l = a, *r = b;
    return (l->leaf > r->leaf) - (l->leaf < r->leaf);
}

static void add_operands(struct builder *b, const uint32_t *nodes, uint32_t count)
{
    array_reserve(&b->operands, &b->operand_room, (size_t)b->operand_count + count);
    for (uint32_t i = 0; i < count; i++)
        b->operands[b->operand_count++] =
            (struct operand){nodes[i], b->e->nodes[expr_first(b->e, nodes[i])].leaf};
}

// What is subtracted from an intersection is several operands of it.
static bool is_many_subtrahends(const struct expr *e, uint32_t n)
{
    return e->nodes[n].op == EXPR_UNION && e->nodes[n].parent != EXPR_NONE &&
           e->nodes[e->nodes[n].parent].minus == n;
}

// The operands of a node, what it subtracts among them, in the order of the file: the normal form
// has lost what stood between which operands.
static void find_operands(struct builder *b, const struct expr_node *node)
{
    const struct expr *e = b->e;
    b->operand_count = 0;
    add_operands(b, e->kids + node->first, node->count);
    if (node->minus == EXPR_NONE)
        return;
    if (is_many_subtrahends(e, node->minus))
        add_operands(b, e->kids + e->nodes[node->minus].first, e->nodes[node->minus].count);
    else
        add_operands(b, &node->minus, 1);
    qsort(b->operands, b->operand_count, sizeof *b->operands, by_place);
}

static bool node_alternatives(struct builder *b, uint32_t n)
{
    const struct expr_node *node = &b->e->nodes[n];
    if (node->op == EXPR_LEAF)
        return leaf_alternatives(b, n);
    if (is_many_subtrahends(b->e, n) && n != b->node)
        return true;
    bool sum = (node->op == EXPR_UNION) != b->cut[n - b->from];
    find_operands(b, node);
    struct range result = {b->alternative_count, 0};
    for (uint32_t k = 0; k < b->operand_count; k++) {
        struct range operand = b->done[b->operands[k].node - b->from];
        if (sum ? !add(b, operand) : k > 0 && !multiply(b, result, operand, &result))
            return false;
        if (!sum && k == 0)
            result = operand;
    }
    if (sum)
        result.count = b->alternative_count - result.first;
    b->done[n - b->from] = result;
    return true;
}

static void take(struct products *out, const struct builder *b, struct range range)
{
    size_t leaves = 0;
    for (uint32_t i = 0; i < range.count; i++)
        leaves += b->alternatives[range.first + i].count;
    *out = (struct products){.items = mem_alloc((range.count + 1) * sizeof *out->items),
                             .count = range.count,
                             .leaves = mem_alloc((leaves + 1) * sizeof *out->leaves)};
    uint32_t at = 0;
    for (uint32_t i = 0; i < range.count; i++) {
        struct alternative a = b->alternatives[range.first + i];
        struct product *p = &out->items[i];
        *p = (struct product){.first = at};
        for (uint32_t k = 0; k < a.count; k++)
            if (!b->factors[a.first + k].cut)
                out->leaves[at + p->added++] = b->factors[a.first + k].leaf;
        at += p->added;
        for (uint32_t k = 0; k < a.count; k++)
            if (b->factors[a.first + k].cut)
                out->leaves[at + p->cut++] = b->factors[a.first + k].leaf;
        at += p->cut;
    }
}

bool products_build(struct products *out, const struct expr *e, uint32_t node,
                    const struct box *leaf_box, uint32_t most)
{
    struct builder b = {
        .e = e, .node = node, .leaf_box = leaf_box, .most = most, .from = expr_first(e, node)};
    uint32_t count = node - b.from + 1;
    b.done = mem_alloc(count * sizeof *b.done);
    b.cut = mem_zalloc(count * sizeof *b.cut);
    for (uint32_t n = node; n > b.from; n--) { // parents before their children
        const struct expr_node *up = &e->nodes[e->nodes[n - 1].parent];
        b.cut[n - 1 - b.from] = b.cut[e->nodes[n - 1].parent - b.from] != (up->minus == n - 1);
    }
    bool fits = true;
    for (uint32_t n = b.from; n <= node && fits; n++)
        fits = node_alternatives(&b, n);
    if (fits)
        take(out, &b, b.done[node - b.from]);
    free(b.done);
    free(b.cut);
    free(b.factors);
    free(b.operands);
    free(b.alternatives);
    return fits;
}

void products_free(struct products *p)
{
    free(p->items);
    free(p->leaves);
    *p = (struct products){0};
}
