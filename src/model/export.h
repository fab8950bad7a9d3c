// export.h - a model that is one evaluated object as a file of its geometry.
#pragma once
#include "model/model.h"

enum export_format { EXPORT_STL, EXPORT_OFF, EXPORT_DXF };

// By the name that is also the extension of such files; false: none of them.
bool export_format_find(enum export_format *out, const char *name);

// The vertices are those the object is drawn with. Fails for what has none because only pictures
// are made of it: several solids, and what is left of one after others are taken away. What is
// marked % is no part of the object.
bool model_export(const struct model *m, enum export_format format, const char *path,
                  struct error *err);
