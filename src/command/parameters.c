// parameters.c - files of parameter sets, as OpenSCAD's customizer writes them.
#include "command/parameters.h"

#include "base/file.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

enum { FILE_LIMIT = 1 << 26 };

static void set_missing(const char *path, const char *set, const cJSON *sets, struct error *err)
{
    char names[512] = "none";
    size_t used = 0;
    const cJSON *one;
    cJSON_ArrayForEach(one, sets)
    {
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
                                     one->string);
    }
    error_set(err, "%s: no parameter set '%s'; there are: %s", path, set, names);
}

bool parameters_check(const char *path, const char *set, struct error *err)
{
    char *text;
    size_t size;
    if (!file_read(path, FILE_LIMIT, &text, &size, err))
        return false;
    cJSON *all = cJSON_ParseWithLength(text, size);
    const cJSON *sets = cJSON_GetObjectItemCaseSensitive(all, "parameterSets");
    bool found = cJSON_GetObjectItemCaseSensitive(sets, set);
    if (!cJSON_IsObject(sets))
        error_set(err, "%s: is no JSON file of parameter sets", path);
    else if (!found)
        set_missing(path, set, sets, err);
    cJSON_Delete(all);
    free(text);
    return found;
}
