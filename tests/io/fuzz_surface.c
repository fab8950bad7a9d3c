// fuzz_surface.c - any bytes as text or picture of a height field.
#include "fuzz.h"
#include "io/read_surface.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct surface_options options = {.center = size & 1, .invert = size & 2};
    struct mesh m;
    struct messages messages = {0};
    struct error err;
    char *text = exact_copy(data, size);
    if (read_surface("fuzz", text, size, &options, &m, &messages, &err)) {
        check_mesh(&m);
        mesh_free(&m);
    }
    messages_free(&messages);
    free(text);
    return 0;
}
