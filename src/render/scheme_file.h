// scheme_file.h - colour schemes in OpenSCAD's JSON files.
#pragma once
#include "render/scheme.h"

// out->name is the path, borrowed.
bool scheme_read(struct scheme *out, const char *path, struct error *err);

// Of a name with a slash or the extension .json the file, read into *own; else the scheme of
// OpenSCAD's that is called so. NULL with *err when there is none.
const struct scheme *scheme_choose(const char *name, struct scheme *own, struct error *err);
