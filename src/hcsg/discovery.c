// discovery.c - combinations met so far, and how new ones come in.
#include "hcsg/discovery.h"

#include "base/clock.h"
#include "base/hash.h"
#include "base/mem.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    MEMBER_BYTES_MOST = 10, // packed
    PACKED_LOCAL = 64,      // members of a set that is packed without allocating
};

struct combinations {
    struct discovery hot;             // first, so that a pointer to it is a pointer to all
    alignas(64) pthread_mutex_t lock; // held by whoever changes anything here
    const struct expr *expr;
    const struct sharing *sharing;
    struct table *retired[TABLE_BITS_MOST]; // a reader may still be in one
    uint32_t retired_count;
    uint32_t rebuilds;
    uint64_t identity, version, renewals;
    struct arena sets;
};

static struct combinations *whole(struct discovery *d)
{
    return (struct combinations *)d;
}

static struct table *current(struct combinations *c)
{
    return atomic_load_explicit(&c->hot.table, memory_order_relaxed);
}

struct discovery *discovery_new(const struct expr *e, const struct sharing *s)
{
    struct combinations *c = mem_aligned(alignof(struct combinations), sizeof *c);
    *c = (struct combinations){.expr = e, .sharing = s};
    // Never two at one place at one time.
    c->identity = hash_mix((uint64_t)(clock_seconds() * 1e9) ^ hash_mix((uintptr_t)c));
    pthread_mutex_init(&c->lock, NULL);
    atomic_init(&c->hot.table, table_new(TABLE_BITS_FIRST, 0));
    return &c->hot;
}

void discovery_settle(struct discovery *d)
{
    struct combinations *c = whole(d);
    for (uint32_t i = 0; i < c->retired_count; i++)
        table_delete(c->retired[i]);
    c->retired_count = 0;
}

void discovery_delete(struct discovery *d)
{
    if (!d)
        return;
    struct combinations *c = whole(d);
    discovery_settle(d);
    table_delete(current(c));
    arena_free(&c->sets);
    pthread_mutex_destroy(&c->lock);
    free(c);
}

void discovery_clear(struct discovery *d)
{
    struct combinations *c = whole(d);
    discovery_settle(d);
    table_delete(current(c));
    arena_free(&c->sets);
    c->rebuilds = 0;
    c->version++;
    atomic_store_explicit(&d->table, table_new(TABLE_BITS_FIRST, c->version), memory_order_release);
}

// A stored set is the number of its members, then for each the distance to the class before,
// doubled, plus one when its count is not 1 and follows. Numbers are in base 128, low digits first,
// the high bit of a byte saying that more come: a member mostly takes one byte.

static unsigned char *write_number(unsigned char *p, uint64_t n)
{
    for (; n >= 128; n >>= 7)
        *p++ = (unsigned char)(n | 128);
    *p++ = (unsigned char)n;
    return p;
}

static uint64_t read_number(const unsigned char **p)
{
    uint64_t n = 0;
    for (unsigned shift = 0;; shift += 7) {
        unsigned char byte = *(*p)++;
        n |= (uint64_t)(byte & 127) << shift;
        if (byte < 128)
            return n;
    }
}

static unsigned char *write_set(unsigned char *p, const struct member *set, uint32_t count)
{
    uint32_t before = 0;
    p = write_number(p, count);
    for (uint32_t i = 0; i < count; i++) {
        bool many = set[i].count != 1;
        p = write_number(p, (uint64_t)(set[i].class_id - before) << 1 | many);
        if (many)
            p = write_number(p, set[i].count);
        before = set[i].class_id;
    }
    return p;
}

static const unsigned char *keep_set(struct combinations *c, const struct member *set,
                                     uint32_t count)
{
    unsigned char local[(PACKED_LOCAL + 1) * MEMBER_BYTES_MOST], *packed = local;
    if (count > PACKED_LOCAL)
        packed = mem_alloc(((size_t)count + 1) * MEMBER_BYTES_MOST);
    size_t size = (size_t)(write_set(packed, set, count) - packed);
    const void *kept = memcpy(arena_alloc(&c->sets, size), packed, size);
    if (packed != local)
        free(packed);
    return kept;
}

static uint64_t key_of_set(const struct sharing *s, const unsigned char *set)
{
    uint64_t key = 0;
    uint64_t class_id = 0;
    for (uint64_t count = read_number(&set); count > 0; count--) {
        uint64_t n = read_number(&set);
        class_id += n >> 1;
        key += s->classes[class_id].value * (n & 1 ? read_number(&set) : 1);
    }
    return key & VALUE_MASK;
}

static void remember(struct combinations *c, uint64_t key, bool solid, const struct member *set,
                     uint32_t count)
{
    struct table *before = current(c);
    bool stored;
    before->version = ++c->version;
    struct table *t = table_add(before, key, solid, NULL, &stored);
    if (stored)
        t->sets[table_place(t, key)] = keep_set(c, set, count);
    if (t != before) {
        c->retired[c->retired_count++] = before;
        c->rebuilds++;
        atomic_store_explicit(&c->hot.table, t, memory_order_release);
    }
}

int discovery_resolve(struct discovery *d, uint64_t key, const struct member *set, uint32_t count)
{
    struct combinations *c = whole(d);
    bool solid = evaluate_set(c->expr, c->sharing, set, count);
    key &= VALUE_MASK;
    // Whoever would have to wait evaluates the same set once more when it comes again: cheaper than
    // to sleep, and nobody stands still while the table grows.
    if (key != 0 && pthread_mutex_trylock(&c->lock) == 0) {
        if (!table_find(current(c), key))
            remember(c, key, solid, set, count);
        pthread_mutex_unlock(&c->lock);
    }
    return solid ? SET_SOLID : SET_EMPTY;
}

// The members of a stored set, whose number is `count`; *set stands behind that number.
static void read_members(const unsigned char *set, struct member *members, uint32_t count)
{
    uint64_t class_id = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint64_t n = read_number(&set);
        class_id += n >> 1;
        members[i] = (struct member){(uint32_t)class_id, n & 1 ? (uint32_t)read_number(&set) : 1};
    }
}

// The members of a known combination and room for `more` of them; the caller frees. NULL when the
// key is not known.
static struct member *members_of(struct combinations *c, uint64_t key, uint32_t more,
                                 uint32_t *count)
{
    struct member *members = NULL;
    *count = 0;
    pthread_mutex_lock(&c->lock);
    const struct table *t = current(c);
    if (key == 0) {
        members = mem_alloc((more + 1) * sizeof *members);
    } else if (table_find(t, key)) {
        const unsigned char *set = t->sets[table_place(t, key)];
        *count = (uint32_t)read_number(&set);
        members = mem_alloc(((size_t)*count + more + 1) * sizeof *members);
        read_members(set, members, *count);
    }
    pthread_mutex_unlock(&c->lock);
    return members;
}

bool discovery_extend(struct discovery *d, uint64_t from, const struct class_step *steps,
                      uint32_t count, uint64_t key)
{
    struct combinations *c = whole(d);
    uint64_t sum = from;
    uint32_t known;
    for (uint32_t i = 0; i < count; i++)
        sum += c->sharing->classes[steps[i].class_id].value * (uint64_t)(int64_t)steps[i].by;
    if (((sum ^ key) & VALUE_MASK) != 0)
        return false;
    struct member *members = members_of(c, from & VALUE_MASK, count, &known);
    if (!members)
        return false;
    for (uint32_t i = 0; i < count; i++)
        members[known + i] = (struct member){steps[i].class_id, (uint32_t)steps[i].by};
    discovery_resolve(d, key, members, members_settle(members, known + count));
    free(members);
    return true;
}

// A record of another table, with the set behind it; `room` holds its members.
static void inherit(struct combinations *c, uint64_t record, const unsigned char *set,
                    const uint32_t *image, struct member **room, uint32_t *capacity)
{
    uint32_t count = (uint32_t)read_number(&set);
    uint64_t key = 0;
    bool solid = record >> TABLE_SOLID_SHIFT;
    array_reserve(room, capacity, count);
    struct member *members = *room;
    read_members(set, members, count);
    for (uint32_t i = 0; i < count && image; i++) {
        members[i].class_id = image[members[i].class_id];
        if (members[i].class_id == EXPR_NONE)
            return;
    }
    for (uint32_t i = 0; i < count; i++)
        key += c->sharing->classes[members[i].class_id].value * members[i].count;
    key &= VALUE_MASK;
    if (image) {
        count = members_settle(members, count);
        solid = evaluate_set(c->expr, c->sharing, members, count);
    }
    if (key != 0 && !table_find(current(c), key))
        remember(c, key, solid, members, count);
}

void discovery_inherit(struct discovery *d, struct discovery *from, const uint32_t *image)
{
    struct combinations *c = whole(d), *old = whole(from);
    struct member *room = NULL;
    uint32_t capacity = 0;
    pthread_mutex_lock(&old->lock);
    const struct table *t = current(old);
    if (t->count > 0 && t->count <= DISCOVERY_INHERITED) {
        discovery_settle(d);
        table_delete(current(c));
        atomic_store_explicit(&d->table, table_new(t->bits, ++c->version), memory_order_release);
        for (uint32_t i = 0; i < table_capacity(t); i++) {
            uint64_t record = atomic_load_explicit(&t->records[i], memory_order_relaxed);
            if (table_age(record))
                inherit(c, record, t->sets[i], image, &room, &capacity);
        }
    }
    pthread_mutex_unlock(&old->lock);
    free(room);
}

void discovery_renew(struct discovery *d)
{
    struct combinations *c = whole(d);
    struct table *t = current(c);
    discovery_settle(d);
    t->version = ++c->version;
    c->renewals++;
    for (uint32_t i = 0; i < table_capacity(t); i++)
        if (t->sets[i])
            table_renew(t, i, key_of_set(c->sharing, t->sets[i]));
}

uint64_t discovery_renewals(struct discovery *d)
{
    return whole(d)->renewals;
}

uint64_t discovery_identity(struct discovery *d)
{
    return whole(d)->identity;
}

uint64_t discovery_version(struct discovery *d)
{
    struct combinations *c = whole(d);
    pthread_mutex_lock(&c->lock);
    uint64_t version = c->version;
    pthread_mutex_unlock(&c->lock);
    return version;
}

void discovery_each(struct discovery *d,
                    void (*tell)(void *context, const struct member *set, uint32_t count),
                    void *context)
{
    struct combinations *c = whole(d);
    struct member *members = NULL;
    uint32_t room = 0;
    pthread_mutex_lock(&c->lock);
    const struct table *t = current(c);
    for (uint32_t i = 0; i < table_capacity(t); i++) {
        if (!table_age(atomic_load_explicit(&t->records[i], memory_order_relaxed)))
            continue;
        const unsigned char *set = t->sets[i];
        uint32_t count = (uint32_t)read_number(&set);
        array_reserve(&members, &room, count);
        read_members(set, members, count);
        tell(context, members, count);
    }
    pthread_mutex_unlock(&c->lock);
    free(members);
}

struct discovery_stats discovery_stats(struct discovery *d)
{
    struct combinations *c = whole(d);
    pthread_mutex_lock(&c->lock);
    const struct table *t = current(c);
    struct discovery_stats s = {.combinations = t->count,
                                .capacity = table_capacity(t),
                                .rebuilds = c->rebuilds,
                                .bytes = sizeof *c + table_bytes(t) + c->sets.total};
    for (uint32_t i = 0; i < c->retired_count; i++)
        s.bytes += table_bytes(c->retired[i]);
    uint64_t ages = 0;
    for (uint32_t i = 0; i < s.capacity; i++) {
        uint32_t age = table_age(atomic_load_explicit(&t->records[i], memory_order_relaxed));
        ages += age;
        s.max_age = age > s.max_age ? age : s.max_age;
    }
    s.average_age = s.combinations ? (double)ages / s.combinations : 0;
    pthread_mutex_unlock(&c->lock);
    return s;
}
