// includes.h - the files that a .scad file names, for when openscad does not list them.
#pragma once
#include "scad/openscad.h"

// Takes the path over; a path that is there already is not added.
void scad_add_file(struct scad_result *out, uint32_t *capacity, char *path);

// Adds what the files of the design include and use, and what those do in turn, found or not.
// Sought beside the file that names them only: libraries hardly change while one works.
void scad_add_includes(struct scad_result *out, uint32_t *capacity);
