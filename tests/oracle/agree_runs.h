// agree_runs.h - two ways to draw compared on random trees and files.
#pragma once
#include "options.h"

// The two ways of the device on the processor. Both return the exit status of the program.
int agree_random(const struct options *options);
int agree_file(const struct options *options);
