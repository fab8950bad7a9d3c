// mesh_file.c - meshes of STL files.
#include "mesh_file.h"

#include "base/file.h"
#include "io/read_stl.h"

#include <stdlib.h>

void mesh_load(struct mesh *out, const char *path)
{
    char *data = NULL;
    size_t size;
    struct error err;
    if (!file_read(path, (size_t)1 << 30, &data, &size, &err) ||
        !read_stl(path, data, size, out, &err)) {
        fprintf(stderr, "%s\n", err.text);
        exit(2);
    }
    free(data);
}
