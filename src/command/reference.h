// reference.h - the picture that was drawn against one that is expected.
#pragma once
#include "command/output.h"

// EXIT_FINE, or EXIT_INPUT or EXIT_CHECK with what is wrong.
int reference_check(const struct request *r, const struct drawn *d, struct error *err);
