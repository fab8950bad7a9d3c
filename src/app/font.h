// font.h - the file of the desktop's font for text in windows.
#pragma once
#include <stdbool.h>

// A TrueType font; the caller frees *data. False when there is none.
bool font_read(void **data, int *size);
