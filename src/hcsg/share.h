// share.h - value classes: which leaves share one primary value.
//
// Leaves that are direct children of one union, or convex leaves that are direct children of one
// intersection, need no values of their own: the number of them around a point decides (section 5.1
// of Zanni, Claux, Lefebvre 2018). A union class holds when its count is above zero, an
// intersection class when its count equals the number of members; the latter only counts leaves
// that cannot count themselves twice along a ray, so other leaves of an intersection get a class of
// their own.
#pragma once
#include "hcsg/expr.h"

enum class_rule { CLASS_ANY, CLASS_ALL };

struct value_class {
    enum class_rule rule;
    uint32_t node;    // CLASS_ANY of several leaves: their union; CLASS_ALL: their intersection;
                      // one leaf alone: the leaf's own node
    uint32_t members; // number of leaves
    uint64_t value;   // see values.h
};

struct sharing {             // {0} is valid
    uint32_t *class_of_leaf; // EXPR_NONE for dropped leaves
    struct value_class *classes;
    uint32_t class_count;
};

// convex[leaf]: the leaf cannot count itself twice. share = false gives each leaf its own class
// (the bench measures what sharing brings).
void sharing_build(struct sharing *out, const struct expr *e, const bool *convex, bool share);
// Gives classes the values they had in `before`. counterpart[leaf] is the number that the leaf had
// there, EXPR_NONE for a new one. A class is still the same when all its leaves that were there
// come from one class, all of whose leaves that still matter are in it. image[class of `before`]
// becomes its number now, EXPR_NONE when it is no more. Not once keys were summed.
void sharing_inherit(struct sharing *s, uint32_t leaf_count, const struct sharing *before,
                     const uint32_t *counterpart, uint32_t *image);
// Are the classes and what is asked of them the same, so that evaluate_set is the same function?
// The leaves behind them may differ.
bool sharing_equal(const struct sharing *s, const struct expr *e, const struct sharing *other,
                   const struct expr *other_e);
// The expression over classes in place of leaves, for the array method (bench): the members of a
// class stand in one node, where its first one stands.
void sharing_expr(struct expr *out, const struct expr *e, const struct sharing *s);
void sharing_free(struct sharing *s); // leaves {0}
