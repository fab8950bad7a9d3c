// parameters.h - whether there is a parameter set of a name.
#pragma once
#include "base/error.h"

// openscad draws the defaults when there is no such file or set; here it is an error.
bool parameters_check(const char *path, const char *set, struct error *err);
