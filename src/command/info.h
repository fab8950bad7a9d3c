// info.h - what hcsg is made of, and what draws on this machine.
#pragma once
#include "base/error.h"

// On standard output.
bool info_print(struct error *err);
