// literal.h - constant values of OpenSCAD's language, and their text.
#pragma once
#include "base/mem.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Vectors nest no deeper than this: what does is no literal.
enum { LITERAL_DEPTH_MOST = 64 };

enum literal_kind {
    LITERAL_UNDEF,
    LITERAL_BOOL,
    LITERAL_NUMBER,
    LITERAL_STRING,
    LITERAL_VECTOR,
    LITERAL_RANGE, // items: begin, end, or begin, step, end
};

struct literal {
    enum literal_kind kind;
    uint32_t count; // of items
    union {
        bool boolean;
        double number;
        const char *text; // UTF-8
        struct literal *items;
    };
};

// A growing text. {0} is a valid empty one; free() frees `data`.
struct words {
    char *data; // NULL, or ends with a zero byte
    uint32_t size, capacity;
};

void words_add(struct words *out, const char *text, size_t length);
void words_say(struct words *out, const char *words); // a C string

// The shortest digits that read back as the same number; `digits` 6 writes as OpenSCAD does.
enum { DIGITS_ALL = 17 };
void words_number(struct words *out, double number, int digits);
void words_quoted(struct words *out, const char *text); // a string literal
void words_literal(struct words *out, const struct literal *value, int digits);

// The value behind a row of "-", "+" and "!" with blanks between them; vectors change in place.
// Nothing but numbers and vectors of them can be negated: undef.
struct literal literal_sign(const char *signs, size_t length, struct literal value);
// The text of a string literal between its quotes.
const char *literal_unescape(struct arena *arena, const char *text, size_t length);
