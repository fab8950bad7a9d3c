// report.h - what the user is told about a load.
#pragma once
#include "base/error.h"

// The first messages, errors before warnings, and how many more there are; "" for none. The caller
// frees it.
char *report_summary(const struct messages *m);
// Adds openscad's errors and warnings, one message each, and prints its echoes to standard error.
void report_log(const char *log, struct messages *m);
