// build.h - the model of the input, as the request wants it.
#pragma once
#include "command/input.h"
#include "model/model.h"

// Files that a .csg imports and that are missing are made first, by the command of -m.
void build_model(struct model *out, const struct request *r, const struct input *in,
                 struct solid_store *store, struct messages *messages);
