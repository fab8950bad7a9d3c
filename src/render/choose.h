// choose.h - which device draws, and why that one.
#pragma once
#include "render/device.h"

enum device_wish { DEVICE_AUTO, DEVICE_CPU, DEVICE_GL };

bool device_wish_parse(enum device_wish *out, const char *name, struct error *err);

// DEVICE_AUTO: the graphics processor where its driver can do it, else the processor. DEVICE_GL
// also takes OpenGL in software, and NULL means that there is none. *why says what draws, and why
// where that is not plain; or why there is nothing.
// `host` may be NULL.
struct device *device_choose(enum device_wish wish, const struct device_host *host,
                             struct error *why);
