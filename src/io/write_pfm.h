// write_pfm.h - numbers per pixel as PFM files.
#pragma once
#include "base/error.h"

// One number per pixel, rows from the top; the file holds them from the bottom, little endian, as
// the format wants it. "-" is standard output; no file is left behind on errors.
bool write_pfm(const char *path, const float *values, int width, int height, struct error *err);
