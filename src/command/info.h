// info.h - what hcsg is made of, and what draws on this machine.
#pragma once
#include "render/choose.h"

// On standard output.
bool info_print(enum device_wish device, struct error *err);
