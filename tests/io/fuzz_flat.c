// fuzz_flat.c - any bytes through the reader of drawings that READER names, with its OPTIONS.
#include "fuzz.h"
#include "io/read_dxf.h"
#include "io/read_svg.h"

#define DXF (&(const struct dxf_options){.scale = 1, .detail = {0, 12, 2}})
#define SVG (&(const struct svg_options){.dpi = 72, .detail = {0, 12, 2}})

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct outline o = {0};
    struct messages messages = {0};
    struct error err;
    char *text = exact_copy(data, size);
    if (READER("fuzz", text, size, OPTIONS, &o, &messages, &err))
        check_flat(&o);
    outline_free(&o);
    messages_free(&messages);
    free(text);
    return 0;
}
