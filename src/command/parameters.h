// parameters.h - files of parameter sets, as OpenSCAD's customizer writes them.
#pragma once
#include "base/error.h"

// openscad draws the defaults when there is no such file or set; here it is an error.
bool parameters_check(const char *path, const char *set, struct error *err);
