// products.c - a CSG expression as a union of products, as OpenCSG wants it.
#include "products.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

static bool boxes_meet(struct box a, struct box b)
{
    return !box_is_empty(box_intersection(a, b));
}

static void product_free(struct product *p)
{
    free(p->leaves);
    *p = (struct product){0};
}

static bool product_has(const struct product *p, uint32_t leaf, bool subtracted)
{
    uint32_t from = subtracted ? p->intersected : 0, to = subtracted ? p->count : p->intersected;
    for (uint32_t i = from; i < to; i++)
        if (p->leaves[i] == leaf)
            return true;
    return false;
}

static void product_subtract(struct product *p, uint32_t leaf)
{
    if (product_has(p, leaf, true))
        return;
    array_reserve(&p->leaves, &p->capacity, p->count + 1);
    p->leaves[p->count++] = leaf;
}

static void product_intersect(struct product *p, uint32_t leaf, struct box box)
{
    p->box = box_intersection(p->box, box);
    if (product_has(p, leaf, false))
        return;
    array_reserve(&p->leaves, &p->capacity, p->count + 1);
    memmove(p->leaves + p->intersected + 1, p->leaves + p->intersected,
            (p->count - p->intersected) * sizeof *p->leaves);
    p->leaves[p->intersected++] = leaf;
    p->count++;
}

static struct product product_copy(const struct product *p)
{
    struct product copy = {.box = p->box, .intersected = p->intersected};
    array_reserve(&copy.leaves, &copy.capacity, p->count + 1);
    memcpy(copy.leaves, p->leaves, p->count * sizeof *p->leaves);
    copy.count = p->count;
    return copy;
}

// Takes the product over.
static void products_add(struct products *sum, struct product *p)
{
    array_reserve(&sum->items, &sum->capacity, sum->count + 1);
    sum->items[sum->count++] = *p;
    *p = (struct product){0};
}

void products_free(struct products *p)
{
    for (uint32_t i = 0; i < p->count; i++)
        product_free(&p->items[i]);
    free(p->items);
    *p = (struct products){0};
}

// *a becomes a + b; takes b over.
static void unite(struct products *a, struct products *b)
{
    for (uint32_t i = 0; i < b->count; i++)
        products_add(a, &b->items[i]);
    products_free(b);
}

// *a becomes a * b, term by term; takes b over.
static void intersect(struct products *a, struct products *b, const struct box *leaf_box)
{
    struct products result = {0};
    for (uint32_t i = 0; i < a->count; i++) {
        for (uint32_t k = 0; k < b->count; k++) {
            const struct product *right = &b->items[k];
            if (!boxes_meet(a->items[i].box, right->box))
                continue;
            struct product p = product_copy(&a->items[i]);
            for (uint32_t n = 0; n < right->intersected; n++)
                product_intersect(&p, right->leaves[n], leaf_box[right->leaves[n]]);
            for (uint32_t n = right->intersected; n < right->count; n++)
                product_subtract(&p, right->leaves[n]);
            products_add(&result, &p);
        }
    }
    products_free(a);
    products_free(b);
    *a = result;
}

// Adds to `result` what p - cut is: p without each leaf that cut intersects, and p within each
// that cut subtracts. Takes p over.
static void subtract_product(struct products *result, struct product *p, const struct product *cut,
                             const struct box *leaf_box)
{
    if (!boxes_meet(p->box, cut->box)) {
        products_add(result, p);
        return;
    }
    for (uint32_t n = cut->intersected; n < cut->count; n++) {
        uint32_t leaf = cut->leaves[n];
        if (!boxes_meet(p->box, leaf_box[leaf]) || product_has(p, leaf, true))
            continue;
        struct product within = product_copy(p);
        product_intersect(&within, leaf, leaf_box[leaf]);
        products_add(result, &within);
    }
    for (uint32_t n = 0; n < cut->intersected; n++) {
        if (product_has(p, cut->leaves[n], false))
            continue;
        bool last = n + 1 == cut->intersected;
        struct product without = last ? *p : product_copy(p);
        if (last)
            *p = (struct product){0};
        product_subtract(&without, cut->leaves[n]);
        products_add(result, &without);
    }
    product_free(p);
}

// *a becomes a - b.
static void subtract(struct products *a, const struct products *b, const struct box *leaf_box)
{
    for (uint32_t k = 0; k < b->count; k++) {
        struct products result = {0};
        for (uint32_t i = 0; i < a->count; i++)
            subtract_product(&result, &a->items[i], &b->items[k], leaf_box);
        products_free(a);
        *a = result;
    }
}

// Products only get smaller on the way up, so that more can be left out at the end.
static void prune(struct products *sum, const struct box *leaf_box)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < sum->count; i++) {
        struct product *p = &sum->items[i];
        if (box_is_empty(p->box)) {
            product_free(p);
            continue;
        }
        uint32_t count = p->intersected;
        for (uint32_t n = p->intersected; n < p->count; n++)
            if (boxes_meet(p->box, leaf_box[p->leaves[n]]))
                p->leaves[count++] = p->leaves[n];
        p->count = count;
        sum->items[kept++] = *p;
    }
    sum->count = kept;
}

void products_build(struct products *out, const struct expr *e, const struct box *leaf_box)
{
    *out = (struct products){0};
    if (!e->node_count || e->root == EXPR_NONE)
        return;
    struct products *of = mem_zalloc(e->node_count * sizeof *of); // per node
    for (uint32_t n = 0; n < e->node_count; n++) {                // children come first
        const struct expr_node *node = &e->nodes[n];
        if (node->op == EXPR_LEAF) {
            struct product p = {.box = BOX_ALL};
            product_intersect(&p, node->leaf, leaf_box[node->leaf]);
            products_add(&of[n], &p);
            continue;
        }
        for (uint32_t k = 0; k < node->count; k++) {
            struct products *kid = &of[e->kids[node->first + k]];
            if (k == 0 || node->op == EXPR_UNION)
                unite(&of[n], kid);
            else
                intersect(&of[n], kid, leaf_box);
        }
        if (node->op == EXPR_INTERSECTION && node->minus != EXPR_NONE) {
            subtract(&of[n], &of[node->minus], leaf_box);
            products_free(&of[node->minus]);
        }
    }
    *out = of[e->root];
    free(of);
    prune(out, leaf_box);
}
