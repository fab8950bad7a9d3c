// scheme_choose.h - the colour scheme that a user names.
#pragma once
#include "render/scheme.h"

// Of a name with a slash or the extension .json the file, read into *own; else the scheme of
// OpenSCAD's that is called so, or the first one with this name in the files of the folders below.
// "" is the default. `name` is borrowed. NULL with *err when there is none.
const struct scheme *scheme_choose(const char *name, struct scheme *own, struct error *err);

// The folders, one to a line.
void scheme_print_folders(FILE *out);
