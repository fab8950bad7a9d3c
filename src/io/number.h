// number.h - decimal numbers in text, whatever the locale of the program.
#pragma once
#include <locale.h>
#include <stdbool.h>

// The finite decimal number that `text` begins with; *stop is the place after it. The text ends
// with a zero byte. `numbers`: the C locale.
bool number_read(const char *text, locale_t numbers, double *out, const char **stop);
