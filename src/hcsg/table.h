// table.h - the hash table of combinations: the paper's, after the coherent parallel hashing of
// Garcia, Lefebvre, Hornus and Lasram 2011.
//
// Open addressing with Robin Hood insertion. A record is 64 bits; read as two 32-bit words, low
// first, it is what a shader sees:
//   word 0   bits 0-31   primary key
//   word 1   bits 0-22   secondary key
//            bits 23-26  age: probe at which this record is found, counted from 1; 0: no record
//            bits 27-30  max age: probes needed for any key whose first place is here
//            bit  31     solid
// Probe i (from 0) of a key is (h + i * (TABLE_STEP + (h << 12 >> 3))) >> shift in 32-bit
// arithmetic, where h = (p ^ p >> 15) * TABLE_MULTIPLIER and p is the primary key. The secondary
// key takes no part, so it can be renewed in place.
//
// Lookups need no lock: records are single atomic words, so a reader sees a record whole or, while
// it moves, not at all. Writers need one.
#pragma once
#include "hcsg/values.h"

#include <stdalign.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#define TABLE_MULTIPLIER 0x85ebca6bu
#define TABLE_STEP       0x9e3779b9u

enum {
    TABLE_AGE_SHIFT = VALUE_BITS,
    TABLE_AGE_BITS = 4,
    TABLE_AGE_MOST = (1 << TABLE_AGE_BITS) - 1,
    TABLE_MAX_AGE_SHIFT = TABLE_AGE_SHIFT + TABLE_AGE_BITS,
    TABLE_SOLID_SHIFT = 63,
    TABLE_BITS_FIRST = 7, // 1 KB
    TABLE_BITS_MOST = 30,
    TABLE_BLOCK_BITS = 5, // of places whose changes are told together: 256 bytes
};

struct table {
    uint32_t shift; // 32 - bits, bits being the logarithm of the number of places
    uint32_t bits;
    alignas(64) uint32_t count; // records
    const unsigned char **sets; // the mirror: per place the set behind the record
    // For those who keep copies of the records: the owner counts `version` up before it writes.
    uint64_t version, born; // of writes to come; of the first ones
    uint64_t *written;      // per block of places: version of the last write
    alignas(64) _Atomic uint64_t records[];
};

static inline uint32_t table_hash(uint64_t key) // of probe 0
{
    uint32_t p = (uint32_t)key;
    return (p ^ p >> 15) * TABLE_MULTIPLIER;
}

static inline uint32_t table_step(uint32_t hash) // what each further probe adds
{
    return TABLE_STEP + (hash << 12 >> 3);
}

static inline uint32_t table_age(uint64_t record)
{
    return record >> TABLE_AGE_SHIFT & TABLE_AGE_MOST;
}

static inline uint32_t table_max_age(uint64_t record)
{
    return record >> TABLE_MAX_AGE_SHIFT & TABLE_AGE_MOST;
}

static inline bool table_matches(uint64_t record, uint64_t key) // key within VALUE_MASK, not 0
{
    return (record ^ key) << (64 - VALUE_BITS) == 0;
}

// The record of a key, or 0. The key is within VALUE_MASK and not 0.
static inline uint64_t table_find(const struct table *t, uint64_t key)
{
    uint32_t h = table_hash(key);
    uint64_t record = atomic_load_explicit(&t->records[h >> t->shift], memory_order_relaxed);
    if (table_matches(record, key))
        return record;
    uint32_t step = table_step(h);
    for (uint32_t probes = table_max_age(record); probes > 1; probes--) {
        h += step;
        record = atomic_load_explicit(&t->records[h >> t->shift], memory_order_relaxed);
        if (table_matches(record, key))
            return record;
    }
    return 0;
}

static inline uint32_t table_capacity(const struct table *t)
{
    return (uint32_t)1 << t->bits;
}

static inline uint32_t table_blocks(const struct table *t)
{
    return table_capacity(t) >> TABLE_BLOCK_BITS;
}

// `bits` from TABLE_BITS_FIRST; the records count as written with that version.
struct table *table_new(uint32_t bits, uint64_t version);
void table_delete(struct table *t); // accepts NULL
size_t table_bytes(const struct table *t);

// Puts a key in that is not there. False, with all records as they were, when some record would
// need more than TABLE_AGE_MOST probes.
bool table_insert(struct table *t, uint64_t key, bool solid, const unsigned char *set);

// Puts a key in that is not there. Returns `t`, or, when it would be 80 % full or the key found no
// place, a new table with all of it, at 40 %; then `t` is left as it was for readers. *stored is
// false when that does not help: more than TABLE_AGE_MOST keys with one primary key.
struct table *table_add(struct table *t, uint64_t key, bool solid, const unsigned char *set,
                        bool *stored);

// The place of a key that is there: for it only, the search has no other end.
uint32_t table_place(const struct table *t, uint64_t key);

// Gives the record in a place another secondary key.
void table_renew(struct table *t, uint32_t place, uint64_t key);
