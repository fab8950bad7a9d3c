// assignments.h - what is assigned at the top level of a .scad text, and what its comments say.
#pragma once
#include "customizer/literal.h"

// One name, with what its last assignment says, as OpenSCAD's customizer sees it.
struct assignment {
    const char *name;
    uint32_t line; // of the name, from 1
    bool literal;  // false: the value is calculated
    struct literal value;
    const char *group;         // NULL: no comment above names one
    const char *description;   // NULL: none
    struct literal annotation; // an empty string without one
};

struct assignments { // {0} is valid and empty
    struct assignment *items;
    uint32_t count, capacity;
    uint32_t end_line; // of the first '{': what is assigned there or below is no parameter
    struct arena arena;
};

enum { SCAD_TEXT_MOST = 1 << 24 };

// In the order in which the names come first. Text that does not parse ends where it breaks; of
// text beyond SCAD_TEXT_MOST nothing is read. Other than OpenSCAD 2021.01 it knows lines that end
// with \r\n, and strings that end with a backslash or hold a '{'.
void assignments_read(struct assignments *out, const char *text, size_t size);
void assignments_free(struct assignments *a); // leaves {0}

// The value of a literal in the text, alone. False when it is none.
bool literal_read(struct arena *arena, const char *text, size_t size, struct literal *out);
