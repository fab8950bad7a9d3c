// sets.h - files of parameter sets, as OpenSCAD's customizer reads and writes them.
#pragma once
#include "base/error.h"
#include "customizer/parameters.h"

struct parameter_sets { // {0} is valid and empty
    struct cJSON *file;
    char **names; // in the order of the file
    uint32_t count;
};

// The file beside x.scad: x.json. To be freed.
char *parameter_sets_path(const char *scad);
bool parameter_sets_read(struct parameter_sets *out, const char *path, struct error *err);
void parameter_sets_free(struct parameter_sets *s); // leaves {0}

bool parameter_sets_has(const struct parameter_sets *s, const char *name);
// "no parameter set 'x'; there are: a, b"
void parameter_sets_missing(const struct parameter_sets *s, const char *path, const char *name,
                            struct error *err);
// All parameters become what the set says, and the source's values where it says nothing or, as in
// OpenSCAD, something of another kind. False when there is no such set.
bool parameter_sets_apply(const struct parameter_sets *s, const char *name, struct parameters *p);

// Change the file as it is on the disk now: other sets, what the set says of names that are no
// parameters and unknown keys stay as they are, in their order. A file that is missing is made by
// the first, with all values of the parameters. Written by rename.
bool parameter_set_save(const char *path, const char *name, const struct parameters *p,
                        struct error *err);
bool parameter_set_delete(const char *path, const char *name, struct error *err);
