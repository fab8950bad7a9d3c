// values.h - random values of the classes, whose sums are the combination keys.
//
// A value is 55 random bits: the low 32 are the paper's primary value, distinct and non-zero, the
// high 23 its secondary value. A key is the sum of the values of all classes around an interval,
// each times its count, modulo 2^55, so the low 32 bits of a key are the primary key and do not
// depend on any secondary value. No count below 2^24 of one class has the key 0 or the key of
// another such count.
//
// Two different sets have equal keys with probability 2^-55, so of n sets seen some two do with
// probability n^2 / 2^56 at most: 1.4e-5 for a million sets, 1.4e-9 for ten thousand.
#pragma once
#include <stdint.h>

struct value_class;

#define VALUE_BITS         55
#define VALUE_PRIMARY_BITS 32
#define VALUE_MASK         (((uint64_t)1 << VALUE_BITS) - 1)

// Gives each class its value; the same seed gives the same values.
void values_fill(struct value_class *classes, uint32_t count, uint64_t seed);
// The same for classes whose value is 0 alone; the others keep theirs.
void values_fill_rest(struct value_class *classes, uint32_t count, uint64_t seed);

// Gives each class another secondary value: an ambiguity of one frame is gone in the next one.
// `state` is a stream of random_next. Tables must be told: discovery_renew.
void values_renew(struct value_class *classes, uint32_t count, uint64_t *state);
