// source.h - the text of a shader: built in or from a folder, its includes resolved.
#pragma once
#include "base/error.h"

#include <stddef.h>

// The files of shaders/, as they were when the program was built.
struct gl_file {
    const char *name, *text;
};
extern const struct gl_file gl_files[];
extern const size_t gl_file_count;

struct gl_source {
    char *text;   // what the compiler gets
    char **files; // names of the files in it
    uint32_t file_count, file_capacity;
    struct gl_line {
        uint32_t file, line; // line 0: of no file
    } * lines;               // where each line of the text is from
    uint32_t line_count, line_capacity;
};

// `folder` NULL: built in. `defines` is "NAME=VALUE OTHER=VALUE" or "". A file is included once, so
// #include stands outside of conditions. #version is added.
bool gl_source_read(struct gl_source *s, const char *folder, const char *name, const char *defines,
                    struct error *err);
void gl_source_free(struct gl_source *s); // leaves {0}

// Changes whenever one of the files in the folder does.
uint64_t gl_source_stamp(const struct gl_source *s, const char *folder);

// The first error in a log of the compiler, with its place.
void gl_source_error(const struct gl_source *s, const char *log, struct error *err);
