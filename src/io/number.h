// number.h - decimal numbers in text, whatever the locale of the program.
#pragma once
#include <locale.h>
#include <stdbool.h>

// The finite number that `text` begins with, as strtod reads it; *stop is the place after it. The
// text ends with a zero byte. `numbers`: the C locale.
bool number_read(const char *text, locale_t numbers, double *out, const char **stop);
