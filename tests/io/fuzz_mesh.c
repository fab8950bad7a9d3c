// fuzz_mesh.c - any bytes through the reader of triangles that READER names.
#include "fuzz.h"
#include "io/read_amf.h"
#include "io/read_nef3.h"
#include "io/read_stl.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct mesh m;
    struct error err;
    char *text = exact_copy(data, size);
    if (READER("fuzz", text, size, &m, &err)) {
        check_mesh(&m);
        mesh_free(&m);
    }
    free(text);
    return 0;
}
