// parser.h - what scanner and grammar share, of the program and of annotations.
#pragma once
#include "customizer/assignments.h"

struct slice { // of the text
    const char *text;
    size_t size;
};

struct group_comment {
    uint32_t line;
    struct slice text;
};

struct scad_parser {
    struct assignments *out;
    void *scanner;
    const char *text; // all of it, not the scanner's copy
    size_t size;
    uint32_t line;
    uint32_t braces, nesting; // open ones: '{'; '(' and '['
    struct literal *values;   // stack: elements of the open vectors
    uint32_t value_count, value_capacity;
    struct group_comment *groups;
    uint32_t group_count, group_capacity;
    uint32_t *names; // hash table: index of the assignment + 1, linear probing
    uint32_t name_mask;
    bool single; // one literal is read, nothing else
    bool started;
    struct literal result; // that one
};

struct annotation_parser {
    struct arena *arena;
    void *scanner;
    struct literal *entries; // of the open list
    uint32_t *sizes;         // how many items each has
    uint32_t entry_count, entry_capacity, size_capacity;
    struct words words; // of the open item
    bool has_words;
    struct literal result;
};

// What the grammar does with what it has read, assignments.c and annotation.c.
struct scad_name {
    struct slice text;
    uint32_t line;
};
void scad_assigned(struct scad_parser *p, struct scad_name name, const struct literal *value);
void scad_push(struct scad_parser *p, struct literal value);
struct literal scad_pop(struct scad_parser *p, enum literal_kind kind, uint32_t count);
void scad_comment(struct scad_parser *p, const char *text, size_t size); // "/* ... */"

struct literal annotation_string(struct annotation_parser *p, const char *text, size_t size);
void annotation_word(struct annotation_parser *p, struct literal word);
struct literal annotation_words(struct annotation_parser *p); // joined by blanks
void annotation_entry(struct annotation_parser *p, const struct literal *items, uint32_t count);
bool annotation_list(struct annotation_parser *p, struct literal *out);
