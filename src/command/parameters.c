// parameters.c - parameters of a .scad: whether a set is there, and the list as JSON.
#include "command/parameters.h"

#include "base/file.h"
#include "customizer/sets.h"

#include <stdlib.h>
#include <string.h>

enum { SOURCE_LIMIT = 1 << 24 };

bool parameters_check(const char *path, const char *set, struct error *err)
{
    struct parameter_sets sets;
    if (!parameter_sets_read(&sets, path, err))
        return false;
    bool found = parameter_sets_has(&sets, set);
    if (!found)
        parameter_sets_missing(&sets, path, set, err);
    parameter_sets_free(&sets);
    return found;
}

// "part" for "a/part.scad"
static char *title_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    char *title = mem_strdup(name), *dot = strrchr(title, '.');
    if (dot)
        *dot = 0;
    return title;
}

bool parameters_list(const char *scad, char **json, struct error *err)
{
    struct parameters p;
    char *text, *title;
    size_t size;
    if (!file_read(scad, SOURCE_LIMIT, &text, &size, err))
        return false;
    parameters_read(&p, text, size);
    title = title_of(scad);
    *json = parameters_json(&p, title);
    free(title);
    parameters_free(&p);
    free(text);
    return true;
}
