// report.h - what the user is told about a load, line by line.
#pragma once
#include "base/error.h"
#include "scad/openscad.h"

enum report_kind { REPORT_ECHO, REPORT_TRACE, REPORT_WARNING, REPORT_ERROR, REPORT_KINDS };

struct report_line {
    enum report_kind kind;
    char *text;            // one line, its place in front
    uint32_t place_length; // of that; 0: none is known
};

// {0} is a valid empty report. Of each kind only the first REPORT_KEPT lines are there.
enum { REPORT_KEPT = 500 };
struct report {
    struct report_line *lines;
    uint32_t count, capacity;
    uint32_t kinds[REPORT_KINDS]; // of all, kept or not
};

void report_messages(struct report *r, const struct messages *m);
// What openscad said; `err`, unless NULL, is why it failed, which counts when it said no error.
void report_scad(struct report *r, const struct scad_result *result, const struct error *err);
void report_error(struct report *r, const char *text);
void report_print(const struct report *r, FILE *out);
struct report report_copy(const struct report *r);
void report_free(struct report *r); // leaves {0}

// The first line of the kind, NULL for none.
const struct report_line *report_first(const struct report *r, enum report_kind kind);
