// discover.h - the table of combinations on the device, and how unknown ones come into it.
#pragma once
#include "model/model.h"
#include "render/gl/buffer.h"

struct gl_table { // {0} is valid: nothing uploaded
    struct gl_buffer records;
    uint32_t shift;
    uint64_t version; // of the table, discovery_version
};

// Brings the buffer in line with the table. False when there is no room.
bool gl_table_upload(struct gl_table *t, struct gl_memory *memory, struct discovery *d,
                     struct error *err);

// Evaluates combinations that rays have put on record (combination.glsl): `words` words. Returns
// how many the table did not know.
uint32_t gl_discover(const struct body *body, const uint32_t *records, size_t words);
