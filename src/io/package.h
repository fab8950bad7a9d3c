// package.h - the files in a zip archive in memory, through libzip.
#pragma once
#include "base/error.h"

#include <stddef.h>

struct package;

bool package_is_zip(const char *data, size_t size);
// Borrows the bytes.
struct package *package_open(const char *path, const char *data, size_t size, struct error *err);
void package_close(struct package *p); // accepts NULL

enum { PACKAGE_NONE = -1 };
int64_t package_count(const struct package *p);
const char *package_name(const struct package *p, int64_t file);
int64_t package_find(const struct package *p, const char *name); // PACKAGE_NONE: not there

// Hands a file over in parts, unpacked; ends with false when `take` returns false, which then has
// set *err. Refuses what unpacks, all reads together, to far more than real models do.
bool package_read(struct package *p, int64_t file,
                  bool (*take)(void *user, const char *data, size_t size), void *user,
                  struct error *err);
