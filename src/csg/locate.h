// locate.h - where in the text of a file the values of its tree stand.
#pragma once
#include "csg/csg.h"

struct csg_text { // of a whole file, as csg_parse got it
    const char *text;
    size_t size;
};

struct csg_span {
    size_t begin, end; // bytes of the text
    bool negative;     // a '-' in front of brackets around it turns the value's sign
};

// The name of a node of the tree that was parsed from this text. False when it is not there.
bool csg_locate_name(const struct csg_text *text, const struct csg_node *node,
                     struct csg_span *out);

// Scalars of a value are numbers, booleans, strings and undef, counted in the order of reading,
// also through vectors in vectors. This is where one of them stands, its sign with it. False when
// it is not there, or behind a range.
bool csg_locate_scalar(const struct csg_text *text, const struct csg_node *node, uint32_t argument,
                       uint32_t scalar, struct csg_span *out);

// Number `scalar` of a value, NULL when there are fewer; *hold gives packed numbers a place. Values
// with ranges in them have no scalars.
const struct csg_value *csg_scalar(const struct csg_value *value, uint32_t scalar,
                                   struct csg_value *hold);
uint32_t csg_scalar_count(const struct csg_value *value);
