// read_3mf.h - 3MF packages.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#include <stddef.h>

struct mesh_set { // {0} is empty
    struct mesh *items;
    uint32_t count, room;
};
void mesh_set_free(struct mesh_set *s); // leaves {0}

// All meshes of the package, each welded. `placed`: as its build items place them (OpenSCAD after
// 2021.01); otherwise each once, where its coordinates say.
bool read_3mf(const char *path, const char *data, size_t size, bool placed, struct mesh_set *out,
              struct error *err);
