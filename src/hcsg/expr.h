// expr.h - the CSG expression over leaf numbers, in normal form.
//
// Two kinds of inner nodes. UNION has two or more children. INTERSECTION has one or more children
// and may subtract one node: A - B - C is INTERSECTION {A} minus UNION {B, C}. Normal form means:
// nested unions and nested intersections are one node, the subtrahends of an intersection are one
// union, a node without effect (a union or an intersection of one child) is that child, and the
// rules of the empty set are applied: x + 0 = x, x - 0 = x, 0 - x = 0, x * 0 = 0. Every leaf stands
// once or was dropped. `nodes` is in postorder: children come before their parents, what an
// intersection subtracts after its children, every subtree is a contiguous range, and the root is
// the last node.
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define EXPR_NONE UINT32_MAX

enum expr_op { EXPR_LEAF, EXPR_UNION, EXPR_INTERSECTION, EXPR_DIFFERENCE };

// What the caller gives: postfix order. LEAF pushes leaf number `arg`; the other three pop `arg`
// operands (0 operands push the empty set; DIFFERENCE is the first minus all others) and push the
// result.
struct expr_token {
    enum expr_op op;
    uint32_t arg;
};

struct expr_node {
    enum expr_op op;       // LEAF, UNION or INTERSECTION
    uint32_t parent;       // EXPR_NONE at the root
    uint32_t first, count; // children: expr.kids[first .. first + count), in the order of the file
    uint32_t minus;        // INTERSECTION: the subtracted node or EXPR_NONE
    uint32_t leaf;         // LEAF: leaf number
};

struct expr { // {0} is a valid empty expression
    struct expr_node *nodes;
    uint32_t node_count;
    uint32_t *kids;
    uint32_t kid_count;
    uint32_t root;       // EXPR_NONE: the empty set (also when node_count is 0)
    uint32_t *leaf_node; // per leaf: its node, EXPR_NONE when the leaf cannot matter
    uint32_t leaf_count;
};

// Never fails; any depth. `postfix` must leave exactly one operand, or be empty; each leaf number
// below leaf_count stands at most once. The caller frees with expr_free.
void expr_build(struct expr *out, const struct expr_token *postfix, size_t count,
                uint32_t leaf_count);
// The same expression without the leaves for which keep[leaf] is false (as if they were empty).
void expr_without(struct expr *out, const struct expr *e, const bool *keep);
void expr_free(struct expr *e); // leaves {0}

// The first node of the subtree of a node; the node itself is its last.
uint32_t expr_first(const struct expr *e, uint32_t node);
// The subtree of a node in postfix order, each leaf put through `number_of` (NULL: as it is,
// EXPR_NONE: the empty set). `out` has room for two tokens a node. Returns their number.
size_t expr_postfix(struct expr_token *out, const struct expr *e, uint32_t node,
                    const uint32_t *number_of);

// Plain evaluation for tests and small uses: inside[leaf] tells which leaves hold the point.
bool expr_evaluate(const struct expr *e, const bool *inside);
