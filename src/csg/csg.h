// csg.h - the tree of an exported .csg file: generic calls with arguments, no meaning yet.
#pragma once
#include "base/error.h"
#include "base/mem.h"

enum csg_kind {
    CSG_UNDEF,
    CSG_BOOL,
    CSG_NUMBER,
    CSG_STRING,
    CSG_VECTOR,  // of any values
    CSG_NUMBERS, // vector of numbers only, stored packed; [] is an empty CSG_NUMBERS
    CSG_RANGE,   // numbers: begin, step, end
};

struct csg_value {
    enum csg_kind kind;
    uint32_t count; // of string bytes, of elements
    union {
        bool boolean;
        double number;
        const char *string; // terminated, may hold any bytes but 0
        const struct csg_value *items;
        const double *numbers;
    };
};

struct csg_argument {
    const char *name; // NULL: positional
    struct csg_value value;
};

enum { CSG_BACKGROUND = 1, CSG_HIGHLIGHT = 2, CSG_ROOT = 4, CSG_DISABLE = 8 }; // % # ! *

// An assignment such as `$fn = 8;` is a node named CSG_ASSIGN ("=") with one argument, which holds
// the name and the value. OpenSCAD makes all assignments of a block before anything else in it.
#define CSG_ASSIGN "="

struct csg_node {
    const char *name; // interned: equal names have equal pointers within a tree
    const struct csg_argument *arguments;
    struct csg_node *child, *next; // first child, next sibling
    uint32_t argument_count;
    uint32_t line, column;
    uint8_t modifiers;
    bool block; // written with { }
};

struct csg_tree {           // {0} is a valid empty tree
    char *file;             // name as in messages
    struct csg_node *first; // top-level nodes, linked by next
    uint32_t node_count;
    struct arena arena; // owns everything above but `file`
};

// Parses `size` bytes at `text` (terminated by two zero bytes that are not counted, as file_read
// gives it; they are the scanner's to work in, and as before afterwards). On errors adds messages
// with place and source line and returns false with *out = {0}.
bool csg_parse(struct csg_tree *out, const char *file, char *text, size_t size,
               struct messages *messages);
bool csg_parse_file(struct csg_tree *out, const char *path, struct messages *messages);
void csg_free(struct csg_tree *t); // leaves {0}

// Do both say the same? Places and braces do not count; numbers are equal bit by bit.
bool csg_equal(const struct csg_tree *a, const struct csg_tree *b);

// Nodes in the order of the file, each before those below it, which come only if they are entered:
//     csg_enter(&it, first);
//     while ((n = csg_next(&it)))
//         csg_enter(&it, n->child);
struct csg_iterator { // {0} is at the end
    const struct csg_node **stack;
    uint32_t count, room;
};

void csg_enter(struct csg_iterator *it, const struct csg_node *first); // and its next ones; or NULL
const struct csg_node *csg_next(struct csg_iterator *it);              // NULL at the end
void csg_iterator_free(struct csg_iterator *it);                       // leaves {0}

// Writes the tree as OpenSCAD 2021.01 exports it. Returns a malloc'ed text and its length. Trees
// deeper than 10,000 are not indented, whose tabs alone would fill the memory.
char *csg_print(const struct csg_tree *t, size_t *size);
