// view.c - what --view adds to a picture.
#include "command/view.h"

#include "base/mem.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    size_t offset; // of the bool in struct view_options
} names[] = {
    {"axes", offsetof(struct view_options, axes)},
    {"crosshairs", offsetof(struct view_options, crosshairs)},
    {"edges", offsetof(struct view_options, edges)},
    {"scales", offsetof(struct view_options, scales)},
    {"wireframe", offsetof(struct view_options, wireframe)},
};

static void set(struct view_options *out, const char *name, size_t length)
{
    for (size_t i = 0; i < array_count(names); i++)
        if (strlen(names[i].name) == length && memcmp(names[i].name, name, length) == 0) {
            *(bool *)((char *)out + names[i].offset) = true;
            return;
        }
    fprintf(stderr, "hcsg-render: --view: '%.*s' is ignored; there are", (int)length, name);
    for (size_t i = 0; i < array_count(names); i++)
        fprintf(stderr, "%s%s", i ? ", " : " ", names[i].name);
    fputc('\n', stderr);
}

struct view_options view_parse(const char *text)
{
    struct view_options out = {0};
    while (text) {
        size_t length = strcspn(text, ",");
        set(&out, text, length);
        text = text[length] ? text + length + 1 : NULL;
    }
    return out;
}
