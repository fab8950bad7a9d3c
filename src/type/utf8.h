// utf8.h - is this text UTF-8?
#pragma once
#include <stdbool.h>

// As Unicode defines it: no overlong forms, no surrogates, nothing above U+10FFFF.
bool utf8_is_valid(const char *text);
