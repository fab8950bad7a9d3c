// discovery.h - is the set of solids around an interval solid? Known keys in constant time, others
// evaluated once and remembered.
//
// A combination key is the sum of the values of the classes of all leaves around an interval,
// modulo 2^64; its low 55 bits count (values.h, also on how rarely two sets have one key). Known
// keys are in the table of table.h.
#pragma once
#include "hcsg/evaluate.h"
#include "hcsg/table.h"

struct discovery { // what lookups read; the rest follows in discovery.c
    _Atomic(struct table *) table;
};

struct discovery *discovery_new(const struct expr *e, const struct sharing *s); // borrows both
void discovery_delete(struct discovery *d);                                     // accepts NULL

enum { SET_EMPTY = 0, SET_SOLID = 1, SET_UNKNOWN = 2 };

// Constant-time lookup. Safe while another thread is in discovery_resolve: a key that is just being
// moved may read as unknown, never as wrong.
static inline int discovery_lookup(const struct discovery *d, uint64_t key)
{
    key &= VALUE_MASK;
    if (key == 0)
        return SET_EMPTY;
    const struct table *t = atomic_load_explicit(&d->table, memory_order_acquire);
    uint64_t record = table_find(t, key);
    return record ? (int)(record >> TABLE_SOLID_SHIFT) : SET_UNKNOWN;
}

// Evaluates the set (sorted by class, counts above zero) and returns SET_EMPTY or SET_SOLID: always
// the truth about the set. Remembers it under its key, unless that is known or another thread is
// just remembering a set. Thread-safe.
int discovery_resolve(struct discovery *d, uint64_t key, const struct member *set, uint32_t count);

// Leaves of a class come (by > 0) or go.
struct class_step {
    uint32_t class_id;
    int32_t by;
};

// Makes known what lies `count` steps from the combination of key `from`, whose key is `key`. For
// devices that see keys alone: the set behind a known key is in the table's mirror. False when
// `from` is not known, or when the steps do not lead to `key`. Thread-safe.
bool discovery_extend(struct discovery *d, uint64_t from, const struct class_step *steps,
                      uint32_t count, uint64_t key);

// Brings the stored keys in line with the values of the classes after values_renew. Keys summed
// before are meaningless afterwards. Not while another thread uses `d`.
void discovery_renew(struct discovery *d);
uint64_t discovery_renewals(struct discovery *d); // how often that was

// Makes known what `from` knows of sets all of whose classes are here: image[class of `from`] is
// its number here, EXPR_NONE for one that is not, and has the same value (sharing_inherit). The
// sets are evaluated anew; image NULL: the expressions are the same (sharing_equal), so answers
// hold as they are. Nothing comes over of a table with more than DISCOVERY_INHERITED combinations:
// most of them may have been left behind by edits. `from` may be in use meanwhile.
enum { DISCOVERY_INHERITED = 1 << 18 };
void discovery_inherit(struct discovery *d, struct discovery *from, const uint32_t *image);

// Two numbers for those who keep copies of the table: no two objects have the first in common; the
// second changes whenever the table does.
uint64_t discovery_identity(struct discovery *d);
uint64_t discovery_version(struct discovery *d);

// Tells each combination that is known: sorted by class. Thread-safe; `tell` must not come back
// here.
void discovery_each(struct discovery *d,
                    void (*tell)(void *context, const struct member *set, uint32_t count),
                    void *context);

struct discovery_stats {
    uint32_t combinations, capacity; // records and places
    double average_age, max_age;     // probes that a hit takes, counted from 1
    uint32_t rebuilds;
    size_t bytes; // table, mirror and sets
};
struct discovery_stats discovery_stats(struct discovery *d);

// Forgets all combinations. Not while another thread uses `d`.
void discovery_clear(struct discovery *d);

// Frees the tables that growth left behind for readers; until then they take less room than the
// table itself. Not while another thread uses `d`: between two frames, say.
void discovery_settle(struct discovery *d);
