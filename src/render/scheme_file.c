// scheme_file.c - colour schemes in OpenSCAD's JSON files.
#include "render/scheme_file.h"

#include "base/file.h"
#include "base/mem.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_MOST = 1 << 20 };

static const struct key {
    const char *name;
    size_t offset; // of the struct rgb in struct scheme
} keys[] = {
    {"background", offsetof(struct scheme, background)},
    {"axes-color", offsetof(struct scheme, axes)},
    {"opencsg-face-front", offsetof(struct scheme, front)},
    {"opencsg-face-back", offsetof(struct scheme, back)},
    {"cgal-face-front", offsetof(struct scheme, mesh_front)},
    {"cgal-face-back", offsetof(struct scheme, mesh_back)},
    {"cgal-face-2d", offsetof(struct scheme, flat)},
    {"cgal-edge-front", offsetof(struct scheme, edge_front)},
    {"cgal-edge-back", offsetof(struct scheme, edge_back)},
    {"cgal-edge-2d", offsetof(struct scheme, edge_flat)},
    {"crosshair", offsetof(struct scheme, crosshair)},
};
static const char gradient_key[] = "background-stop";

// "#rrggbb"
static bool parse_colour(struct rgb *out, const char *text)
{
    if (strlen(text) != 7 || text[0] != '#' || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
        return false;
    unsigned long v = strtoul(text + 1, NULL, 16);
    *out = (struct rgb){v >> 16 & 255, v >> 8 & 255, v & 255};
    return true;
}

static bool read_colour(struct rgb *out, const cJSON *colours, const char *key, const char *path,
                        struct error *err)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(colours, key);
    if (!value) {
        error_set(err, "%s: the colour '%s' is missing", path, key);
        return false;
    }
    if (cJSON_IsString(value) && parse_colour(out, value->valuestring))
        return true;
    error_set(err, "%s: '%s' is not a colour like \"#f9d72c\"", path, key);
    return false;
}

static bool read_colours(struct scheme *out, const cJSON *root, const char *path, struct error *err)
{
    const cJSON *colours = cJSON_GetObjectItemCaseSensitive(root, "colors");
    if (!cJSON_IsObject(colours)) {
        error_set(err, "%s: not a colour scheme: there is no object \"colors\"", path);
        return false;
    }
    for (size_t i = 0; i < array_count(keys); i++)
        if (!read_colour((struct rgb *)((char *)out + keys[i].offset), colours, keys[i].name, path,
                         err))
            return false;
    out->background_bottom = out->background;
    return !cJSON_GetObjectItemCaseSensitive(colours, gradient_key) ||
           read_colour(&out->background_bottom, colours, gradient_key, path, err);
}

static struct place place_of(const char *path, const char *text, const char *at)
{
    struct place p = {path, 1, 1};
    for (; text < at; text++) {
        p.column = *text == '\n' ? 1 : p.column + 1;
        p.line += *text == '\n';
    }
    return p;
}

static cJSON *load(const char *path, struct error *err)
{
    char *text;
    size_t size;
    if (!file_read(path, FILE_MOST, &text, &size, err))
        return NULL;
    const char *end = text;
    cJSON *root = cJSON_ParseWithLengthOpts(text, size + 1, &end, true);
    if (!root)
        error_at(err, place_of(path, text, end), "not JSON");
    free(text);
    return root;
}

bool scheme_read(struct scheme *out, const char *path, struct error *err)
{
    cJSON *root = load(path, err);
    struct scheme s = {.name = path};
    bool ok = root && read_colours(&s, root, path, err);
    if (ok)
        *out = s;
    cJSON_Delete(root);
    return ok;
}

bool scheme_read_name(char *out, size_t size, const char *path, struct error *err)
{
    cJSON *root = load(path, err);
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "name"));
    if (name)
        snprintf(out, size, "%s", name);
    else if (root)
        error_set(err, "%s: not a colour scheme: there is no \"name\"", path);
    cJSON_Delete(root);
    return name;
}
