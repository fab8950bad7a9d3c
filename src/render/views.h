// views.h - the views that have names, and several of them in one picture.
#pragma once
#include "base/error.h"
#include "base/vec.h"

enum { VIEWS_MOST = 16 };

struct view_list {
    struct view {
        const char *name;
        struct vec3 rotation; // of the camera
    } items[VIEWS_MOST];
    uint32_t count;
};

// "iso,top,front": names between commas.
bool views_parse(struct view_list *out, const char *text, struct error *err);

// A picture divided into equal cells, as large as they can be, row by row; no columns when there
// are not enough pixels.
struct sheet_layout {
    int columns, rows;
    int width, height; // of a cell
};
struct sheet_layout sheet_layout(int width, int height, uint32_t count);
