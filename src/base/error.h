// error.h - one error with its place, and lists of messages for the user.
#pragma once
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

// A position in a file; line and column count from 1, 0 means unknown. The name is borrowed.
struct place {
    const char *file;
    uint32_t line, column;
};

// What a function that returns false says. One line, complete: "part.csg:3:7: expected ')'".
struct error {
    char text[1024];
};

void error_set(struct error *err, const char *format, ...) __attribute__((format(printf, 2, 3)));
void error_at(struct error *err, struct place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

enum message_level { MESSAGE_WARNING, MESSAGE_ERROR };

struct message {
    enum message_level level;
    char *text;            // one line, with its place in front
    char *source;          // the line of the file it speaks of and a caret line under it, or NULL
    uint32_t place_length; // of the "file:line:column" in front; 0 without a line
};

// Messages in the order they came. Owned text. {0} is a valid empty list.
// Past `MESSAGES_KEPT` of one level only the counts go on.
enum { MESSAGES_KEPT = 100 };
struct messages {
    struct message *items;
    uint32_t count, capacity;
    uint32_t warnings, errors; // all of them, kept or not
};

void messages_add(struct messages *m, enum message_level level, struct place place,
                  const char *format, ...) __attribute__((format(printf, 4, 5)));
void messages_append(struct messages *m, const struct messages *more); // adds copies
// Attaches a source excerpt to the newest message.
void messages_source(struct messages *m, const char *line, size_t length, uint32_t column);
void messages_print(const struct messages *m, FILE *out);
void messages_print_errors(const struct messages *m, FILE *out); // without warnings
void messages_free(struct messages *m);                          // leaves {0}
