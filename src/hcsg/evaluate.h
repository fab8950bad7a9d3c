// evaluate.h - is a set of leaves solid? Costs the ancestors of its members, not the whole
// expression.
#pragma once
#include "hcsg/share.h"

struct member { // of a combination: count leaves of one class hold the interval
    uint32_t class_id, count;
};

// Sorts members that were put together anyhow, adds up those of one class, and drops what is gone.
// Returns how many are left.
uint32_t members_settle(struct member *members, uint32_t count);

// The set is sorted by class. Thread-safe.
bool evaluate_set(const struct expr *e, const struct sharing *s, const struct member *set,
                  uint32_t count);
