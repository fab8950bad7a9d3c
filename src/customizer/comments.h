// comments.h - what stands around an assignment: its lines, its group.
#pragma once
#include "customizer/parser.h"

struct lines { // of a text
    const char *text;
    size_t size;
    size_t *starts; // of each line, and the end
    uint32_t count, capacity;
};

void lines_find(struct lines *out, const char *text, size_t size);
void lines_free(struct lines *l); // leaves {0}

// Lines count from 1. All texts are in the arena.
struct literal comment_annotation(const struct lines *l, uint32_t line, struct arena *arena);
const char *comment_description(const struct lines *l, uint32_t line, struct arena *arena);
// The names in brackets of a comment, joined by '-'.
const char *comment_group(struct slice comment, struct arena *arena);
