// discovery.h - is the set of solids around an interval solid? Known keys in constant time, others
// evaluated once and remembered.
//
// A combination key is the sum of the values of the classes of all leaves around an interval, modulo
// 2^64. A value is 55 random bits: the low 32 are the paper's primary value, distinct and non-zero, the
// high 23 its secondary value. Keys are looked up by their low 55 bits in the table of table.h.
#pragma once
#include "hcsg/share.h"

struct member { // of a combination: count leaves of one class hold the interval
    uint32_t class_id, count;
};

struct discovery;

struct discovery *discovery_new(const struct expr *e, const struct sharing *s); // borrows both
void discovery_delete(struct discovery *d);                                    // accepts NULL

enum { SET_EMPTY = 0, SET_SOLID = 1, SET_UNKNOWN = 2 };

// Constant-time lookup. Safe while another thread is in discovery_resolve: a key that is just being
// moved may read as unknown, never as wrong.
int discovery_lookup(const struct discovery *d, uint64_t key);

// Evaluates the set (sorted by class, counts above zero) if the key is unknown, remembers it, and returns
// SET_EMPTY or SET_SOLID. Thread-safe.
int discovery_resolve(struct discovery *d, uint64_t key, const struct member *set, uint32_t count);

struct discovery_stats {
    uint32_t combinations, capacity; // records and places
    double average_age, max_age;     // probes that a hit takes, counted from 1
    uint32_t rebuilds;
    size_t bytes; // table, mirror and sets
};
struct discovery_stats discovery_stats(const struct discovery *d);
void discovery_clear(struct discovery *d); // forgets all combinations (for the bench)
