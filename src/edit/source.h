// source.h - a file as it was read: its text and its tree, shared by those who look at them.
#pragma once
#include "csg/csg.h"

#include <stdatomic.h>

struct source {
    char *text;
    size_t size;
    struct csg_tree tree;
    const struct csg_node **nodes; // in the order of the file, as places grow
    uint32_t *parent;              // per node; SOURCE_NONE at the top level
    uint32_t *span;                // per node: nodes in its subtree, itself included
    uint32_t node_count;
    atomic_uint references;
};

#define SOURCE_NONE UINT32_MAX

// Takes over the text, as file_read gives it. NULL after errors.
struct source *source_new(const char *file, char *text, size_t size, struct messages *messages);
struct source *source_hold(struct source *s);
void source_release(struct source *s); // NULL is fine

// The node at a place, as leaves and messages name it, or SOURCE_NONE.
uint32_t source_node_at(const struct source *s, uint32_t line, uint32_t column);
// The first node in a line or after it, SOURCE_NONE behind the last.
uint32_t source_node_from(const struct source *s, uint32_t line);
