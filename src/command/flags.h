// flags.h - values that name members of a set, between commas.
#pragma once
#include "base/error.h"

struct flag_name {
    const char *name;
    uint32_t bits;
};

// Adds the bits of the names in `text` to *out. `option` and `expected` are told when one is none.
bool flags_parse(uint32_t *out, const char *text, const struct flag_name *names, size_t count,
                 const char *option, const char *expected, struct error *err);
