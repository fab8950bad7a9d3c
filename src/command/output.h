// output.h - what was drawn, written to files.
#pragma once
#include "command/draw.h"

// `view` is the one that was drawn for this file alone, or NULL.
bool output_write(const struct output *o, const struct drawn *d, const struct view *view,
                  struct error *err);

// The file of one view: its name stands in the place of "%s". The caller frees it.
char *output_path(const struct output *o, const struct view *view);
