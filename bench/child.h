// child.h - another program run to its end, timed.
#pragma once
#include "base/error.h"

#include <stddef.h>

struct child {
    double seconds;    // from start to end
    size_t peak_bytes; // most memory it had
    int status;        // exit status; -1: it was ended by a signal
    bool late;         // ended because it ran past the limit
    char *output; // what it wrote to standard output, terminated; of a late one what came so far
    size_t size;
};

// `argv` ends with NULL; argv[0] is looked up in PATH. Its standard error is ours if `loud`.
bool child_run(struct child *out, const char *const *argv, double limit, bool loud,
               struct error *err);
void child_free(struct child *c); // leaves {0}
