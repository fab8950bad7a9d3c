// sets.c - files of parameter sets, as OpenSCAD's customizer reads and writes them.
#include "customizer/sets.h"

#include "base/file.h"
#include "base/locale.h"
#include "customizer/index.h"
#include "customizer/literal.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_LIMIT = 1 << 24 };

static const char sets_key[] = "parameterSets", version_key[] = "fileFormatVersion";

char *parameter_sets_path(const char *scad)
{
    const char *extension = file_extension(scad);
    size_t stem = strlen(scad);
    if (*extension)
        stem = (size_t)(extension - scad) - 1;
    struct words out = {0};
    words_add(&out, scad, stem);
    words_say(&out, ".json");
    return out.data;
}

static cJSON *read_file(const char *path, struct error *err)
{
    char *text;
    size_t size;
    if (!file_read(path, FILE_LIMIT, &text, &size, err))
        return NULL;
    struct own_locale own = locale_enter();
    cJSON *file = cJSON_ParseWithLengthOpts(text, size + 1, NULL, true);
    locale_leave(&own);
    free(text);
    if (cJSON_IsObject(cJSON_GetObjectItemCaseSensitive(file, sets_key)))
        return file;
    cJSON_Delete(file);
    error_set(err, "%s: is no JSON file of parameter sets", path);
    return NULL;
}

bool parameter_sets_read(struct parameter_sets *out, const char *path, struct error *err)
{
    cJSON *file = read_file(path, err), *set;
    if (!file)
        return false;
    cJSON *sets = cJSON_GetObjectItemCaseSensitive(file, sets_key);
    *out = (struct parameter_sets){.file = file};
    uint32_t capacity = 0;
    cJSON_ArrayForEach(set, sets)
    {
        array_reserve(&out->names, &capacity, (size_t)out->count + 1);
        out->names[out->count++] = set->string;
    }
    return true;
}

void parameter_sets_free(struct parameter_sets *s)
{
    cJSON_Delete(s->file);
    free(s->names);
    *s = (struct parameter_sets){0};
}

static const cJSON *find_set(const struct parameter_sets *s, const char *name)
{
    const cJSON *sets = cJSON_GetObjectItemCaseSensitive(s->file, sets_key);
    return cJSON_GetObjectItemCaseSensitive(sets, name);
}

bool parameter_sets_has(const struct parameter_sets *s, const char *name)
{
    return find_set(s, name) != NULL;
}

void parameter_sets_missing(const struct parameter_sets *s, const char *path, const char *name,
                            struct error *err)
{
    char names[512] = "none";
    for (size_t i = 0, used = 0; i < s->count && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
                                 s->names[i]);
    error_set(err, "%s: no parameter set '%s'; there are: %s", path, name, names);
}

// Values are strings, but numbers and true or false without quotes are understood.
static void apply_value(struct parameter *p, const cJSON *value)
{
    if (cJSON_IsString(value))
        parameter_set(p, value->valuestring);
    else if (cJSON_IsBool(value))
        parameter_set(p, cJSON_IsTrue(value) ? "true" : "false");
    else if (cJSON_IsNumber(value)) {
        struct words text = {0};
        words_number(&text, value->valuedouble, DIGITS_ALL);
        parameter_set(p, text.data);
        free(text.data);
    }
}

bool parameter_sets_apply(const struct parameter_sets *s, const char *name, struct parameters *p)
{
    const cJSON *set = find_set(s, name);
    if (!set)
        return false;
    struct own_locale own = locale_enter();
    struct name_index names;
    index_make(&names, p);
    for (uint32_t i = 0; i < p->count; i++)
        parameter_reset(&p->items[i]);
    const cJSON *value;
    cJSON_ArrayForEach(value, set)
    {
        uint32_t i = value->string ? index_find(&names, value->string) : p->count;
        if (i < p->count)
            apply_value(&p->items[i], value);
    }
    index_free(&names);
    locale_leave(&own);
    return true;
}

// cJSON formats with tabs; OpenSCAD's files have blanks, and often a history in version control.
static bool write_file(const char *path, const cJSON *file, struct error *err)
{
    struct own_locale own = locale_enter();
    char *text = cJSON_Print(file);
    locale_leave(&own);
    struct words out = {0};
    for (const char *at = text; *at; at++) // tabs within strings are written \t
        if (*at == '\t')
            words_say(&out, at[-1] == ':' ? " " : "    ");
        else
            words_add(&out, at, 1);
    words_say(&out, "\n");
    bool ok = file_write(path, out.data, out.size, err);
    free(out.data);
    cJSON_free(text);
    return ok;
}

static cJSON *new_file(void)
{
    cJSON *file = cJSON_CreateObject();
    cJSON_AddObjectToObject(file, sets_key);
    cJSON_AddStringToObject(file, version_key, "1");
    return file;
}

static cJSON *value_json(const struct parameter *p)
{
    char *text = parameter_text(p);
    cJSON *value = cJSON_CreateString(text);
    free(text);
    return value;
}

static void put_values(cJSON *set, const struct parameters *p)
{
    bool *there = mem_zalloc(p->count + 1);
    struct name_index names;
    index_make(&names, p);
    for (cJSON *old = set->child, *next; old; old = next) {
        next = old->next;
        uint32_t i = index_find(&names, old->string);
        if (i == p->count)
            continue;
        cJSON *new = value_json(&p->items[i]);
        new->string = mem_strdup(old->string);
        there[i] = cJSON_ReplaceItemViaPointer(set, old, new);
    }
    for (uint32_t i = 0; i < p->count; i++)
        if (!there[i])
            cJSON_AddItemToObject(set, p->items[i].name, value_json(&p->items[i]));
    index_free(&names);
    free(there);
}

bool parameter_set_save(const char *path, const char *name, const struct parameters *p,
                        struct error *err)
{
    bool missing = access(path, F_OK) != 0 && errno == ENOENT;
    cJSON *file = missing ? new_file() : read_file(path, err);
    if (!file)
        return false;
    cJSON *sets = cJSON_GetObjectItemCaseSensitive(file, sets_key);
    cJSON *set = cJSON_GetObjectItemCaseSensitive(sets, name);
    if (set && !cJSON_IsObject(set)) {
        cJSON_DeleteItemFromObjectCaseSensitive(sets, name);
        set = NULL;
    }
    if (!set)
        set = cJSON_AddObjectToObject(sets, name);
    put_values(set, p);
    bool ok = write_file(path, file, err);
    cJSON_Delete(file);
    return ok;
}

bool parameter_set_delete(const char *path, const char *name, struct error *err)
{
    struct parameter_sets s;
    if (!parameter_sets_read(&s, path, err))
        return false;
    bool ok = parameter_sets_has(&s, name);
    if (ok) {
        cJSON *sets = cJSON_GetObjectItemCaseSensitive(s.file, sets_key);
        cJSON_DeleteItemFromObjectCaseSensitive(sets, name);
        ok = write_file(path, s.file, err);
    } else
        parameter_sets_missing(&s, path, name, err);
    parameter_sets_free(&s);
    return ok;
}
