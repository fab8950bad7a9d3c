// unit.h - cmocka, and random expressions with an evaluation that knows no normal form.
#pragma once
#include "base/hash.h"
#include "base/mem.h"
#include "hcsg/expr.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct postfix {
    struct expr_token *tokens;
    uint32_t count, capacity;
};

static inline void postfix_push(struct postfix *p, enum expr_op op, uint32_t arg)
{
    array_reserve(&p->tokens, &p->capacity, (size_t)p->count + 1);
    p->tokens[p->count++] = (struct expr_token){op, arg};
}

static inline uint32_t random_below(uint64_t *state, uint32_t n)
{
    return (uint32_t)((random_next(state) >> 32) * n >> 32);
}

// A random expression in which each leaf below leaf_count stands once, the leaves in order, with
// nodes of zero to five operands.
static inline struct postfix postfix_random(uint64_t *state, uint32_t leaf_count)
{
    struct postfix p = {0};
    uint32_t open = 0, next = 0; // operands on the stack, leaves used
    while (next < leaf_count || open != 1) {
        uint32_t choice = random_below(state, 8);
        if (next < leaf_count && choice < 4) {
            postfix_push(&p, EXPR_LEAF, next++);
            open++;
            continue;
        }
        uint32_t operands = random_below(state, 6);
        if (operands == 0 && random_below(state, 8))
            continue;
        if (operands > open)
            operands = open;
        enum expr_op op = EXPR_UNION + (enum expr_op)random_below(state, 3);
        postfix_push(&p, op, operands);
        open += 1 - operands;
    }
    return p;
}

static inline bool postfix_evaluate(const struct postfix *p, const bool *inside)
{
    bool *stack = mem_alloc((size_t)p->count + 1);
    uint32_t depth = 0;
    stack[0] = false;
    for (uint32_t i = 0; i < p->count; i++) {
        struct expr_token t = p->tokens[i];
        if (t.op == EXPR_LEAF) {
            stack[depth++] = inside[t.arg];
            continue;
        }
        depth -= t.arg;
        bool any = false, all = t.arg > 0, rest = false;
        for (uint32_t k = 0; k < t.arg; k++) {
            any |= stack[depth + k];
            all &= stack[depth + k];
            rest |= k > 0 && stack[depth + k];
        }
        bool first = t.arg > 0 && stack[depth];
        stack[depth++] = t.op == EXPR_UNION          ? any
                         : t.op == EXPR_INTERSECTION ? all
                                                     : first && !rest;
    }
    bool result = stack[0];
    free(stack);
    return result;
}
