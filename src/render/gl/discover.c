// discover.c - the table of combinations on the device.
#include "render/gl/discover.h"

#include "base/mem.h"
#include "shaders/shared.h"

#include <stdlib.h>

enum {
    BLOCK_BYTES = sizeof(uint64_t) << TABLE_BLOCK_BITS,
    BLOCKS_SPARED = 3,    // so many blocks as they were go along: less work than another write
    PART_BYTES = 1 << 20, // of a write: drivers put little aside and go on
};

const struct gl_buffer *gl_table_records(const struct gl_table *t)
{
    return &t->records[t->current];
}

// Writes blocks [from, to).
static void write_blocks(struct gl_table *t, const struct table *table, uint32_t from, uint32_t to)
{
    const char *records = (const void *)table->records;
    size_t end = (size_t)to * BLOCK_BYTES;
    for (size_t at = (size_t)from * BLOCK_BYTES, step; at < end; at += step) {
        step = end - at < PART_BYTES ? end - at : PART_BYTES;
        gl_buffer_write(gl_table_records(t), at, records + at, step);
        t->uploaded += step;
    }
}

static void write_changes(struct gl_table *t, const struct table *table)
{
    uint32_t from = 0, to = 0; // to be written
    for (uint32_t i = 0; i < table_blocks(table); i++) {
        if (table->written[i] <= t->version)
            continue;
        if (!to || i - to > BLOCKS_SPARED) {
            write_blocks(t, table, from, to);
            from = i;
        }
        to = i + 1;
    }
    write_blocks(t, table, from, to);
}

bool gl_table_upload(struct gl_table *t, struct gl_memory *memory, struct discovery *d,
                     struct error *err)
{
    // Nobody writes now but this thread.
    const struct table *table = atomic_load_explicit(&d->table, memory_order_acquire);
    uint64_t version = discovery_version(d);
    if (gl_table_records(t)->id && t->born == table->born) {
        if (t->version != version)
            write_changes(t, table);
    } else {
        struct gl_buffer *other = &t->records[!t->current];
        size_t size = (size_t)table_blocks(table) * BLOCK_BYTES;
        if (!gl_buffer_grow(other, memory, "table", size, err))
            return false;
        t->current = !t->current;
        t->shift = table->shift;
        t->born = table->born;
        write_blocks(t, table, 0, table_blocks(table));
    }
    t->version = version;
    return true;
}

void gl_table_free(struct gl_table *t)
{
    gl_buffer_free(&t->records[0]);
    gl_buffer_free(&t->records[1]);
    *t = (struct gl_table){0};
}

// The combination that one record tells.
static bool discover_one(const struct body *body, const uint32_t *r, struct class_step *steps)
{
    const struct sharing *s = &body->sharing;
    uint64_t from = (uint64_t)r[1] << 32 | r[0], key = (uint64_t)r[3] << 32 | r[2];
    if (discovery_lookup(body->table, key) != SET_UNKNOWN)
        return false;
    for (uint32_t i = 0; i < r[4]; i++) {
        if (r[5 + i] >> 1 >= body->leaf_count)
            return false; // the records did not all find room
        steps[i] = (struct class_step){s->class_of_leaf[r[5 + i] >> 1],
                                       r[5 + i] & FRAGMENT_LEAVES ? -1 : 1};
    }
    return discovery_extend(body->table, from, steps, r[4], key) &&
           discovery_lookup(body->table, key) != SET_UNKNOWN; // or the table had no place for it
}

uint32_t gl_discover(const struct body *body, const uint32_t *records, size_t words)
{
    struct class_step *steps = NULL;
    uint32_t room = 0, found = 0, more;
    // A record may stand in front of the one that it goes on from.
    do {
        more = 0;
        for (size_t at = 0; at + 5 <= words && records[at + 4] <= words - at - 5;
             at += 5 + records[at + 4]) {
            array_reserve(&steps, &room, records[at + 4] + 1);
            more += discover_one(body, records + at, steps);
        }
        found += more;
    } while (more);
    free(steps);
    return found;
}
