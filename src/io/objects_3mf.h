// objects_3mf.h - what the model files of a 3MF package list, before it is placed.
#pragma once
#include "geom/mesh.h"
#include "io/package.h"
#include "io/read_3mf.h"

// An object used by another one or by the build.
struct part_3mf {
    uint64_t key; // of the object
    struct affine place;
};

struct object_3mf {
    uint64_t key; // the file and the number there
    struct mesh mesh;
    uint32_t first_part, part_count;
};

struct objects_3mf { // {0} is empty
    struct object_3mf *items;
    struct part_3mf *parts; // of all objects, in their order
    struct part_3mf *built; // items of the build
    uint32_t count, room, part_count, part_room, built_count, built_room;
};

void objects_3mf_free(struct objects_3mf *o); // leaves {0}

// Adds the objects of one model file; those of the build only with `build`.
bool objects_3mf_read(struct objects_3mf *o, struct package *p, int64_t file, const char *path,
                      bool build, struct error *err);

// The meshes as the build places them.
bool objects_3mf_place(const struct objects_3mf *o, const char *path, struct mesh_set *out,
                       struct error *err);

struct mesh *mesh_set_add(struct mesh_set *s); // an empty one
