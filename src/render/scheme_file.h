// scheme_file.h - colour schemes in OpenSCAD's JSON files.
#pragma once
#include "render/scheme.h"

#include <stddef.h>

// out->name is the path, borrowed.
bool scheme_read(struct scheme *out, const char *path, struct error *err);
// The name that the file gives its scheme, cut to fit.
bool scheme_read_name(char *out, size_t size, const char *path, struct error *err);
