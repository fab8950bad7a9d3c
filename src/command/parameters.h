// parameters.h - parameters of a .scad: whether a set is there, and the list as JSON.
#pragma once
#include "base/error.h"

// openscad draws the defaults when there is no such file or set; here it is an error.
bool parameters_check(const char *path, const char *set, struct error *err);

// All parameters of the .scad file as JSON, with a line end. To be freed.
bool parameters_list(const char *scad, char **json, struct error *err);
