// fuzz_mesh.c - any bytes through the reader of meshes that READER names.
#include "fuzz_mesh.h"
#include "io/read_amf.h"
#include "io/read_obj.h"
#include "io/read_off.h"
#include "io/read_stl.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct mesh m;
    struct error err;
    char *text = mem_zalloc(size + 1);
    memcpy(text, data, size);
    if (READER("fuzz", text, size, &m, &err)) {
        check_mesh(&m);
        mesh_free(&m);
    }
    free(text);
    return 0;
}
