// choose.c - which device draws, and why that one.
#include "render/choose.h"

#include "base/mem.h"
#include "render/gl/context.h"
#include "render/gl/device.h"

#include <string.h>

bool device_wish_parse(enum device_wish *out, const char *name, struct error *err)
{
    static const char *const names[] = {
        [DEVICE_AUTO] = "auto", [DEVICE_CPU] = "cpu", [DEVICE_GL] = "gl"};
    for (size_t i = 0; i < array_count(names); i++)
        if (strcmp(name, names[i]) == 0) {
            *out = (enum device_wish)i;
            return true;
        }
    error_set(err, "--device: expected auto, cpu or gl, got '%s'", name);
    return false;
}

struct device *device_choose(enum device_wish wish, const struct device_host *host,
                             struct error *why)
{
    struct error reason;
    struct device *gl = NULL;
    // Making a context in software only to see that it is one would take longer than many pictures.
    if (wish == DEVICE_GL || (wish == DEVICE_AUTO && gl_hardware_there(&reason)))
        gl = gl_device_new(wish == DEVICE_GL, host, &reason);
    if (gl)
        error_set(why, "gl, %s", gl->description);
    else if (wish == DEVICE_GL)
        error_set(why, "--device=gl: %s", reason.text);
    else if (wish == DEVICE_AUTO)
        error_set(why, "cpu; not gl: %s", reason.text);
    else
        error_set(why, "cpu");
    return gl || wish == DEVICE_GL ? gl : cpu_device_new();
}
