// text_file.c - text files written as a whole.
#include "io/text_file.h"

#include "base/file.h"
#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

void text_file_add(struct text_file *t, const char *text)
{
    size_t length = strlen(text);
    if (t->size - t->used < length) {
        t->size = 2 * t->size + length;
        t->data = mem_realloc(t->data, t->size);
    }
    memcpy(t->data + t->used, text, length);
    t->used += length;
}

void text_file_number(struct text_file *t, double v)
{
    char text[32];
    int digits = 6;
    do
        snprintf(text, sizeof text, "%.*g", digits, v + 0.0);
    while (strtod(text, NULL) != v && digits++ < 17);
    text_file_add(t, text);
}

void text_file_count(struct text_file *t, uint32_t n)
{
    char text[16];
    snprintf(text, sizeof text, "%u", n);
    text_file_add(t, text);
}

void text_file_point(struct text_file *t, struct vec3 p)
{
    text_file_number(t, p.x);
    text_file_add(t, " ");
    text_file_number(t, p.y);
    text_file_add(t, " ");
    text_file_number(t, p.z);
}

bool text_file_save(struct text_file *t, const char *path, struct error *err)
{
    bool ok = file_write(path, t->data, t->used, err);
    free(t->data);
    *t = (struct text_file){0};
    return ok;
}
