// edits.h - the time from a number that is edited to its picture.
#pragma once
#include "measure.h"

// Numbers all over the file change one after the other, as in hcsg-view: each time a tree with the
// change, its model in place of the one before, its picture; then the same picture again. Fills
// out->edits.
bool edits_measure(struct result *out, const char *csg, const struct measure_options *options,
                   struct error *err);
