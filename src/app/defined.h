// defined.h - the parameters of the .scad as the loader has them: what the user changed, over
// saves.
#pragma once
#include "customizer/parameters.h"

struct parameter_texts { // values on their way between threads; {0} is valid
    struct parameter_text_pair {
        char *name, *text;
    } * items;
    uint32_t count;
};
struct parameter_texts parameter_texts_of(const struct parameters *p);
void parameter_texts_free(struct parameter_texts *t); // leaves {0}

void parameters_delete(struct parameters *p); // one that was allocated; NULL is fine

struct defined { // {0} is valid
    struct parameters now;
    struct parameters kept; // of the last text before that openscad could read
    uint64_t stamp;         // of the file that `now` was read from
    bool good;              // openscad could read that
};

// Reads the file if it was saved since. A value stays changed while the source goes on saying what
// it said, even when a broken text in between lacks the name. Returns what the user sees from now
// on, for parameters_delete; NULL when nothing has changed.
struct parameters *defined_read(struct defined *d, const char *path);
void defined_set(struct defined *d, const struct parameter_texts *texts);
void defined_exported(struct defined *d); // openscad could read the file
// -D for each value that differs from the source. Room for one more; the caller frees all.
char **defined_arguments(const struct defined *d, uint32_t *count);
void defined_free(struct defined *d); // leaves {0}
