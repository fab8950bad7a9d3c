// fuzz_polygons.c - any bytes through the reader of polygons that READER names.
#include "fuzz.h"
#include "io/read_obj.h"
#include "io/read_off.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct mesh m;
    struct messages messages = {0};
    struct error err;
    char *text = exact_copy(data, size);
    if (READER("fuzz", text, size, &m, &messages, &err)) {
        check_mesh(&m);
        mesh_free(&m);
    }
    messages_free(&messages);
    free(text);
    return 0;
}
