// fuzz_svg.c - any bytes as an SVG picture.
#include "base/mem.h"
#include "io/read_svg.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    char *text = mem_zalloc(size + 1);
    memcpy(text, data, size);
    const struct svg_options options = {.dpi = 72, .detail = {0, 12, 2}};
    if (read_svg("fuzz.svg", text, size, &options, &o, &messages, &err)) {
        if (!o.clean)
            abort();
        for (uint32_t i = 0; i < o.point_count; i++)
            if (!isfinite(o.points[i].x) || !isfinite(o.points[i].y))
                abort();
    }
    outline_free(&o);
    messages_free(&messages);
    free(text);
    return 0;
}
