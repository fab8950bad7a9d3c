// discover.c - the table of combinations on the device.
#include "render/gl/discover.h"

#include "base/mem.h"
#include "shaders/shared.h"

#include <stdlib.h>

bool gl_table_upload(struct gl_table *t, struct gl_memory *memory, struct discovery *d,
                     struct error *err)
{
    uint64_t version = discovery_version(d);
    if (t->records.id && t->version == version)
        return true;
    const struct table *table = atomic_load_explicit(&d->table, memory_order_acquire);
    size_t size = (size_t)table_capacity(table) * sizeof table->records[0];
    // Nobody writes while a frame is drawn but the thread that draws it.
    if (!gl_buffer_fit(&t->records, memory, "table", size, err))
        return false;
    gl_buffer_write(&t->records, 0, (const void *)table->records, size);
    t->shift = table->shift;
    t->version = version;
    return true;
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
