// reading.h - cmocka, and readers fed from memory.
#pragma once
#include "../geom/unit.h"
#include "base/error.h"
#include "copy.h"

static inline bool read_mesh(bool (*read)(const char *path, const char *data, size_t size,
                                          struct mesh *out, struct error *err),
                             const char *path, const void *data, size_t size, struct mesh *out,
                             struct error *err)
{
    char *copy = exact_copy(data, size);
    err->text[0] = 0;
    bool ok = read(path, copy, size, out, err);
    if (ok != (err->text[0] == 0) || strchr(err->text, '\n'))
        fail_msg("'%s' from a reader that returned %d", err->text, ok);
    free(copy);
    return ok;
}

static inline void assert_mesh(const struct mesh *m, uint32_t vertices, uint32_t triangles,
                               double volume)
{
    assert_int_equal(m->vertex_count, vertices);
    assert_int_equal(m->triangle_count, triangles);
    assert_close(mesh_volume(m), volume, 1e-9);
}

// Changes a few bytes, and leaves up to three off the end; returns the new size.
static inline size_t spoil(uint64_t *seed, char *data, size_t size)
{
    for (int i = 0; i < 3; i++) {
        *seed = *seed * 6364136223846793005u + 1442695040888963407u;
        data[(*seed >> 40) % size] =
            (char)(*seed >> 33 & 1 ? *seed >> 56 : '0' + (*seed >> 60) % 10);
    }
    return size - (*seed >> 50) % 4;
}
