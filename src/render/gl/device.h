// device.h - the device on the graphics processor: OpenGL 4.5 compute shaders.
#pragma once
#include "render/device.h"

// NULL with a reason when there is no driver that can do it. With `software` also where OpenGL runs
// on the processor. `host` may be NULL.
struct device *gl_device_new(bool software, const struct device_host *host, struct error *err);
