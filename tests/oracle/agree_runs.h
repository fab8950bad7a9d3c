// agree_runs.h - two ways to draw compared on random trees and files.
#pragma once
#include "options.h"

// The device on the processor, by itself or as it is told to walk, and the device under test; of
// the processor its two ways. Both return the exit status of the program.
int agree_random(const struct options *options);
int agree_file(const struct options *options);
