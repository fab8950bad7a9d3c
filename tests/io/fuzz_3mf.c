// fuzz_3mf.c - any bytes as 3MF package or, when they are no zip archive, as the model in one.
#include "fuzz.h"
#include "io/read_3mf.h"

#include <zip.h>

static void read_both_ways(const char *data, size_t size)
{
    for (int placed = 0; placed < 2; placed++) {
        struct mesh_set set;
        struct error err;
        if (!read_3mf("fuzz", data, size, placed, &set, &err))
            continue;
        for (uint32_t i = 0; i < set.count; i++)
            check_mesh(&set.items[i]);
        mesh_set_free(&set);
    }
}

static void add(zip_t *zip, const char *name, const void *data, size_t size)
{
    int64_t file = zip_file_add(zip, name, zip_source_buffer(zip, data, size, 0), 0);
    if (file < 0 || zip_set_file_compression(zip, (zip_uint64_t)file, ZIP_CM_STORE, 0) != 0)
        abort();
}

// The archive as a copy of exactly its size.
static char *pack(const uint8_t *model, size_t size, size_t *packed_size)
{
    static const char relations[] =
        "<Relationships><Relationship Target=\"/a.model\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
    zip_source_t *whole = zip_source_buffer_create(NULL, 0, 0, NULL);
    zip_source_keep(whole);
    zip_t *zip = zip_open_from_source(whole, ZIP_TRUNCATE, NULL);
    add(zip, "_rels/.rels", relations, sizeof relations - 1);
    add(zip, "a.model", model, size);
    if (zip_close(zip) != 0 || zip_source_open(whole) != 0)
        abort();
    char *packed = mem_alloc(size + 1024);
    *packed_size = (size_t)zip_source_read(whole, packed, size + 1024);
    zip_source_close(whole);
    zip_source_free(whole);
    return mem_realloc(packed, *packed_size);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bool zipped = size >= 2 && memcmp(data, "PK", 2) == 0;
    size_t packed_size = size;
    char *packed = zipped ? exact_copy(data, size) : pack(data, size, &packed_size);
    read_both_ways(packed, packed_size);
    free(packed);
    return 0;
}
