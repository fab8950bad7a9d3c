// file.h - whole files in and out.
#pragma once
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

// The whole content of a file, followed by two zero bytes that are not counted (what a flex scanner
// wants). "-" is standard input. The caller frees *data. Refuses folders and files over `limit`.
bool file_read(const char *path, size_t limit, char **data, size_t *size, struct error *err);

// Writes to a temporary name beside `path` and renames it, so that readers see the old file or the
// whole new one and a full disk leaves nothing behind. "-" is standard output.
bool file_write(const char *path, const void *data, size_t size, struct error *err);

// Changes whenever the file at the path is saved, replaced, removed or made.
uint64_t file_stamp(const char *path);

// Folder part of a path without the last '/', "." when there is none. The caller frees it.
char *file_folder(const char *path);
// folder/name, or name alone when it is absolute. The caller frees it.
char *file_join(const char *folder, const char *name);
// The extension of a path without the dot, "" when there is none. Points into path.
const char *file_extension(const char *path);
