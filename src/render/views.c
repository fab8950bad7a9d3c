// views.c - the views that have names, and several of them in one picture.
#include "render/views.h"

#include "base/mem.h"

#include <string.h>

static const struct view views[] = {
    {"iso", {54.735610317245346, 0, 45}}, // all three axes equally long
    {"diagonal", {55, 0, 25}},            // OpenSCAD's
    {"top", {0, 0, 0}},
    {"bottom", {180, 0, 0}},
    {"left", {90, 0, 270}},
    {"right", {90, 0, 90}},
    {"front", {90, 0, 0}},
    {"back", {90, 0, 180}},
};

static const struct view *find(const char *name, size_t length)
{
    for (size_t i = 0; i < array_count(views); i++)
        if (strlen(views[i].name) == length && memcmp(views[i].name, name, length) == 0)
            return &views[i];
    return NULL;
}

bool views_parse(struct view_list *out, const char *text, struct error *err)
{
    struct view_list list = {0};
    for (const char *at = text; at; at = *at ? at + 1 : NULL) {
        size_t length = strcspn(at, ",");
        const struct view *v = find(at, length);
        if (!v) {
            error_set(err,
                      "--views: expected iso, diagonal, top, bottom, left, right, front or back "
                      "between commas, got '%.*s'",
                      (int)length, at);
            return false;
        }
        if (list.count == VIEWS_MOST) {
            error_set(err, "--views: expected at most %d views", VIEWS_MOST);
            return false;
        }
        list.items[list.count++] = *v;
        at += length;
        if (!*at)
            break;
    }
    *out = list;
    return true;
}

struct sheet_layout sheet_layout(int width, int height, uint32_t count)
{
    struct sheet_layout best = {0};
    int most = 0;
    for (int columns = 1; columns <= (int)count; columns++) {
        int rows = ((int)count + columns - 1) / columns;
        int w = width / columns, h = height / rows, side = w < h ? w : h;
        if (side && side >= most) { // of equal ones the widest
            most = side;
            best = (struct sheet_layout){columns, rows, w, h};
        }
    }
    return best;
}
