// write_png.h - pictures as PNG files.
#pragma once
#include "base/error.h"

// 8-bit RGB, rows from the top without padding. The same picture gives the same bytes. "-" is
// standard output; no file is left behind on errors.
bool write_png(const char *path, const uint8_t *rgb, int width, int height, struct error *err);
