// settings.c - what hcsg-view remembers from window to window.
#include "app/settings.h"

#include "base/file.h"
#include "base/mem.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { FILE_LIMIT = 1 << 20, SIDE_LEAST = 64, SIDE_MOST = 16384 };

static const struct {
    const char *name;
    size_t offset; // of the bool in struct settings
} flags[] = {
    {"orthographic", offsetof(struct settings, orthographic)},
    {"status line", offsetof(struct settings, status)},
    {"customizer", offsetof(struct settings, customizer)},
    {"axes", offsetof(struct settings, view.axes)},
    {"scales", offsetof(struct settings, view.scales)},
    {"crosshairs", offsetof(struct settings, view.crosshairs)},
    {"edges", offsetof(struct settings, view.edges)},
};

static const struct {
    const char *name;
    size_t offset; // of the int
} sides[] = {{"width", offsetof(struct settings, width)},
             {"height", offsetof(struct settings, height)}};

// The folder of the settings; NULL without a home. The caller frees it.
static char *folder(void)
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    if (config && config[0] == '/') // the standard ignores others
        return file_join(config, "hcsg");
    return home && *home ? file_join(home, ".config/hcsg") : NULL;
}

// What the file holds, an empty object without one; NULL with *err when it is broken.
static cJSON *load(const char *path, struct error *err)
{
    char *text;
    size_t size;
    struct stat st;
    if (stat(path, &st) != 0 && errno == ENOENT)
        return cJSON_CreateObject();
    if (!file_read(path, FILE_LIMIT, &text, &size, err))
        return NULL;
    cJSON *json = cJSON_ParseWithLength(text, size);
    free(text);
    if (json && cJSON_IsObject(json))
        return json;
    cJSON_Delete(json);
    error_set(err, "%s: the settings are not a JSON object; the defaults hold", path);
    return NULL;
}

bool settings_read(struct settings *out, struct error *err)
{
    *out = SETTINGS_DEFAULTS;
    char *base = folder(), *path = base ? file_join(base, "view.json") : NULL;
    cJSON *json = path ? load(path, err) : cJSON_CreateObject();
    free(path);
    free(base);
    if (!json)
        return false;
    for (size_t i = 0; i < array_count(flags); i++) {
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(json, flags[i].name);
        if (cJSON_IsBool(item))
            *(bool *)((char *)out + flags[i].offset) = cJSON_IsTrue(item);
    }
    for (size_t i = 0; i < array_count(sides); i++) {
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(json, sides[i].name);
        if (cJSON_IsNumber(item) && item->valuedouble >= SIDE_LEAST &&
            item->valuedouble <= SIDE_MOST)
            *(int *)((char *)out + sides[i].offset) = (int)item->valuedouble;
    }
    const cJSON *scheme = cJSON_GetObjectItemCaseSensitive(json, "scheme");
    if (cJSON_IsString(scheme) && strlen(scheme->valuestring) < sizeof out->scheme)
        snprintf(out->scheme, sizeof out->scheme, "%s", scheme->valuestring);
    cJSON_Delete(json);
    return true;
}

static void put(cJSON *json, const char *name, cJSON *value)
{
    cJSON_DeleteItemFromObjectCaseSensitive(json, name);
    cJSON_AddItemToObject(json, name, value);
}

static void make_folders(char *path)
{
    for (char *slash = path + 1; (slash = strchr(slash, '/')); slash++) {
        *slash = 0;
        mkdir(path, 0777);
        *slash = '/';
    }
    mkdir(path, 0777);
}

bool settings_write(const struct settings *s, struct error *err)
{
    char *base = folder();
    if (!base)
        return true; // nobody's
    make_folders(base);
    char *path = file_join(base, "view.json");
    cJSON *json = load(path, NULL); // a broken one is replaced
    if (!json)
        json = cJSON_CreateObject();
    for (size_t i = 0; i < array_count(flags); i++)
        put(json, flags[i].name,
            cJSON_CreateBool(*(const bool *)((const char *)s + flags[i].offset)));
    for (size_t i = 0; i < array_count(sides); i++)
        put(json, sides[i].name,
            cJSON_CreateNumber(*(const int *)((const char *)s + sides[i].offset)));
    put(json, "scheme", cJSON_CreateString(s->scheme));
    char *text = cJSON_Print(json);
    bool ok = file_write(path, text, strlen(text), err);
    cJSON_free(text);
    cJSON_Delete(json);
    free(path);
    free(base);
    return ok;
}

bool settings_equal(const struct settings *a, const struct settings *b)
{
    bool equal = strcmp(a->scheme, b->scheme) == 0;
    for (size_t i = 0; i < array_count(flags); i++)
        equal &= *(const bool *)((const char *)a + flags[i].offset) ==
                 *(const bool *)((const char *)b + flags[i].offset);
    for (size_t i = 0; i < array_count(sides); i++)
        equal &= *(const int *)((const char *)a + sides[i].offset) ==
                 *(const int *)((const char *)b + sides[i].offset);
    return equal;
}
