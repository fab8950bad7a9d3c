// parser.h - what scanner, grammar and tree builder of one parse share.
#pragma once
#include "csg/csg.h"

#include <locale.h>

struct csg_name { // a name and where it stands
    const char *text;
    uint32_t line, column;
};

struct csg_list {
    struct csg_node *first, *last;
};

struct csg_interned {
    uint64_t hash;
    const char *text; // NULL: free slot
};

struct csg_parser {
    struct csg_tree tree;
    struct messages *messages;
    void *scanner;
    const char *text, *end;   // the whole file
    const char *line_start;   // of the line the scanner is in
    uint32_t line;            // its number
    const char *token;        // the newest token
    const char *token_end;    // past it
    const char *previous_end; // past the token before it
    const char *no_raw_end;   // no raw string ends before here (see csg_scan_string)
    const char *unclosed_end; // where the newest unclosed string was given up
    uint32_t errors;
    bool stop;                  // the scanner says end of file from now on
    locale_t c_locale;          // for the numbers that need strtod, made on demand
    const char *assign;         // the interned CSG_ASSIGN
    struct csg_interned *names; // hash table, linear probing
    uint32_t name_count, name_mask;
    double *numbers; // of the vector being scanned
    uint32_t number_capacity;
    struct csg_value *values; // stack: elements of the open vectors
    uint32_t value_count, value_capacity;
    struct csg_argument *arguments; // of the open call
    uint32_t argument_count, argument_capacity;
    const char **braces; // stack: where the open blocks began
    uint32_t brace_count, brace_capacity;
};

// The scanner, at the end of csg.l.
bool csg_scanner_open(struct csg_parser *p, char *text, size_t size);
void csg_scanner_close(struct csg_parser *p);
// The scanner keeps a zero byte behind the newest token. `show` puts the true character back, for
// who reads the text around it; false undoes that.
void csg_scanner_show(struct csg_parser *p, bool show);

// Tokens, scan.c.
double csg_scan_number(struct csg_parser *p, const char *text, const char **end);
double csg_scan_hex(const char *text); // "0x1F"; stops at what is no digit
// The vector of numbers, or of vectors of numbers, whose '[' is at `text`. Returns where it ends,
// past its ']', or NULL when it is anything else.
const char *csg_scan_numbers(struct csg_parser *p, const char *text, struct csg_value *value);
// The string whose opening quote is at `quote`. Returns where it ends, past the closing quote.
const char *csg_scan_string(struct csg_parser *p, const char *quote, struct csg_value *value);
void csg_count_lines(struct csg_parser *p, const char *from, const char *to);

// The tree, build.c.
const char *csg_intern(struct csg_parser *p, const char *text, size_t length);
void csg_push_value(struct csg_parser *p, struct csg_value value);
void csg_push_argument(struct csg_parser *p, const char *name, struct csg_value value);
struct csg_value csg_vector(struct csg_parser *p, uint32_t count); // of the newest values
bool csg_range(struct csg_parser *p, struct csg_value begin, struct csg_value step,
               struct csg_value end, struct csg_value *out);
struct csg_node *csg_node_new(struct csg_parser *p, struct csg_name name, uint8_t modifiers);
struct csg_list csg_append(struct csg_list list, struct csg_list more);
void csg_open_brace(struct csg_parser *p);
void csg_close_brace(struct csg_parser *p);
void csg_recovered(struct csg_parser *p); // drops what the broken statement left behind

// Messages, parse.c. `at` points into the text.
void csg_error(struct csg_parser *p, const char *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// The newest token cannot stand where it does. `expected` in words, may be empty.
void csg_error_token(struct csg_parser *p, const char *expected);
// What only a .scad holds: one message, and the parse ends. `what` NULL: the newest token.
void csg_error_scad(struct csg_parser *p, const char *at, const char *what);
void csg_error_name(struct csg_parser *p, struct csg_name name); // a name where a value should be
