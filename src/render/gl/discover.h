// discover.h - the table of combinations on the device, and how unknown ones come into it.
#pragma once
#include "model/model.h"
#include "render/gl/buffer.h"

struct gl_table { // {0} is valid: nothing uploaded
    // A table that was built anew goes into the one that no command reads any more, so that nothing
    // waits.
    struct gl_buffer records[2];
    uint32_t current; // of the two
    uint32_t shift;
    uint64_t version;  // of what is there, discovery_version
    uint64_t born;     // the table it is a copy of
    uint64_t uploaded; // bytes, of all times
};

// Brings the records in line with the table: what has changed alone. False when there is no room.
bool gl_table_upload(struct gl_table *t, struct gl_memory *memory, struct discovery *d,
                     struct error *err);
const struct gl_buffer *gl_table_records(const struct gl_table *t);
void gl_table_free(struct gl_table *t); // leaves {0}

// Evaluates combinations that rays have put on record (combination.glsl): `words` words. Returns
// how many the table did not know.
uint32_t gl_discover(const struct body *body, const uint32_t *records, size_t words);
