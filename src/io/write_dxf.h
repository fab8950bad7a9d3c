// write_dxf.h - flat shapes as DXF files.
#pragma once
#include "base/error.h"
#include "geom/outline.h"

// One LINE per edge, as OpenSCAD writes them: the form that every reader takes. "-" is standard
// output; no file is left behind on errors.
bool write_dxf(const char *path, const struct outline *o, struct error *err);
