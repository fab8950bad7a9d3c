// command.h - hcsg-render from its checked options to its exit code.
#pragma once
#include "command/request.h"

enum { EXIT_FINE = 0, EXIT_INPUT = 1, EXIT_OUTPUT = 2, EXIT_CHECK = 3 };

// Says on standard error what goes wrong.
int command_run(const struct request *r);
// Prints what stops the program and returns the code.
int command_fail(const struct error *err, int code);
