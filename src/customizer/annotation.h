// annotation.h - the language of the comments behind parameters: "[0:5:100]", "[S:Small, L:Large]".
#pragma once
#include "customizer/literal.h"

// A number, a range, a vector of numbers, strings and pairs of value and label, or a string. An
// empty string for what does not parse, as in OpenSCAD. Values of parameter sets are written in
// this language as well.
struct literal annotation_read(struct arena *arena, const char *text, size_t size);
