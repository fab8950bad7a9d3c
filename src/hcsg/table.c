// table.c - building the hash table of combinations.
#include "hcsg/table.h"

#include "base/mem.h"

#include <stdlib.h>

enum {
    FULL_PERCENT = 80,
    SWAPS_MOST = 64,    // of one insertion; bounds the log that takes it back
    SPARSE_FACTOR = 16, // a table this many times too large does not grow to find a place
};

#define MAX_AGE_FIELD ((uint64_t)TABLE_AGE_MOST << TABLE_MAX_AGE_SHIFT)
#define AGE_FIELD     ((uint64_t)TABLE_AGE_MOST << TABLE_AGE_SHIFT)

static uint64_t get(const struct table *t, uint32_t place)
{
    return atomic_load_explicit(&t->records[place], memory_order_relaxed);
}

static void put(struct table *t, uint32_t place, uint64_t record)
{
    atomic_store_explicit(&t->records[place], record, memory_order_relaxed);
    t->written[place >> TABLE_BLOCK_BITS] = t->version;
}

struct table *table_new(uint32_t bits, uint64_t version)
{
    size_t capacity = (size_t)1 << bits;
    struct table *t = mem_aligned(64, sizeof *t + capacity * sizeof *t->records);
    t->shift = 32 - bits;
    t->bits = bits;
    t->count = 0;
    t->sets = mem_zalloc(capacity * sizeof *t->sets);
    t->version = t->born = version;
    t->written = mem_alloc(table_blocks(t) * sizeof *t->written);
    for (uint32_t i = 0; i < table_blocks(t); i++)
        t->written[i] = version;
    for (size_t i = 0; i < capacity; i++)
        atomic_init(&t->records[i], 0);
    return t;
}

void table_delete(struct table *t)
{
    if (!t)
        return;
    free(t->sets);
    free(t->written);
    free(t);
}

size_t table_bytes(const struct table *t)
{
    return sizeof *t + table_capacity(t) * (sizeof *t->records + sizeof *t->sets) +
           table_blocks(t) * sizeof *t->written;
}

struct item { // a record on its way to a place, without ages
    uint64_t record;
    const unsigned char *set;
};

struct swap {
    uint32_t place;
    struct item before;
    uint32_t age;
};

// Writes an item and its age into a place, whose max age stays.
static void place_item(struct table *t, uint32_t place, struct item item, uint32_t age)
{
    put(t, place, item.record | (uint64_t)age << TABLE_AGE_SHIFT | (get(t, place) & MAX_AGE_FIELD));
    t->sets[place] = item.set;
}

static void raise_max_age(struct table *t, uint64_t key, uint32_t age)
{
    uint32_t first = table_hash(key) >> t->shift;
    uint64_t record = get(t, first);
    if (table_max_age(record) < age)
        put(t, first, (record & ~MAX_AGE_FIELD) | (uint64_t)age << TABLE_MAX_AGE_SHIFT);
}

bool table_insert(struct table *t, uint64_t key, bool solid, const unsigned char *set)
{
    struct swap swaps[SWAPS_MOST];
    uint32_t swap_count = 0;
    struct item item = {key | (uint64_t)solid << TABLE_SOLID_SHIFT, set};
    uint32_t age = 1, h = table_hash(key), step = table_step(h);
    for (; age <= TABLE_AGE_MOST; age++, h += step) {
        uint32_t place = h >> t->shift;
        uint64_t there = get(t, place);
        uint32_t age_there = table_age(there);
        if (age_there >= age)
            continue;
        if (age_there && swap_count == SWAPS_MOST)
            break;
        struct item evicted = {there & ~(AGE_FIELD | MAX_AGE_FIELD), t->sets[place]};
        raise_max_age(t, item.record, age);
        place_item(t, place, item, age);
        if (age_there == 0) {
            t->count++;
            return true;
        }
        swaps[swap_count++] = (struct swap){place, evicted, age_there};
        item = evicted;
        age = age_there;
        h = table_hash(item.record);
        step = table_step(h);
        h += (age - 1) * step;
    }
    while (swap_count-- > 0)
        place_item(t, swaps[swap_count].place, swaps[swap_count].before, swaps[swap_count].age);
    return false;
}

// A larger table with all records of `t` that have a place in it; those without are counted.
static struct table *table_grown(const struct table *t, uint32_t bits, uint32_t *lost)
{
    struct table *larger = table_new(bits, t->version);
    *lost = 0;
    for (uint32_t i = 0; i < table_capacity(t); i++) {
        uint64_t record = get(t, i);
        if (table_age(record) &&
            !table_insert(larger, record & VALUE_MASK, record >> TABLE_SOLID_SHIFT, t->sets[i]))
            ++*lost;
    }
    return larger;
}

struct table *table_add(struct table *t, uint64_t key, bool solid, const unsigned char *set,
                        bool *stored)
{
    struct table *from = t;
    bool full = ((uint64_t)t->count + 1) * 100 > (uint64_t)table_capacity(t) * FULL_PERCENT;
    uint32_t lost = 0;
    *stored = !full && table_insert(t, key, solid, set);
    for (uint32_t bits = t->bits + 1; !*stored || lost > 0; bits++) {
        bool sparse = ((uint64_t)from->count + 1) * SPARSE_FACTOR < (uint64_t)1 << (bits - 1);
        if (sparse || bits > TABLE_BITS_MOST)
            break;
        struct table *larger = table_grown(from, bits, &lost);
        if (t != from)
            table_delete(t);
        t = larger;
        *stored = table_insert(t, key, solid, set);
    }
    return t;
}

uint32_t table_place(const struct table *t, uint64_t key)
{
    uint32_t h = table_hash(key), step = table_step(h);
    while (!table_matches(get(t, h >> t->shift), key))
        h += step;
    return h >> t->shift;
}

void table_renew(struct table *t, uint32_t place, uint64_t key)
{
    put(t, place, (get(t, place) & ~VALUE_MASK) | key);
}
