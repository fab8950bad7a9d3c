// scan.h - words and numbers of a text file, by line, whatever the locale.
#pragma once
#include "base/error.h"

#include <locale.h>
#include <stddef.h>

struct scan {
    const char *at, *end; // *end is 0
    const char *path;
    uint32_t line;
    bool hash_comments; // from '#' to the end of the line
    locale_t numbers;   // the C locale
};

void scan_open(struct scan *s, const char *path, const char *data, size_t size);
void scan_close(struct scan *s);

// Skips blanks and comments within the line; false at its end.
bool scan_in_line(struct scan *s);
// Skips to the next word, over line ends too; false at the end of the file.
bool scan_to_word(struct scan *s);
void scan_skip_line(struct scan *s);
// The word here: advances over it and gives its length.
size_t scan_word(struct scan *s, const char **word);
bool scan_is(const char *word, size_t length, const char *text);
// The word here as a finite number. False leaves the place alone.
bool scan_number(struct scan *s, double *out);
// The word here as a whole number.
bool scan_count(struct scan *s, uint32_t *out);
void scan_error(const struct scan *s, struct error *err, const char *what);
