// text_file.h - text files written as a whole.
#pragma once
#include "base/error.h"
#include "base/vec.h"

#include <stddef.h>

struct text_file { // {0} is an empty one
    char *data;
    size_t used, size;
};

void text_file_add(struct text_file *t, const char *text);
// As short as reads back the same; never "-0".
void text_file_number(struct text_file *t, double v);
void text_file_count(struct text_file *t, uint32_t n);
void text_file_point(struct text_file *t, struct vec3 p); // "x y z"
// Writes it as file_write does and leaves {0}.
bool text_file_save(struct text_file *t, const char *path, struct error *err);
