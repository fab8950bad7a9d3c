// parameters.c - whether there is a parameter set of a name.
#include "command/parameters.h"

#include "customizer/sets.h"

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
